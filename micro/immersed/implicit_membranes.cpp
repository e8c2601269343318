#include "micro/immersed/implicit_membranes.hpp"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "micro/error.hpp"
#include "micro/immersed/flat_points.hpp"

namespace hemoscale::micro {

namespace {

using Points = std::vector<Vector<2>>;
using Flat = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

/// Way in one step over the radius of the cell that counts as rest.
constexpr double rest = 1e-6;

/// a x + b y
Points combined(double a, const Points& x, double b, const Points& y) {
  Points sum(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) sum[i] = a * x[i] + b * y[i];
  return sum;
}

double largest(const Points& v) {
  double norm = 0;
  for (const Vector<2>& x : v) norm = std::max(norm, x.norm());
  return norm;
}

Vector<2> mean(const Points& v) {
  Vector<2> sum = Vector<2>::Zero();
  for (const Vector<2>& x : v) sum += x;
  return sum / static_cast<double>(v.size());
}

double radius_of(const Cell& cell) {
  return cell.membrane->mesh().rest_perimeter / (2 * std::numbers::pi);
}

std::vector<double> compliances_of(const RingMembrane& membrane) {
  const MembraneParameters& p = membrane.parameters();
  const RingMesh& mesh = membrane.mesh();
  const auto n = static_cast<std::size_t>(mesh.nodes);
  if (p.stretch_law == StretchLaw::inextensible) return std::vector<double>(n, 0.0);
  std::vector<double> compliances(n, 1 / p.stretch_modulus);
  if (p.stretch_law == StretchLaw::line_element) {
    // The local modulus is k_l / l0 with one k_l = E_l times the mean length.
    const double mean_length = mesh.rest_perimeter / static_cast<double>(n);
    for (std::size_t k = 0; k < n; ++k) compliances[k] *= mesh.rest_length[k] / mean_length;
  }
  return compliances;
}

std::shared_ptr<const RingMembrane> without_stretch(const RingMembrane& membrane) {
  MembraneParameters p = membrane.parameters();
  p.stretch_law = StretchLaw::inextensible;
  return std::make_shared<const RingMembrane>(membrane.mesh(), p);
}

/// Cells keep a node spacing away from openings, where what is imposed is not felt right.
MembraneBounds make_bounds(const Surroundings& surroundings) {
  if (!surroundings.is_bounded()) return MembraneBounds(FlowDomain<2>(), 0, 0);
  const FlowDomain<2>& domain = surroundings.nodes()->domain();
  return MembraneBounds(domain, 0, domain.spacing);
}

/// Whether a ring of equal segments is a circle.
bool is_full(const RingMesh& mesh) {
  const double n = mesh.nodes;
  const double most =
      mesh.rest_perimeter * mesh.rest_perimeter / (4 * n * std::tan(std::numbers::pi / n));
  return mesh.rest_area > (1 - 1e-9) * most;
}

void require_consistent(const Cell& cell, std::size_t index, const ImplicitOptions& options) {
  std::string faults;
  if (!cell.membrane) {
    throw ParameterError(fmt::format("cell {} has no membrane; give it one", index));
  }
  const MembraneParameters& p = cell.membrane->parameters();
  if (cell.positions.size() != static_cast<std::size_t>(cell.membrane->mesh().nodes)) {
    faults += fmt::format("; it has {} positions for the {} nodes of its membrane",
                          cell.positions.size(), cell.membrane->mesh().nodes);
  }
  if (!(cell.viscosity_ratio > 0) || !std::isfinite(cell.viscosity_ratio)) {
    faults += fmt::format("; its viscosity ratio is {:g}; it must be positive and finite",
                          cell.viscosity_ratio);
  }
  if (p.stretch_law != StretchLaw::inextensible && !(p.stretch_modulus > 0)) {
    faults += fmt::format(
        "; its stretch modulus is {:g} N/m; it must be positive, or the membrane inextensible",
        p.stretch_modulus);
  }
  if (p.stretch_law == StretchLaw::inextensible && is_full(cell.membrane->mesh())) {
    faults +=
        "; its inextensible membrane encloses all the area that it can: nothing determines its "
        "tension; deflate the cell, or let it stretch";
  }
  if (!(options.longest_step > 0) || !(options.step_tolerance >= 0) ||
      !(options.sweep_tolerance > 0) || options.most_sweeps < 1) {
    faults +=
        "; the longest step and the tolerance of the sweeps must be positive, that of the "
        "steps not negative";
  }
  if (!faults.empty()) throw ParameterError(fmt::format("cell {}{}", index, faults));
}

}  // namespace

/// What a cell brings into a step: everything at its extrapolated configuration.
struct ImplicitMembranes::Stage {
  RingContour contour;
  Matrix inverse;             // [-] ((1 + lambda)/2 - (1 - lambda) D)^-1; empty: 1
  Matrix free;                // [m/s per N/m] S
  Surroundings::Places here;  // of the nodes
  Points known;               // [m/s] RingStep
  double rate = 0;            // [1/s] RingStep
  Points deferred;            // [m/s] by walls and other cells beyond what the map says
  Points forces;              // [N/m]
  Points velocities;          // [m/s]
  Answer answer;              // of the last sweep
};

ImplicitMembranes::ImplicitMembranes(std::shared_ptr<const Surroundings> surroundings,
                                     std::vector<Cell> cells, const ImplicitOptions& options)
    : surroundings_(std::move(surroundings)),
      cells_(std::move(cells)),
      options_(options),
      bounds_(make_bounds(*surroundings_)) {
  const bool is_bounded = surroundings_->is_bounded();
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    Cell& cell = cells_[c];
    require_consistent(cell, c, options_);
    const std::size_t n = cell.positions.size();
    cell.velocities.resize(n, Vector<2>::Zero());
    rings_.push_back({.quadrature = RingQuadrature(n),
                      .resistance = without_stretch(*cell.membrane),
                      .compliances = compliances_of(*cell.membrane),
                      .before = {},
                      .unknowns = {cell.positions, std::vector<double>(n, 0.0), 0},
                      .tensions_before = {},
                      .map = SecantMap(static_cast<Eigen::Index>(2 * n)),
                      .answers = {}});
  }
  micro::require_admissible(
      cells_, is_bounded ? surroundings_->nodes()->domain().box : PeriodicBox<2>(), bounds_);
}

ImplicitMembranes::Stage ImplicitMembranes::prepare(std::size_t c, double dt) const {
  const Cell& cell = cells_[c];
  const Ring& ring = rings_[c];
  Stage stage;
  Points guess = cell.positions;
  stage.rate = 1 / dt;
  stage.known = combined(1 / dt, cell.positions, 0, cell.positions);
  double r = 0;
  if (last_step_ > 0) {
    r = dt / last_step_;
    guess = combined(1 + r, cell.positions, -r, ring.before);
    stage.rate = (1 + 2 * r) / ((1 + r) * dt);
    stage.known = combined((1 + r) / dt, cell.positions, -r * r / ((1 + r) * dt), ring.before);
  }
  stage.contour = ring.quadrature.contour(guess);
  stage.here = surroundings_->places(std::move(guess));
  const double viscosity = surroundings_->viscosity();
  stage.free = single_layer(ring.quadrature, stage.contour, surroundings_->kernel(), viscosity);
  if (cell.viscosity_ratio != 1) {
    const double lambda = cell.viscosity_ratio;
    Matrix m =
        -(1 - lambda) * double_layer(ring.quadrature, stage.contour, surroundings_->kernel());
    m.diagonal().array() += 0.5 * (1 + lambda);
    stage.inverse = m.inverse();
  }
  stage.deferred.assign(cell.positions.size(), Vector<2>::Zero());
  // What the map does not say is continued by the polynomial through the last answers.
  for (const Answer& answer : ring.answers) {
    double weight = 1;
    for (const Answer& other : ring.answers) {
      if (&other == &answer) continue;
      weight *= (time_ + dt - other.time) / (answer.time - other.time);
    }
    const Points missed = points_of(answer.velocity - ring.map(answer.forces));
    stage.deferred = combined(1, stage.deferred, weight, missed);
  }
  return stage;
}

void ImplicitMembranes::move(std::size_t c, Stage& stage) {
  Ring& ring = rings_[c];
  Matrix mobility = stage.free + ring.map.matrix();
  Flat ambient = flat_of(combined(1, stage.here.flow, 1, stage.deferred));
  if (stage.inverse.size() > 0) {
    mobility = stage.inverse * mobility;
    ambient = stage.inverse * ambient;
  }
  const Points around = points_of(ambient);
  const RingStep step{.resistance = ring.resistance.get(),
                      .compliances = ring.compliances,
                      .rate = stage.rate,
                      .known = stage.known,
                      .ambient = around,
                      .mobility = &mobility,
                      .normals = stage.contour.normals,
                      .holds_area = cells_[c].membrane->parameters().area_law == AreaLaw::exact,
                      .friction = surroundings_->viscosity()};
  counters_.factorisations += solve_ring(step, ring.unknowns).factorisations;
  stage.forces = elastic_forces(*ring.resistance, ring.unknowns.positions, ring.unknowns.tensions);
  stage.velocities = combined(stage.rate, ring.unknowns.positions, -1, stage.known);
}

double ImplicitMembranes::answer(std::vector<Stage>& stages) {
  const std::size_t count = cells_.size();
  double speed = surroundings_->fastest();
  for (std::size_t c = 0; c < count; ++c) {
    const Stage& stage = stages[c];
    speed = std::max({speed, largest(stage.here.flow), largest(stage.velocities),
                      rest * radius_of(cells_[c]) * stage.rate});
  }
  std::vector<RingSource> sources;
  sources.reserve(count);
  for (std::size_t c = 0; c < count; ++c) {
    sources.emplace_back(rings_[c].quadrature, stages[c].contour, stages[c].forces,
                         stages[c].velocities, cells_[c].viscosity_ratio);
  }
  const Surroundings::Reaction reaction = surroundings_->reaction(sources);
  ++counters_.sweeps;
  extra_pressure_drop_ = surroundings_->extra_pressure_drop(reaction, sources);
  double change = 0;
  for (std::size_t c = 0; c < count; ++c) {
    Stage& stage = stages[c];
    FlowValues others{surroundings_->at(reaction, stage.here),
                      std::vector<double>(stage.contour.size(), 0.0)};
    for (std::size_t o = 0; o < count; ++o) {
      if (o == c) continue;
      add_ring_flow(sources[o], surroundings_->kernel(), surroundings_->viscosity(),
                    stage.contour.positions, others);
    }
    SecantMap& map = rings_[c].map;
    const Answer now{flat_of(stage.forces), flat_of(others.velocities)};
    const Points missed = points_of(now.velocity - map(now.forces));
    change = std::max(change, largest(combined(1, missed, -1, stage.deferred)));
    // Within a step the change teaches what the forces do; across steps the places change as well,
    // and the whole is the better teacher.
    if (stage.answer.forces.size() > 0) {
      map.learn(now.forces - stage.answer.forces, now.velocity - stage.answer.velocity);
    } else {
      map.learn(now.forces, now.velocity);
    }
    stage.deferred = points_of(now.velocity - map(now.forces));
    stage.answer = now;
  }
  return change / speed;
}

void ImplicitMembranes::attempt(double dt, std::vector<Stage>& stages) {
  const std::size_t count = cells_.size();
  const bool is_alone = count == 1 && !surroundings_->is_bounded();
  for (std::size_t c = 0; c < count; ++c) {
    stages.push_back(prepare(c, dt));
    Ring& ring = rings_[c];
    ring.unknowns.positions = stages[c].contour.positions;
    const std::vector<double> tensions = ring.unknowns.tensions;
    if (!ring.tensions_before.empty()) {
      const double r = dt / last_step_;
      for (std::size_t k = 0; k < tensions.size(); ++k) {
        ring.unknowns.tensions[k] += r * (tensions[k] - ring.tensions_before[k]);
      }
    }
    ring.tensions_before = tensions;
  }
  for (int sweep = 1;; ++sweep) {
    for (std::size_t c = 0; c < count; ++c) {
      try {
        move(c, stages[c]);
      } catch (const NumericalError& error) {
        throw NumericalError(fmt::format("cell {}: {}", c, error.what()));
      }
    }
    if (is_alone) return;
    const double change = answer(stages);
    if (change <= options_.sweep_tolerance) return;
    if (sweep >= options_.most_sweeps || !std::isfinite(change)) {
      throw NumericalError(fmt::format(
          "cells and walls did not agree on the flow in {} sweeps: the last changed it by {:.3g} "
          "of the largest speed, wanted {:.3g}; shorten the step",
          sweep, change, options_.sweep_tolerance));
    }
  }
}

double ImplicitMembranes::deviation(const std::vector<Stage>& stages) const {
  double largest_deviation = 0;
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const Points way = combined(1, rings_[c].unknowns.positions, -1, stages[c].contour.positions);
    // That the cell as a whole goes faster or slower deforms nothing.
    const Vector<2> whole = mean(way);
    for (const Vector<2>& d : way) {
      largest_deviation = std::max(largest_deviation, (d - whole).norm() / radius_of(cells_[c]));
    }
  }
  return largest_deviation;
}

bool ImplicitMembranes::step(double dt) {
  const std::vector<Ring> rings = rings_;
  std::vector<Stage> stages;
  try {
    attempt(dt, stages);
  } catch (const NumericalError&) {
    rings_ = rings;
    throw;
  }
  constexpr double most_excess = 3;  // [-] of the tolerance
  const bool is_adaptive = options_.step_tolerance > 0;
  if (is_adaptive && last_step_ > 0) {
    const double excess = deviation(stages) / options_.step_tolerance;
    // The deviation is of second order in the step; beyond a factor of two, differences of
    // variable length lose their stability [Grigorieff1983].
    next_step_ = dt * std::clamp(0.9 / std::sqrt(std::max(excess, 1e-6)), 0.3, 1.8);
    if (excess > most_excess) {
      rings_ = rings;
      return false;
    }
  } else {
    next_step_ = 1.8 * dt;
  }
  try {
    watch();
  } catch (const NumericalError&) {
    rings_ = rings;
    throw;
  }
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    Ring& ring = rings_[c];
    ring.before = std::move(cells_[c].positions);
    cells_[c].positions = ring.unknowns.positions;
    cells_[c].velocities = stages[c].velocities;
    if (stages[c].answer.forces.size() == 0) continue;
    stages[c].answer.time = time_ + dt;
    ring.answers.insert(ring.answers.begin(), std::move(stages[c].answer));
    if (ring.answers.size() > 3) ring.answers.pop_back();
  }
  time_ += dt;
  last_step_ = dt;
  ++counters_.steps;
  return true;
}

double ImplicitMembranes::first_step(double duration) const {
  if (options_.step_tolerance == 0) return options_.longest_step;
  // The first step is of first order: short against the time in which the flow deforms a cell.
  double rate = 0;
  for (const Cell& cell : cells_) {
    const Surroundings::Places here = surroundings_->places(cell.positions);
    const Vector<2> whole = mean(here.flow);
    for (const Vector<2>& u : here.flow) {
      rate = std::max(rate, (u - whole).norm() / radius_of(cell));
    }
  }
  return rate > 0 ? std::min(options_.longest_step, 2 * options_.step_tolerance / rate) : duration;
}

void ImplicitMembranes::advance_by(double duration) {
  if (!(duration > 0)) {
    throw ParameterError(fmt::format("the duration is {:g} s; it must be positive", duration));
  }
  if (cells_.empty()) {
    time_ += duration;
    return;
  }
  if (next_step_ == 0) next_step_ = first_step(duration);
  const double end = time_ + duration;
  for (double left = duration; left > 1e-9 * duration; left = end - time_) {
    const double wanted = std::min(next_step_, options_.longest_step);
    // Equal steps to the end, so that none is left that is much shorter than the others.
    double dt = left / std::ceil(left / wanted - 1e-9);
    if (left > 4 * wanted) dt = wanted;
    std::string fault =
        "however short the step, the cells leave the way that they were on by more than the "
        "tolerance of the steps; raise it";
    try {
      if (step(dt)) continue;
    } catch (const NumericalError& error) {
      fault = error.what();
      next_step_ = 0.5 * dt;
    }
    ++counters_.refused;
    // Much shorter than what the flow asks for: no length of the steps is of help.
    const bool is_hopeless = next_step_ < 1e-4 * first_step(options_.longest_step);
    if (options_.step_tolerance > 0 && !is_hopeless) continue;
    throw NumericalError(
        fmt::format("step {}, time {:.6g} s: {}", counters_.steps + 1, time_ + dt, fault));
  }
  time_ = end;
}

std::vector<RingSource> ImplicitMembranes::sources() const {
  std::vector<RingSource> result;
  result.reserve(cells_.size());
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const Ring& ring = rings_[c];
    const Points forces =
        elastic_forces(*ring.resistance, cells_[c].positions, ring.unknowns.tensions);
    result.emplace_back(ring.quadrature, ring.quadrature.contour(cells_[c].positions), forces,
                        cells_[c].velocities, cells_[c].viscosity_ratio);
  }
  return result;
}

}  // namespace hemoscale::micro
