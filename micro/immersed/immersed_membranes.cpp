#include "micro/immersed/immersed_membranes.hpp"

#include <fmt/format.h>

#include <cmath>

#include "micro/error.hpp"
#include "micro/immersed/membrane_snapshot.hpp"
#include "micro/mps/stage_limits.hpp"
#include "micro/particles/particle_snapshot.hpp"

namespace hemoscale::micro {

struct ImmersedMembranes::Coupling {
  KernelTransfer transfer;
  Fluid fluid;
  double spacing;  // [m]
  ImmersedScheme scheme;
  std::vector<Cell> cells;                        // at the end of the step
  std::vector<std::vector<Vector<2>>> from = {};  // [m] nodes at its beginning
  std::vector<KernelRows> rows = {};              // of the nodes at the end
  double start = 0;                               // [s]
  double duration = 0;                            // [s] 0: the flow settles around resting nodes

  std::vector<Limit> limits(double dt) const {
    std::vector<Limit> limits;
    const RingMembrane* last = nullptr;
    for (const Cell& cell : cells) {
      if (cell.membrane.get() == last) continue;
      last = cell.membrane.get();
      const MembraneScales scales = membrane_scales(*cell.membrane);
      limits.push_back(immersed_stretch_limit(dt, scales, fluid.viscosity(), spacing, scheme));
      limits.push_back(immersed_bending_limit(dt, scales, fluid.viscosity(), spacing, scheme));
    }
    return limits;
  }

  void take_rows() {
    rows.clear();
    for (const Cell& cell : cells) rows.push_back(transfer.rows(cell.positions));
  }

  void add_forces(double t, std::vector<Vector<2>>& accelerations) const {
    const double share = duration > 0 ? (t - start) / duration : 1;
    // The end of the step, but for rounding of the time: its rows are there.
    const bool is_end = std::abs(share - 1) < 1e-9;
    std::vector<Vector<2>> forces;
    for (std::size_t c = 0; c < cells.size(); ++c) {
      const std::vector<Vector<2>>& end = cells[c].positions;
      forces.resize(end.size());
      if (is_end) {
        cells[c].membrane->forces(end, forces);
        transfer.spread(rows[c], forces, fluid.density, accelerations);
        continue;
      }
      std::vector<Vector<2>> between(end.size());
      for (std::size_t i = 0; i < end.size(); ++i) {
        between[i] = from[c][i] + share * (end[i] - from[c][i]);
      }
      cells[c].membrane->forces(between, forces);
      transfer.spread(transfer.rows(between), forces, fluid.density, accelerations);
    }
  }
};

namespace {

void require_explicit(const ImmersedOptions& options, const std::vector<Cell>& cells) {
  std::string faults;
  const auto add = [&](const std::string& fault) {
    faults += (faults.empty() ? "" : "\n") + fault;
  };
  if (options.flow.motion != NodeMotion::eulerian) {
    add("the nodes of the flow move; immersed membranes need resting ones (eulerian)");
  }
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (cells[c].viscosity_ratio != 1) {
      add(
          fmt::format("cell {}: the viscosity ratio is {:g}; the explicit couplings have the same "
                      "viscosity inside and outside (1); choose the implicit coupling",
                      c, cells[c].viscosity_ratio));
    }
    if (cells[c].membrane &&
        cells[c].membrane->parameters().stretch_law == StretchLaw::inextensible) {
      add(
          fmt::format("cell {}: its membrane is inextensible, which no explicit step can hold; "
                      "choose the linear law with a stiffness, or the implicit coupling",
                      c));
    }
  }
  if (!faults.empty()) throw ParameterError(faults);
}

}  // namespace

ImmersedMembranes::ImmersedMembranes(FlowDomain<2> domain, const Fluid& fluid,
                                     const ImmersedOptions& options, std::vector<Cell> cells)
    : ImmersedMembranes(
          domain, fluid, options,
          std::make_shared<Coupling>(
              Coupling{.transfer = {domain.particles, domain.box, domain.spacing, options.kernel},
                       .fluid = fluid,
                       .spacing = domain.spacing,
                       .scheme = {.kernel = options.kernel,
                                  .coupling = options.flow.coupling,
                                  .stepping = options.stepping},
                       .cells = std::move(cells)})) {}

ImmersedMembranes::ImmersedMembranes(FlowDomain<2> domain, const Fluid& fluid,
                                     const ImmersedOptions& options,
                                     const std::shared_ptr<Coupling>& coupling)
    : options_(options),
      fluid_(fluid),
      spacing_(domain.spacing),
      bounds_(domain, 0, kernel_reach(options.kernel) * domain.spacing),
      coupling_(coupling),
      flow_([&] {
        domain.local_acceleration = [coupling, other = domain.local_acceleration](
                                        const ParticleSet<2>& particles, double t,
                                        std::vector<Vector<2>>& accelerations) {
          if (other) other(particles, t, accelerations);
          coupling->add_forces(t, accelerations);
        };
        domain.local_limits = [coupling](double dt) { return coupling->limits(dt); };
        return StageStepper<2>(std::move(domain), fluid, options.flow);
      }()) {
  std::vector<Cell>& cells = coupling_->cells;
  require_explicit(options_, cells);
  require_admissible(cells, flow_.domain().box, bounds_);
  leaks_.assign(cells.size(), 0);
  leak_rates_.assign(cells.size(), 0);
  try {
    coupling_->take_rows();
  } catch (const NumericalError& error) {
    throw ParameterError(error.what());  // nothing was computed yet: the cells lie wrong
  }
  for (const Cell& cell : cells) reports_.push_back(report_on(cell));
  if (options_.flow.inertia == Inertia::quasi_steady) flow_.settle();
  take_velocities();
}

std::vector<Limit> ImmersedMembranes::limits(double dt) const {
  std::vector<Limit> limits =
      stage_limits<2>(options_.flow, fluid_, spacing_, dt, {.speed = options_.speed});
  if (options_.speed > 0) {
    Limit motion = advective_limit(dt, options_.speed, spacing_);
    motion.name = "membrane motion limit";
    limits.push_back(motion);
  }
  for (const Limit& limit : coupling_->limits(dt)) limits.push_back(limit);
  return limits;
}

void ImmersedMembranes::step(double dt) {
  if (!(dt > 0)) {
    throw ParameterError(fmt::format("the time step is {:g} s; it must be positive", dt));
  }
  if (dt != limits_step_) {
    limits_ = limits(dt);
    limits_step_ = dt;
  }
  require_within(limits_, options_.force);
  const std::vector<Cell> before = coupling_->cells;
  const std::vector<KernelRows> rows_before = coupling_->rows;
  const std::vector<double> leaks_before = leaks_;
  try {
    move(dt);
    std::vector<CellReport> reports =
        watch(coupling_->cells, before, bounds_, options_.thresholds,
              {.step = steps() + 1, .time = time() + dt, .spacing = spacing_, .limits = &limits_});
    coupling_->take_rows();
    coupling_->start = time();
    coupling_->duration = dt;
    flow_.step(dt);
    reports_ = std::move(reports);
  } catch (const NumericalError&) {
    coupling_->cells = before;
    coupling_->rows = rows_before;
    leaks_ = leaks_before;
    throw;
  }
  former_step_ = dt;
  former_velocities_.clear();
  for (const Cell& cell : before) former_velocities_.push_back(cell.velocities);
  take_velocities();
}

void ImmersedMembranes::move(double dt) {
  const bool is_second_order =
      options_.stepping == NodeStepping::adams_bashforth && !former_velocities_.empty();
  // Of the change since the last step; one half if both are of the same length.
  const double share = is_second_order ? dt / (2 * former_step_) : 0;
  coupling_->from.clear();
  for (std::size_t c = 0; c < coupling_->cells.size(); ++c) {
    Cell& cell = coupling_->cells[c];
    coupling_->from.push_back(cell.positions);
    for (std::size_t i = 0; i < cell.positions.size(); ++i) {
      Vector<2> u = cell.velocities[i];
      if (is_second_order) u += share * (u - former_velocities_[c][i]);
      cell.positions[i] += dt * u;
    }
    if (cell.membrane->parameters().area_law == AreaLaw::exact) {
      leaks_[c] -= dt * leak_rates_[c] + project_area(cell.membrane->mesh(), cell.positions);
    }
  }
}

void ImmersedMembranes::take_velocities() {
  for (std::size_t c = 0; c < coupling_->cells.size(); ++c) {
    Cell& cell = coupling_->cells[c];
    cell.velocities =
        coupling_->transfer.interpolate(coupling_->rows[c], flow_.particles().velocities);
    if (cell.membrane->parameters().area_law == AreaLaw::exact) {
      leak_rates_[c] = project_velocities(cell.membrane->mesh(), cell.positions, cell.velocities);
    }
  }
}

const std::vector<Cell>& ImmersedMembranes::cells() const {
  return coupling_->cells;
}

Snapshot ImmersedMembranes::snapshot() const {
  Snapshot snapshot;
  store_cells(coupling_->cells, snapshot);
  store_particles(flow_.particles(), "stage.", snapshot);
  std::vector<Vector<2>> former;
  for (const auto& velocities : former_velocities_) {
    former.insert(former.end(), velocities.begin(), velocities.end());
  }
  snapshot.reals["cells.former_velocities"] = flat<2>(former);
  snapshot.reals["cells.leaks"] = leaks_;
  snapshot.reals["cells.leak_rates"] = leak_rates_;
  snapshot.reals["stage.time"] = {time(), former_step_};
  snapshot.integers["stage.counters"] = {steps(), flow_.next_identity(),
                                         static_cast<std::int64_t>(former.size())};
  return snapshot;
}

void ImmersedMembranes::restore(const Snapshot& snapshot) {
  const std::vector<std::int64_t>& counters = stored_integers(snapshot, "stage.counters", 3);
  const std::vector<double> times = stored_reals(snapshot, "stage.time", 2);
  const std::vector<Vector<2>> former = vectors_of<2>(
      stored_reals(snapshot, "cells.former_velocities", 2 * static_cast<std::size_t>(counters[2])));
  const std::vector<double> leaks = stored_reals(snapshot, "cells.leaks", coupling_->cells.size());
  const std::vector<double> leak_rates =
      stored_reals(snapshot, "cells.leak_rates", coupling_->cells.size());
  ParticleSet<2> particles = load_particles<2>(snapshot, "stage.");
  if (particles.positions != flow_.particles().positions) {
    throw ParameterError(
        "the snapshot was written on other nodes; restore it into a model of the same domain");
  }
  std::size_t nodes = 0;
  for (const Cell& cell : coupling_->cells) nodes += cell.positions.size();
  if (!former.empty() && former.size() != nodes) {
    throw ParameterError(fmt::format(
        "snapshot: {} former velocities of {} nodes; restore it into a model of the same cells",
        former.size(), nodes));
  }
  load_cells(snapshot, coupling_->cells);
  leaks_ = leaks;
  leak_rates_ = leak_rates;
  former_step_ = times[1];
  former_velocities_.clear();
  std::size_t at = 0;
  reports_.clear();
  for (const Cell& cell : coupling_->cells) {
    reports_.push_back(report_on(cell));
    if (former.empty()) continue;
    const auto begin = former.begin() + static_cast<std::ptrdiff_t>(at);
    at += cell.positions.size();
    former_velocities_.emplace_back(begin, former.begin() + static_cast<std::ptrdiff_t>(at));
  }
  coupling_->take_rows();
  flow_.restore(std::move(particles),
                {.time = times[0], .steps = counters[0], .next_identity = counters[1]});
}

}  // namespace hemoscale::micro
