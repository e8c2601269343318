#pragma once

#include <memory>

#include "micro/cells/outline.hpp"
#include "micro/ensemble/blocks/block_settings.hpp"
#include "micro/ensemble/flow/parallel_flow.hpp"
#include "micro/ensemble/packing/lattice_packing.hpp"
#include "micro/ensemble/pair_potential.hpp"

// The scene of cases/vessel-ensemble with any number of cells, for benchmarks.
namespace hemoscale::test {

struct Vessel {
  micro::blocks::BlockSettings settings;
  micro::EnsembleState state;
};

inline Vessel vessel(std::size_t cells) {
  using namespace micro;
  constexpr int nodes = 100;
  constexpr double height = 75e-6;         // [m]
  constexpr double mean_speed = 2e-6;      // [m/s]
  constexpr double area_fraction = 0.4;    // [-]
  constexpr double viscosity = 1.2e-3;     // [Pa s]
  constexpr double drag_coefficient = 12;  // [-] of a cell per unit depth over the viscosity
  Vessel vessel;
  blocks::BlockSettings& s = vessel.settings;
  const auto outline = outline_nodes({}, nodes);
  MembraneParameters membrane;
  membrane.stretch_modulus = 5e-6;
  membrane.bending_modulus = 2e-19;
  membrane.area_modulus = 5;
  blocks::KindSettings kind;
  kind.mesh = make_ring_mesh(outline, membrane.natural_shape);
  kind.laws = make_membrane_laws(membrane);
  kind.node_drag = drag_coefficient * viscosity / nodes;
  s.height = height;
  s.length = static_cast<double>(cells) * kind.mesh.rest_area / (area_fraction * height);
  s.kinds = {kind};
  s.contact = make_pair_potential(0.23, 0.3e-6, 0.5e-6, 0.05);
  s.plane_walls = WallPotential{1.0, 0.3e-6};
  VelocityProfile profile;
  profile.height = height;
  constexpr int intervals = 16;
  for (int k = 0; k <= intervals; ++k) {
    const double eta = static_cast<double>(k) / intervals;
    profile.velocities.push_back(6 * mean_speed * eta * (1 - eta));
  }
  s.flow = std::make_shared<ParallelFlow>(profile);
  s.integrator = blocks::Integrator::constant_operator_second_order;
  s.time_step = 5e-3;
  LatticeOptions options;
  options.cells = cells;
  options.wall_gap = s.plane_walls->range;
  vessel.state =
      pack_on_lattice(outline, {.length = s.length, .height = height, .walls = true}, options, 1, 0)
          .state;
  return vessel;
}

}  // namespace hemoscale::test
