#include "micro/ensemble/ensemble_model.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "micro/ensemble/averages.hpp"
#include "micro/ensemble/check_parameters.hpp"
#include "micro/ensemble/lateral_profile.hpp"
#include "micro/ensemble/packing.hpp"
#include "micro/error.hpp"
#include "micro/stress/run_average.hpp"
#include "micro/stress/series_estimate.hpp"

namespace hemoscale::micro {
namespace {

// Share of the explicit limit that is used unless a time step is given: the limit is exact for the
// undeformed ring, and compression stiffens it.
constexpr double default_share_of_limit = 0.8;

// Strain between counts of nodes inside other cells.
constexpr double interpenetration_strain = 0.5;

Box make_box(const EnsembleParameters& p, double cell_area) {
  const double area = p.cells * cell_area / p.hematocrit;
  if (const auto* shear_box = std::get_if<ShearBox>(&p.domain)) {
    const double height = std::sqrt(area / shear_box->aspect_ratio);
    return {.length = area / height, .height = height, .walls = false};
  }
  const double height = std::get<PlaneChannel>(p.domain).height;
  return {.length = area / height, .height = height, .walls = true};
}

/// The box must be larger than a cell, or cells would meet their own images, or the far wall,
/// across it.
void require_room(const EnsembleParameters& p, const Box& box) {
  const double least_length = p.outline.length + p.contact.cutoff;
  const double least_height = box.walls ? 2 * p.wall.range : least_length;
  if (box.length < least_length || box.height < least_height) {
    throw ParameterError(
        fmt::format("ensemble: {} cells at hematocrit {} make a box of {:.4g} m by {:.4g} m; at "
                    "least {:.4g} m by "
                    "{:.4g} m is needed, or cells meet themselves across it; use more cells or "
                    "another aspect ratio",
                    p.cells, p.hematocrit, box.length, box.height, least_length, least_height));
  }
  if (p.contact.cutoff * 4 > std::min(box.length, box.walls ? box.length : box.height)) {
    throw ParameterError(
        fmt::format("ensemble: the contact cutoff {:.4g} m is more than a quarter of the box of "
                    "{:.4g} m by {:.4g} m; "
                    "lower it or use more cells",
                    p.contact.cutoff, box.length, box.height));
  }
}

EnsembleSystem make_system(const EnsembleParameters& p, const RingMesh& mesh,
                           const StepLimit& limit) {
  EnsembleSystem system;
  system.mesh = mesh;
  system.laws = make_membrane_laws(p.membrane);
  system.contact = make_pair_potential(p.contact.stiffness, p.contact.rest_distance,
                                       p.contact.cutoff, p.contact.attraction);
  system.wall = {.stiffness = p.wall.stiffness, .range = p.wall.range};
  system.node_drag = limit.drag;
  system.explicit_limit = limit.time_step;
  system.segment_strain_limit = p.segment_strain_limit;
  system.threads = p.threads;
  const double default_step = default_share_of_limit * limit.time_step;
  system.time_step = p.time_step.value_or(default_step);
  if (system.time_step > limit.time_step && !p.force) {
    throw ParameterError(fmt::format(
        "ensemble: time step {:.4g} s exceeds the explicit limit {:.4g} s (drag of a node {:.4g} "
        "Pa s; "
        "ring {:.4g}, contact {:.4g}, wall {:.4g} Pa); reduce the time step, use fewer nodes or "
        "softer "
        "contacts, or force the run",
        system.time_step, limit.time_step, limit.drag, limit.ring, limit.contact, limit.wall));
  }
  return system;
}

/// Packing does not depend on the time step of the run, which may be forced beyond the limit.
EnsembleState pack(const EnsembleSystem& system, const EnsembleParameters& p,
                   const std::vector<Vector<2>>& outline, const Box& box, std::uint64_t seed,
                   std::uint64_t stream) {
  EnsembleSystem careful = system;
  careful.time_step = default_share_of_limit * system.explicit_limit;
  return pack_cells(careful, outline, static_cast<std::size_t>(p.cells), box, seed, stream);
}

/// Rate of a simple shear along the first axis with its gradient along the second [1/s].
double simple_shear_rate(const Forcing<2>& forcing) {
  const Tensor<2>& gradient = forcing.velocity_gradient;
  const double rate = gradient(0, 1);
  const double rest =
      std::max({std::abs(gradient(0, 0)), std::abs(gradient(1, 0)), std::abs(gradient(1, 1))});
  if (!std::isfinite(rate) || !(rest <= 1e-9 * std::abs(rate))) {
    throw ParameterError(
        fmt::format("ensemble: the velocity gradient is ({:.6g}, {:.6g}; {:.6g}, {:.6g}) 1/s; only "
                    "simple shear, its "
                    "component (0, 1), is possible in a box with sliding images; rotate the frame "
                    "into the flow",
                    gradient(0, 0), gradient(0, 1), gradient(1, 0), gradient(1, 1)));
  }
  return rate;
}

struct Watcher {
  FrameClock clock = FrameClock::strain;
  double interval = 0;
  FrameObserver call;
};

}  // namespace

struct EnsembleModel::Parts {
  EnsembleParameters parameters;
  StepLimit limit;
  std::vector<Vector<2>> outline;
  EnsembleSystem system;
  Box box;
  EnsembleState state;
  Stepper stepper;
  Watcher watcher;

  Parts(const EnsembleParameters& p, std::uint64_t seed, std::uint64_t stream)
      : parameters(p),
        limit(micro::step_limit(p)),
        outline(outline_nodes(p.outline, p.nodes)),
        system(make_system(p, make_ring_mesh(outline, p.membrane.natural_shape), limit)),
        box(make_box(p, system.mesh.rest_area)),
        stepper(system) {
    require_room(p, box);
    state = pack(system, p, outline, box, seed, stream);
  }

  EnsembleFrame frame() const;
  void step(const Flow& flow, StepSums* sums);
  Tensor<2> sampled_step(const Flow& flow, StepSums& sums, ConservationLedger& ledger);
  void require_hematocrit(const Forcing<2>& forcing) const;
  std::int64_t steps_per_sample(double rate) const {
    return std::max<std::int64_t>(
        1, std::llround(parameters.sampling_strain / (std::abs(rate) * system.time_step)));
  }
  std::int64_t samples_per_count(double rate) const {
    const double spacing =
        std::abs(rate) * system.time_step * static_cast<double>(steps_per_sample(rate));
    return std::max<std::int64_t>(1, std::llround(interpenetration_strain / spacing));
  }
};

EnsembleFrame EnsembleModel::Parts::frame() const {
  EnsembleFrame result;
  result.time = state.time;
  result.strain = state.strain;
  result.step = state.step;
  result.length = box.length;
  result.height = box.height;
  result.walls = box.walls;
  result.image_offset = state.image_offset;
  result.positions.resize(2 * state.x.size());
  result.cell_ids.resize(state.x.size());
  for (std::size_t cell = 0; cell < state.cells; ++cell) {
    const std::size_t first = cell * state.nodes;
    Vector<2> centre = Vector<2>::Zero();
    for (std::size_t i = first; i < first + state.nodes; ++i) {
      centre += Vector<2>(state.x[i], state.y[i]);
    }
    centre /= static_cast<double>(state.nodes);
    const double row = box.walls ? 0 : std::floor(centre.y() / box.height);
    const double column = std::floor((centre.x() - row * state.image_offset) / box.length);
    for (std::size_t i = first; i < first + state.nodes; ++i) {
      result.positions[2 * i] = state.x[i] - column * box.length - row * state.image_offset;
      result.positions[2 * i + 1] = state.y[i] - row * box.height;
      result.cell_ids[i] = static_cast<std::int32_t>(cell);
    }
  }
  return result;
}

void EnsembleModel::Parts::step(const Flow& flow, StepSums* sums) {
  const bool by_strain = watcher.clock == FrameClock::strain;
  const double before = by_strain ? state.strain : state.time;
  stepper.step(state, box, flow, sums);
  if (watcher.call) {
    const double after = by_strain ? state.strain : state.time;
    if (std::floor(after / watcher.interval) > std::floor(before / watcher.interval)) {
      watcher.call(frame());
    }
  }
}

/// One step with everything that is recorded of it. @returns the stress due to the cells before it
Tensor<2> EnsembleModel::Parts::sampled_step(const Flow& flow, StepSums& sums,
                                             ConservationLedger& ledger) {
  ledger.record_shapes(state);
  const auto* shear = std::get_if<SimpleShear>(&flow);
  const double before = shear != nullptr ? stepper.energy(state, box) : 0;
  step(flow, &sums);
  const Tensor<2> stress = particle_stress(sums, box);
  if (shear != nullptr) {
    const double power = box.area() * stress(0, 1) * shear->rate;
    ledger.record_power(before, stepper.energy(state, box), power, sums.dissipation);
  }
  ledger.require_sound(state);
  return stress;
}

void EnsembleModel::Parts::require_hematocrit(const Forcing<2>& forcing) const {
  if (!(std::abs(forcing.hematocrit - parameters.hematocrit) <= 1e-9)) {
    throw ParameterError(
        fmt::format("ensemble: the forcing has hematocrit {}, the box was packed at {}; they must "
                    "agree; make a model "
                    "for every hematocrit",
                    forcing.hematocrit, parameters.hematocrit));
  }
}

EnsembleModel::EnsembleModel(const EnsembleParameters& parameters, std::uint64_t seed,
                             std::uint64_t stream)
    : parts_(std::make_unique<Parts>(parameters, seed, stream)) {}

EnsembleModel::~EnsembleModel() = default;
EnsembleModel::EnsembleModel(EnsembleModel&&) noexcept = default;
EnsembleModel& EnsembleModel::operator=(EnsembleModel&&) noexcept = default;

Observation<2> EnsembleModel::advance(const Forcing<2>& forcing, const Run& run) {
  Parts& parts = *parts_;
  require_admissible(run);
  if (parts.box.walls) {
    throw ParameterError(
        "ensemble: a channel has no uniform shear rate to average at; a shear box is "
        "needed; choose that domain, or advance the channel by a duration");
  }
  const double rate = simple_shear_rate(forcing);
  if (rate == 0) {
    throw ParameterError(
        "ensemble: the shear rate is 0 1/s; it must not vanish, as runs are measured in "
        "strain; leave such points out of the sampling");
  }
  parts.require_hematocrit(forcing);
  const Flow flow = SimpleShear{rate};
  const std::int64_t first_step = parts.state.step;
  const double strain_per_step = std::abs(rate) * parts.system.time_step;
  const auto warm_up_steps =
      static_cast<std::int64_t>(std::ceil(run.warm_up_strain / strain_per_step));
  for (std::int64_t i = 0; i < warm_up_steps; ++i) {
    parts.step(flow, nullptr);
  }
  const std::int64_t interval = parts.steps_per_sample(rate);
  RunAverage average(run, rate, parts.parameters.plasma_viscosity,
                     strain_per_step * static_cast<double>(interval));
  ConservationLedger ledger(parts.system, parts.box, parts.samples_per_count(rate));
  StepSums sums;
  while (!average.finished()) {
    average.add(parts.sampled_step(flow, sums, ledger));
    for (std::int64_t i = 1; i < interval; ++i) {
      parts.step(flow, nullptr);
    }
  }
  Observation<2> result = average.observation();
  result.hematocrit = parts.parameters.hematocrit;
  result.warm_up_time = static_cast<double>(warm_up_steps) * parts.system.time_step;
  result.steps = parts.state.step - first_step;
  result.ledger = ledger.entries();
  return result;
}

SceneObservation EnsembleModel::advance_by(const Forcing<2>& forcing, double duration) {
  Parts& parts = *parts_;
  const double dt = parts.system.time_step;
  if (!(duration > 0) || !std::isfinite(duration) || duration / dt > 1e15) {
    throw ParameterError(fmt::format(
        "ensemble: duration {} s; it must be finite and positive; give it in seconds", duration));
  }
  parts.require_hematocrit(forcing);
  Flow flow;
  double rate = 0;
  if (parts.box.walls) {
    if (!forcing.profile || std::abs(forcing.profile->height / parts.box.height - 1) > 1e-9) {
      throw ParameterError(fmt::format(
          "ensemble: the forcing has {}; a velocity profile across the channel of height {} m is "
          "needed; "
          "give one",
          forcing.profile ? fmt::format("a profile of height {} m", forcing.profile->height)
                          : std::string("no velocity profile"),
          parts.box.height));
    }
    const CubicProfile profile(*forcing.profile);
    rate = profile.largest_shear_rate();
    flow = profile;
  } else {
    rate = simple_shear_rate(forcing);
    flow = SimpleShear{rate};
  }
  const std::int64_t first_step = parts.state.step;
  const std::int64_t steps = std::max<std::int64_t>(1, std::llround(duration / dt));
  // At least twenty samples of a stretch, however short or slow it is.
  const std::int64_t interval = std::max<std::int64_t>(
      1, rate == 0 ? steps / 20 : std::min(parts.steps_per_sample(rate), steps / 20));
  const std::int64_t samples_per_count = rate == 0 ? 20 : parts.samples_per_count(rate);
  ConservationLedger ledger(parts.system, parts.box, samples_per_count);
  constexpr int bins = 20;
  ProfileAverage profile(parts.box, bins);
  std::vector<double> shear;
  std::vector<double> normal;
  Tensor<2> total = Tensor<2>::Zero();
  StepSums sums;
  for (std::int64_t i = 0; i < steps; ++i) {
    if (i % interval != 0) {
      parts.step(flow, nullptr);
      continue;
    }
    const EnsembleState before = parts.box.walls ? parts.state : EnsembleState{};
    const Tensor<2> stress = parts.sampled_step(flow, sums, ledger);
    total += stress;
    shear.push_back(0.5 * (stress(0, 1) + stress(1, 0)) + parts.parameters.plasma_viscosity * rate);
    normal.push_back(stress(0, 0) - stress(1, 1));
    if (parts.box.walls) {
      profile.add(before, std::get<CubicProfile>(flow), parts.stepper.force_x(),
                  parts.system.node_drag, sums.lower_wall + sums.upper_wall);
    }
  }
  SceneObservation result;
  result.time = parts.state.time;
  result.steps = parts.state.step - first_step;
  result.duration = static_cast<double>(result.steps) * dt;
  result.particle_stress = total / static_cast<double>(shear.size());
  result.ledger = ledger.entries();
  if (parts.box.walls) {
    result.profile = profile.mean();
  } else {
    const double spacing = static_cast<double>(interval) * dt;
    result.shear_stress = estimate_mean(shear, spacing);
    result.first_normal_difference = estimate_mean(normal, spacing);
  }
  return result;
}

void EnsembleModel::observe(FrameClock clock, double interval, FrameObserver observer) {
  if (!(interval > 0) || !std::isfinite(interval)) {
    throw ParameterError(
        fmt::format("ensemble: interval between frames {}; it must be finite and "
                    "positive; give it in seconds or units of strain",
                    interval));
  }
  parts_->watcher = {clock, interval, std::move(observer)};
}

Snapshot EnsembleModel::snapshot() const {
  const EnsembleState& state = parts_->state;
  return {.reals = {{"ensemble.x", state.x},
                    {"ensemble.y", state.y},
                    {"ensemble.image_offset", {state.image_offset}},
                    {"ensemble.time", {state.time}},
                    {"ensemble.strain", {state.strain}}},
          .integers = {{"ensemble.cells", {static_cast<std::int64_t>(state.cells)}},
                       {"ensemble.nodes", {static_cast<std::int64_t>(state.nodes)}},
                       {"ensemble.step", {state.step}}}};
}

void EnsembleModel::restore(const Snapshot& snapshot) {
  const auto reals = [&](const char* name, std::size_t size) -> const std::vector<double>& {
    const auto found = snapshot.reals.find(name);
    if (found == snapshot.reals.end() || found->second.size() != size) {
      throw ParameterError(fmt::format(
          "snapshot: {} numbers '{}'; this ensemble has {}; restore it into a model with the same "
          "parameters",
          found == snapshot.reals.end() ? std::size_t{0} : found->second.size(), name, size));
    }
    return found->second;
  };
  const auto integer = [&](const char* name) {
    const auto found = snapshot.integers.find(name);
    if (found == snapshot.integers.end() || found->second.size() != 1) {
      throw ParameterError(
          fmt::format("snapshot: no single integer '{}'; one of an ensemble is needed; "
                      "restore it into the kind of model that wrote it",
                      name));
    }
    return found->second.front();
  };
  EnsembleState state = parts_->state;
  const auto cells = static_cast<std::int64_t>(state.cells);
  const auto nodes = static_cast<std::int64_t>(state.nodes);
  if (integer("ensemble.cells") != cells || integer("ensemble.nodes") != nodes) {
    throw ParameterError(
        fmt::format("snapshot: {} cells of {} nodes; this ensemble has {} of {}; restore it into a "
                    "model with the same "
                    "parameters",
                    integer("ensemble.cells"), integer("ensemble.nodes"), cells, nodes));
  }
  state.x = reals("ensemble.x", state.x.size());
  state.y = reals("ensemble.y", state.y.size());
  state.image_offset = reals("ensemble.image_offset", 1).front();
  state.time = reals("ensemble.time", 1).front();
  state.strain = reals("ensemble.strain", 1).front();
  state.step = integer("ensemble.step");
  const bool finite =
      std::all_of(state.x.begin(), state.x.end(), [](double v) { return std::isfinite(v); }) &&
      std::all_of(state.y.begin(), state.y.end(), [](double v) { return std::isfinite(v); });
  if (!finite || state.step < 0 ||
      !(state.image_offset >= 0 && state.image_offset <= parts_->box.length)) {
    throw ParameterError(
        "snapshot: positions, step or image offset are not those of this ensemble; they "
        "must be finite and inside its box; restore it into a model with the same "
        "parameters");
  }
  parts_->state = std::move(state);
  parts_->stepper.invalidate();
}

EnsembleFrame EnsembleModel::frame() const {
  return parts_->frame();
}
double EnsembleModel::time_step() const {
  return parts_->system.time_step;
}
const StepLimit& EnsembleModel::step_limit() const {
  return parts_->limit;
}
double EnsembleModel::cell_area() const {
  return parts_->system.mesh.rest_area;
}

}  // namespace hemoscale::micro
