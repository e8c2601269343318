#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <vector>

#include "micro/ensemble/blocks/aligned_array.hpp"
#include "micro/ensemble/blocks/kernel_arguments.hpp"
#include "micro/ensemble/blocks/kernel_versions.hpp"
#include "micro/ensemble/ring_forces.hpp"
#include "micro/random/philox.hpp"
#include "tests/support/micro/rings.hpp"

// Single blocks of cells, to call kernels of the block ensemble without the ensemble.
namespace hemoscale::test {

namespace blocks = micro::blocks;
using blocks::AlignedArray;
using blocks::Kernels;

inline constexpr double um = 1e-6;  // [m]

/// Versions of the kernels that this processor runs.
template <class Real>
std::vector<const Kernels<Real>*> kernel_versions() {
  const auto pick = [](const Kernels<float>& single, const Kernels<double>& twofold) {
    if constexpr (sizeof(Real) == sizeof(float)) {
      return &single;
    } else {
      return &twofold;
    }
  };
  std::vector<const Kernels<Real>*> found = {
      pick(blocks::plain::single_kernels, blocks::plain::double_kernels)};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("x86-64-v3") != 0) {
    found.push_back(pick(blocks::v3::single_kernels, blocks::v3::double_kernels));
  }
  if (__builtin_cpu_supports("x86-64-v4") != 0) {
    found.push_back(pick(blocks::v4::single_kernels, blocks::v4::double_kernels));
  }
#endif
  return found;
}

/// A closed line of the size of a red cell with dents: smooth waves, and nodes off it by a fraction
/// of their spacing. [m]
inline Polygon dented_polygon(int nodes, std::uint64_t seed, double waves = 0.15,
                              double roughness = 0.05) {
  const auto draw = [&](std::uint64_t stream, std::uint64_t counter) {
    return micro::uniform({seed, stream, counter}) - 0.5;
  };
  const double spacing = 2 * std::numbers::pi * 3 / nodes;
  Polygon polygon;
  for (int i = 0; i < nodes; ++i) {
    const double angle = 2 * std::numbers::pi * i / nodes;
    double radius = 3;
    for (std::uint64_t k = 2; k < 6; ++k) {
      radius += 6 * waves / static_cast<double>(k) * draw(0, k) *
                std::cos(static_cast<double>(k) * angle + 6.28 * draw(1, k));
    }
    const auto counter = static_cast<std::uint64_t>(i);
    polygon.emplace_back(
        (radius * std::cos(angle) + 2 * roughness * spacing * draw(2, counter)) * um,
        (0.8 * radius * std::sin(angle) + 2 * roughness * spacing * draw(3, counter)) * um);
  }
  return polygon;
}

/// A block of cells of one kind with all that a step needs. Lengths as in the kernels: micrometres.
template <class Real>
struct KernelBlock {
  static constexpr std::size_t width = 64 / sizeof(Real);

  /// @param tau  [m/N Pa s] dt / zeta in SI
  KernelBlock(const micro::RingMesh& mesh, const micro::MembraneLaws& laws, double tau)
      : nodes(static_cast<std::size_t>(mesh.nodes)), tau_over_um(tau / um) {
    const auto* half = std::get_if<micro::HalfAngleBending>(&laws.bending);
    const double modulus = half != nullptr
                               ? half->modulus
                               : std::get<micro::TurningAngleBending>(laws.bending).modulus;
    half_angle = half != nullptr;
    for (std::size_t i = 0; i < nodes; ++i) {
      rest.push_back(static_cast<Real>(mesh.rest_length[i] / um));
      inverse_rest.push_back(static_cast<Real>(um / mesh.rest_length[i]));
      bending.push_back(static_cast<Real>(tau * modulus / mesh.node_length[i] / (um * um)));
      natural.push_back(
          static_cast<Real>(half_angle ? mesh.natural_half_tangent[i] : mesh.natural_angle[i]));
    }
    ring = {.nodes = mesh.nodes,
            .rest = rest.data(),
            .inverse_rest = inverse_rest.data(),
            .bending = bending.data(),
            .natural = natural.data(),
            .stretch = static_cast<Real>(tau * laws.stretch.modulus / um),
            .area = static_cast<Real>(tau * laws.area.modulus / mesh.rest_area * um * um),
            .rest_area = static_cast<Real>(mesh.rest_area / (um * um))};
    for (auto* array : {&x, &y, &memory_x, &memory_y, &force_x, &force_y, &kxx, &kxy, &kyy}) {
      array->assign(nodes * width, 0);
    }
    area.assign(width, 0);
    frame_y.assign(width, 0);
    flow.assign(10 * width, 0);
    extremes.assign(3 * width, 0);
    scratch.assign(blocks::implicit_scratch_rows * nodes * width, 0);
  }
  KernelBlock(const KernelBlock&) = delete;
  KernelBlock& operator=(const KernelBlock&) = delete;

  /// Puts a cell into a lane.
  void set(std::size_t lane, const Polygon& polygon) {
    double twice = 0;
    for (std::size_t i = 0; i < nodes; ++i) {
      const auto& a = polygon[i];
      const auto& b = polygon[i + 1 == nodes ? 0 : i + 1];
      x[i * width + lane] = static_cast<Real>(a.x() / um);
      y[i * width + lane] = static_cast<Real>(a.y() / um);
      twice += a.x() * b.y() - b.x() * a.y();
    }
    area[lane] = static_cast<Real>(0.5 * twice / (um * um));
  }
  /// The cell of a lane as the kernel sees it, exactly [m].
  Polygon get(std::size_t lane) const {
    Polygon polygon;
    for (std::size_t i = 0; i < nodes; ++i) {
      polygon.emplace_back(static_cast<double>(x[i * width + lane]) * um,
                           static_cast<double>(y[i * width + lane]) * um);
    }
    return polygon;
  }

  blocks::BlockArguments<Real> arguments() {
    blocks::BlockArguments<Real> g;
    g.ring = &ring;
    g.walls = walls;
    g.x = x.data();
    g.y = y.data();
    g.memory_x = memory_x.data();
    g.memory_y = memory_y.data();
    g.area = area.data();
    g.frame_y = frame_y.data();
    g.flow = flow.data();
    g.force_x = force_x.data();
    g.force_y = force_y.data();
    g.stiffness_xx = kxx.data();
    g.stiffness_xy = kxy.data();
    g.stiffness_yy = kyy.data();
    g.scratch = scratch.data();
    g.extremes = extremes.data();
    return g;
  }

  /// Displacement by the given flow in the step, at an offset [um].
  micro::Vector<2> flow_at(std::size_t lane, double dx, double dy) const {
    const auto row = [&](std::size_t k) { return static_cast<double>(flow[k * width + lane]); };
    return {row(0) * dx + row(1) * dy + row(4) * dx * dx + row(5) * dx * dy + row(6) * dy * dy,
            row(2) * dx + row(3) * dy + row(7) * dx * dx + row(8) * dx * dy + row(9) * dy * dy};
  }

  /// Force of the walls on a node, times tau, and its stiffness [um], [-].
  micro::Vector<2> wall_at(std::size_t lane, double dy) const {
    const double h = static_cast<double>(frame_y[lane]) + dy;
    const auto k = static_cast<double>(walls.stiffness);
    const double below = static_cast<double>(walls.range) - h;
    const double above = static_cast<double>(walls.range) - (static_cast<double>(walls.height) - h);
    return {k * (std::max(below, 0.0) - std::max(above, 0.0)),
            k * ((below > 0 ? 1 : 0) + (above > 0 ? 1 : 0))};
  }

  std::size_t nodes;
  double tau_over_um;
  bool half_angle = false;
  AlignedArray<Real> rest, inverse_rest, bending, natural;
  blocks::RingTables<Real> ring;
  blocks::PlaneWalls<Real> walls;
  AlignedArray<Real> x, y, memory_x, memory_y, force_x, force_y, kxx, kxy, kyy;
  AlignedArray<Real> area, frame_y, flow, extremes, scratch;
};

/// How a block is set for a comparison.
struct BlockSituation {
  bool parallel_flow = true;
  bool walls = false;
  blocks::KernelChoice choice(bool half_angle) const { return {half_angle, parallel_flow, walls}; }
};

/// Flow, walls and forces of contacts at random, of the size of `scale` [um].
template <class Real>
void disturb(KernelBlock<Real>& block, const BlockSituation& situation, double scale,
             std::uint64_t seed) {
  const std::size_t width = KernelBlock<Real>::width;
  const auto draw = [&](std::uint64_t stream, std::size_t counter) {
    return 2 * micro::uniform({seed, stream, counter}) - 1;
  };
  for (std::size_t k = 0; k < 10; ++k) {
    if (situation.parallel_flow && k != 1 && k != 6) continue;
    for (std::size_t lane = 0; lane < width; ++lane) {
      block.flow[k * width + lane] =
          static_cast<Real>(scale * (k < 4 ? 0.3 : 0.1) * draw(10 + k, lane));
    }
  }
  for (std::size_t i = 0; i < block.force_x.size(); ++i) {
    block.force_x[i] = static_cast<Real>(scale * draw(20, i));
    block.force_y[i] = static_cast<Real>(scale * draw(21, i));
  }
  if (situation.walls) {
    // So narrow that cells reach both walls, or through them.
    block.walls = {.stiffness = static_cast<Real>(2 * scale),
                   .range = static_cast<Real>(0.7),
                   .height = static_cast<Real>(4.7)};
    for (std::size_t lane = 0; lane < width; ++lane) {
      block.frame_y[lane] = static_cast<Real>(2.3 + 0.5 * draw(22, lane));
    }
  }
}

/// Given to every typed test of kernels.
using Reals = testing::Types<float, double>;

}  // namespace hemoscale::test
