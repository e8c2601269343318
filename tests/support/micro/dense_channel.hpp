#pragma once

#include <cmath>
#include <cstddef>
#include <memory>
#include <numbers>
#include <random>
#include <vector>

#include "micro/cells/outline.hpp"
#include "micro/ensemble/blocks/block_settings.hpp"
#include "micro/ensemble/flow/parallel_flow.hpp"
#include "micro/ensemble/pair_potential.hpp"
#include "micro/ensemble/state.hpp"

// Ensembles for block kernels in which cells soon meet.
namespace hemoscale::test {

struct DenseChannel {
  micro::blocks::BlockSettings settings;
  micro::EnsembleState state;
};

/// Cells in columns and rows, tilted a little, between walls in a parabolic flow; their ends touch
/// from the start.
/// @param speed  [m/s] on the axis
inline DenseChannel dense_channel(int columns, int rows, int nodes = 60, double speed = 20e-6) {
  using namespace micro;
  constexpr double eta = 1.2e-3;   // [Pa s]
  const double pitch_x = 8.15e-6;  // [m]
  const double pitch_y = 3.4e-6;
  const double margin = 0.5e-6;
  DenseChannel channel;
  blocks::BlockSettings& s = channel.settings;
  s.length = columns * pitch_x;
  s.height = rows * pitch_y + 2 * margin;
  const auto outline = outline_nodes({}, nodes);
  MembraneParameters membrane;
  membrane.stretch_modulus = 5e-6;
  membrane.bending_modulus = 2e-19;
  membrane.area_modulus = 5;
  blocks::KindSettings kind;
  kind.mesh = make_ring_mesh(outline, NaturalShape::outline);
  kind.laws = make_membrane_laws(membrane);
  kind.node_drag = 12 * eta / nodes;
  s.kinds = {kind};
  s.contact = make_pair_potential(0.25, 0.3e-6, 0.5e-6, 0.05);
  s.plane_walls = WallPotential{1.0, 0.3e-6};
  VelocityProfile profile;
  profile.height = s.height;
  for (int i = 0; i <= 20; ++i) profile.velocities.push_back(speed * 4 * i * (20 - i) / 400);
  s.flow = std::make_shared<ParallelFlow>(profile);
  s.time_step = 1e-3;

  channel.state.cells = static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows);
  channel.state.nodes = static_cast<std::size_t>(nodes);
  std::mt19937 generator(1);
  for (int column = 0; column < columns; ++column) {
    for (int row = 0; row < rows; ++row) {
      const double angle = 0.05 * (static_cast<double>(generator()) / 4294967296.0 - 0.5);
      const Vector<2> centre{(column + 0.5) * pitch_x, margin + (row + 0.5) * pitch_y};
      for (const Vector<2>& p : outline) {
        channel.state.x.push_back(centre.x() + std::cos(angle) * p.x() - std::sin(angle) * p.y());
        channel.state.y.push_back(centre.y() + std::sin(angle) * p.x() + std::cos(angle) * p.y());
      }
    }
  }
  return channel;
}

/// The same cells in simple shear, periodic in both directions.
inline DenseChannel dense_shear(int columns, int rows, int nodes = 60) {
  DenseChannel channel = dense_channel(columns, rows, nodes);
  channel.settings.plane_walls.reset();
  channel.settings.periodic_y = true;
  channel.settings.flow = std::make_shared<micro::SimpleShearFlow>(2, channel.settings.height);
  return channel;
}

/// Root mean square distance of nodes [m].
inline double rms_distance(const micro::EnsembleState& a, const micro::EnsembleState& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.x.size(); ++i) {
    sum += std::pow(a.x[i] - b.x.at(i), 2) + std::pow(a.y[i] - b.y.at(i), 2);
  }
  return std::sqrt(sum / static_cast<double>(a.x.size()));
}

}  // namespace hemoscale::test
