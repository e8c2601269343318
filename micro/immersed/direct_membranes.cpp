#include "micro/immersed/direct_membranes.hpp"

#include <fmt/format.h>

#include "micro/error.hpp"
#include "micro/immersed/membrane_snapshot.hpp"

namespace hemoscale::micro {

namespace {

void require_direct(const std::vector<Cell>& cells) {
  std::string faults;
  const auto add = [&](std::size_t c, const std::string& fault) {
    faults += fmt::format("{}cell {}: {}", faults.empty() ? "" : "\n", c, fault);
  };
  for (std::size_t c = 0; c < cells.size(); ++c) {
    if (cells[c].viscosity_ratio != 1) {
      add(c, fmt::format("the viscosity ratio is {:g}; the direct coupling has the same viscosity "
                         "inside and outside (1); choose the implicit coupling",
                         cells[c].viscosity_ratio));
    }
    if (!cells[c].membrane) continue;
    const MembraneParameters& p = cells[c].membrane->parameters();
    if (p.stretch_law == StretchLaw::inextensible || p.area_law == AreaLaw::exact) {
      add(c,
          "its length or area is held exactly; the direct coupling moves nodes by forces alone; "
          "choose a stiffness and an area modulus, or the implicit coupling");
    }
  }
  if (!faults.empty()) throw ParameterError(faults);
}

/// Calls use(particle, cell, node) for all membrane nodes among the particles.
template <typename Use>
void for_each_node(const ParticleSet<2>& particles, const std::vector<Cell>& cells,
                   std::int64_t first_identity, const Use& use) {
  std::vector<std::int64_t> ends;
  std::int64_t end = first_identity;
  for (const Cell& cell : cells) {
    end += static_cast<std::int64_t>(cell.positions.size());
    ends.push_back(end);
  }
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const std::int64_t identity = particles.identities[i];
    if (identity < first_identity || identity >= end) continue;
    std::size_t c = 0;
    while (identity >= ends[c]) ++c;
    const std::int64_t begin = ends[c] - static_cast<std::int64_t>(cells[c].positions.size());
    use(i, c, static_cast<std::size_t>(identity - begin));
  }
}

/// Of every kind of membrane.
std::vector<Limit> membrane_limits(const std::vector<Cell>& cells, const Fluid& fluid,
                                   double spacing, ViscousStepping viscosity, double dt) {
  std::vector<Limit> limits;
  const RingMembrane* last = nullptr;
  for (const Cell& cell : cells) {
    if (cell.membrane.get() == last) continue;
    last = cell.membrane.get();
    const MembraneScales scales = membrane_scales(*cell.membrane);
    limits.push_back(direct_stretch_limit(dt, scales, fluid, spacing, viscosity));
    limits.push_back(direct_area_limit(dt, scales, fluid, spacing, viscosity));
    limits.push_back(direct_bending_limit(dt, scales, fluid, spacing, viscosity));
  }
  return limits;
}

}  // namespace

DirectMembranes::DirectMembranes(const FlowDomain<2>& domain, const Fluid& fluid,
                                 const SemiImplicitOptions& options, std::vector<Cell> cells,
                                 const DirectInsertion& insertion,
                                 const MembraneThresholds& thresholds,
                                 const SolveTolerance& tolerance)
    : thresholds_(thresholds),
      spacing_(domain.spacing),
      box_(domain.box),
      bounds_(domain, domain.spacing / 2, domain.spacing),
      cells_(std::make_shared<std::vector<Cell>>(std::move(cells))) {
  require_direct(*cells_);
  require_admissible(*cells_, box_, bounds_);
  InsertedMembranes inserted =
      insert_membranes(domain, *cells_, insertion, options.gradient_ratio, options.laplacian_ratio);
  first_identity_ = inserted.first_identity;
  removed_ = inserted.removed;
  deviation_ = inserted.deviation;
  const double mass = fluid.density * spacing_ * spacing_;  // [kg/m] of a particle
  inserted.domain.local_acceleration =
      [cells_now = cells_, first = first_identity_, mass, other = domain.local_acceleration](
          const ParticleSet<2>& particles, double t, std::vector<Vector<2>>& accelerations) {
        if (other) other(particles, t, accelerations);
        std::vector<std::vector<Vector<2>>> forces;
        for (const Cell& cell : *cells_now) {
          forces.emplace_back(cell.positions.size());
          cell.membrane->forces(cell.positions, forces.back());
        }
        for_each_node(particles, *cells_now, first,
                      [&](std::size_t particle, std::size_t c, std::size_t node) {
                        accelerations[particle] += forces[c][node] / mass;
                      });
      };
  inserted.domain.local_limits = [cells_now = cells_, fluid, spacing = spacing_,
                                  viscosity = options.viscosity](double dt) {
    return membrane_limits(*cells_now, fluid, spacing, viscosity, dt);
  };
  plasma_ = std::make_unique<SemiImplicitStepper<2>>(inserted.domain, fluid, options, tolerance);
  *cells_ = seen_cells();
  for (const Cell& cell : *cells_) reports_.push_back(report_on(cell));
}

std::vector<Limit> DirectMembranes::limits(double dt) const {
  return plasma_->limits(dt);
}

void DirectMembranes::step(double dt) {
  if (!(dt > 0)) {
    throw ParameterError(fmt::format("the time step is {:g} s; it must be positive", dt));
  }
  if (dt != limits_step_) {
    limits_ = limits(dt);
    limits_step_ = dt;
  }
  plasma_->step(dt);  // refuses a step beyond the limits
  std::vector<Cell> moved = seen_cells();
  try {
    reports_ = watch(moved, *cells_, bounds_, thresholds_,
                     {.step = steps(), .time = time(), .spacing = spacing_, .limits = &limits_});
  } catch (const NumericalError&) {
    plasma_->revert();
    throw;
  }
  *cells_ = std::move(moved);
}

std::vector<Cell> DirectMembranes::seen_cells() const {
  std::vector<Cell> cells = *cells_;
  for (Cell& cell : cells) cell.velocities.resize(cell.positions.size());
  const ParticleSet<2>& particles = plasma_->particles();
  for_each_node(particles, cells, first_identity_,
                [&](std::size_t particle, std::size_t c, std::size_t node) {
                  Vector<2>& x = cells[c].positions[node];
                  // Cells are not wrapped: the image next to where the node was.
                  x += separation(box_, x, particles.positions[particle]);
                  cells[c].velocities[node] = particles.velocities[particle];
                });
  return cells;
}

Snapshot DirectMembranes::snapshot() const {
  Snapshot snapshot = plasma_->snapshot();
  store_cells(*cells_, snapshot);
  return snapshot;
}

void DirectMembranes::restore(const Snapshot& snapshot) {
  std::vector<Cell> cells = *cells_;
  load_cells(snapshot, cells);
  plasma_->restore(snapshot);
  *cells_ = std::move(cells);
  reports_.clear();
  for (const Cell& cell : *cells_) reports_.push_back(report_on(cell));
}

}  // namespace hemoscale::micro
