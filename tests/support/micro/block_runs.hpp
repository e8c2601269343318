#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "micro/cells/outline.hpp"
#include "micro/ensemble/blocks/block_ensemble.hpp"
#include "micro/ensemble/flow/parallel_flow.hpp"
#include "micro/random/philox.hpp"
#include "micro/velocity_profile.hpp"

// Small runs of the block ensemble: cells on a lattice that shear brings into contact.
namespace hemoscale::test {

using micro::BlockEnsemble;
using micro::EnsembleState;
using micro::Precision;
using micro::blocks::BlockSettings;
using micro::blocks::Integrator;

/// Poiseuille flow between y = 0 and y = height.
inline std::shared_ptr<const micro::GivenFlow> parabola(double height, double speed_at_axis) {
  micro::VelocityProfile profile;
  profile.height = height;
  for (int i = 0; i <= 40; ++i) {
    profile.velocities.push_back(speed_at_axis * 4 * i * (40 - i) / 1600);
  }
  return std::make_shared<micro::ParallelFlow>(profile);
}

/// A red cell with the laws of the vessel: soft, area held weakly, drag of the cell shared by
/// nodes.
inline micro::blocks::KindSettings red_cell(int nodes, double length = 7.82e-6) {
  micro::MembraneParameters p;
  p.stretch_modulus = 5e-6;
  p.bending_modulus = 2e-19;
  p.area_modulus = 5;
  micro::blocks::KindSettings kind;
  kind.mesh = micro::make_ring_mesh(micro::outline_nodes({.length = length}, nodes),
                                    micro::NaturalShape::outline);
  kind.laws = micro::make_membrane_laws(p);
  kind.node_drag = 12 * 1.2e-3 / nodes;
  return kind;
}

/// Stiff contacts of the vessel.
inline micro::PairPotential vessel_contact() {
  return {.scale = 50e36, .rest_squared = 0.09e-12, .cutoff_squared = 0.25e-12, .attraction = 0.05};
}

struct Lattice {
  std::size_t columns = 3, rows = 4;
  double spacing_x = 8.6e-6, spacing_y = 3.3e-6;  // [m]
  double disorder = 0.2e-6;                       // [m] largest shift of a cell
  double y0 = 0;                                  // [m] of the lower edge
  std::uint64_t seed = 1;
};

/// Cells of one kind in their resting shapes, slightly tilted.
inline EnsembleState on_lattice(const std::vector<micro::Vector<2>>& outline,
                                const Lattice& lattice) {
  EnsembleState state;
  state.nodes = outline.size();
  for (std::size_t r = 0; r < lattice.rows; ++r) {
    for (std::size_t c = 0; c < lattice.columns; ++c) {
      const auto draw = [&](std::uint64_t stream) {
        return 2 * micro::uniform({lattice.seed, stream, state.cells}) - 1;
      };
      const double x = (static_cast<double>(c) + 0.5) * lattice.spacing_x;
      const double y = (static_cast<double>(r) + 0.5) * lattice.spacing_y + lattice.y0;
      const double angle = 0.05 * draw(2);
      for (const auto& p : outline) {
        state.x.push_back(x + lattice.disorder * draw(0) + std::cos(angle) * p.x() -
                          std::sin(angle) * p.y());
        state.y.push_back(y + lattice.disorder * draw(1) + std::sin(angle) * p.x() +
                          std::cos(angle) * p.y());
      }
      ++state.cells;
    }
  }
  return state;
}

/// What a run needs.
struct BlockCase {
  BlockSettings settings;
  std::vector<EnsembleState> initial;
  BlockEnsemble make(Precision precision) const { return {settings, precision, initial}; }
};

/// Two kinds of cells in a channel with walls, periodic along x; contacts begin within some hundred
/// steps of a millisecond.
inline BlockCase crowded_channel(Lattice lattice = {}) {
  BlockCase c;
  lattice.y0 = 0.4e-6;
  const double height = static_cast<double>(lattice.rows + 1) * lattice.spacing_y + 0.8e-6;
  c.settings.kinds = {red_cell(100), red_cell(37, 5e-6)};
  c.settings.contact = vessel_contact();
  c.settings.flow = parabola(height, 30e-6);
  c.settings.plane_walls = micro::WallPotential{.stiffness = 1, .range = 0.3e-6};
  c.settings.height = height;
  c.settings.length = static_cast<double>(lattice.columns) * lattice.spacing_x;
  c.settings.time_step = 1e-3;
  c.initial.push_back(on_lattice(micro::outline_nodes({}, 100), lattice));
  Lattice small = lattice;
  small.rows = 1;
  small.y0 += static_cast<double>(lattice.rows) * lattice.spacing_y;
  c.initial.push_back(on_lattice(micro::outline_nodes({.length = 5e-6}, 37), small));
  return c;
}

/// Cells of one kind in a shear box with sliding images.
inline BlockCase shear_box(double rate, Lattice lattice = {}) {
  BlockCase c;
  c.settings.kinds = {red_cell(100)};
  c.settings.contact = vessel_contact();
  c.settings.height = static_cast<double>(lattice.rows) * lattice.spacing_y;
  c.settings.length = static_cast<double>(lattice.columns) * lattice.spacing_x;
  c.settings.flow = std::make_shared<micro::SimpleShearFlow>(rate, c.settings.height);
  c.settings.periodic_y = true;
  c.settings.time_step = 1e-3;
  c.initial.push_back(on_lattice(micro::outline_nodes({}, 100), lattice));
  return c;
}

/// One cell far from everything in the lower half of a channel that is 75 um high.
inline BlockCase lonely_cell_in_channel() {
  BlockCase c;
  c.settings.kinds = {red_cell(100)};
  c.settings.contact = vessel_contact();
  c.settings.flow = parabola(75e-6, 3e-6);
  c.settings.height = 75e-6;
  c.settings.time_step = 1e-3;
  Lattice one;
  one.columns = one.rows = 1;
  one.y0 = 20e-6;
  c.initial.push_back(on_lattice(micro::outline_nodes({}, 100), one));
  return c;
}

/// Root mean square distance of the nodes of two states [m].
inline double node_difference(const std::vector<EnsembleState>& a,
                              const std::vector<EnsembleState>& b) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    for (std::size_t i = 0; i < a[k].x.size(); ++i, ++count) {
      sum += std::pow(a[k].x[i] - b[k].x[i], 2) + std::pow(a[k].y[i] - b[k].y[i], 2);
    }
  }
  return std::sqrt(sum / static_cast<double>(count));
}

/// Pairs of nodes of different cells of one state nearer than a distance, without images.
inline std::size_t count_contacts(const std::vector<EnsembleState>& states, double distance) {
  std::size_t count = 0;
  for (const EnsembleState& s : states) {
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      for (std::size_t j = 0; j < i / s.nodes * s.nodes; ++j) {
        const double dx = s.x[i] - s.x[j];
        const double dy = s.y[i] - s.y[j];
        count += dx * dx + dy * dy < distance * distance ? 1 : 0;
      }
    }
  }
  return count;
}

/// Sets an integrator with a step that it can take.
inline void set_integrator(BlockSettings& settings, Integrator integrator) {
  settings.integrator = integrator;
  switch (integrator) {
    case Integrator::explicit_euler:
      settings.time_step = 4e-7;
      break;
    case Integrator::inertial:
      settings.time_step = 4e-7;
      for (auto& kind : settings.kinds) kind.node_mass = 1e-6 * kind.node_drag;
      break;
    case Integrator::chebyshev:
      settings.stages = 10;
      settings.time_step = 1e-5;
      break;
    case Integrator::linearly_implicit:
    case Integrator::constant_operator:
    case Integrator::constant_operator_second_order:
      settings.time_step = 1e-3;
      break;
  }
}

inline bool is_implicit(Integrator integrator) {
  return integrator == Integrator::linearly_implicit ||
         integrator == Integrator::constant_operator ||
         integrator == Integrator::constant_operator_second_order;
}

}  // namespace hemoscale::test
