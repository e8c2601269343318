#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "micro/ensemble/flow/given_flow.hpp"
#include "micro/ensemble/flow/grid_samples.hpp"
#include "micro/ensemble/flow/wall_geometry.hpp"

namespace hemoscale::micro {

/// Divergence of a flow at the nodes in the fluid [1/s].
struct Divergence {
  double rms = 0;
  double largest = 0;
};

/// Steady flow between the nodes of a grid: bicubic polynomials of Hermite that are once
/// continuously differentiable,
///
///   u(s, t) = sum over the corners of H(s) H(t) {u, u_x, u_y, u_xy}.
///
/// The derivatives at the nodes are differences of fourth order where two neighbours on either side
/// are known, one-sided of third order otherwise. Known are the nodes in the fluid and those of the
/// layers around it to which the flow is continued (grid_extension.hpp). Velocities are of fourth
/// order in the spacing inside, of third order at walls; gradients are one order less, second
/// derivatives two. The flow rests at nodes further out; beyond the grid it is that of the nearest
/// point of the grid.
class GridFlow final : public GivenFlow {
 public:
  /// @param walls  where the fluid rests; null: unknown
  /// @throws ParameterError  see check(GridSamples)
  explicit GridFlow(const GridSamples& samples, const WallGeometry* walls = nullptr);

  LocalFlow at(const Vector<2>& x, double time) const override;
  bool is_steady() const override { return true; }
  double largest_shear_rate() const override { return largest_shear_rate_; }
  double largest_speed() const override { return largest_speed_; }

  /// Of the nodes in the fluid. A flow without sources has one that vanishes with the spacing.
  const Divergence& divergence() const { return divergence_; }

 private:
  /// One component at a node: value, derivative along x, along y, along both, in units of the
  /// spacing.
  using Corner = std::array<double, 4>;
  struct Node {
    std::array<Corner, 2> components = {};
  };

  void differentiate(const std::vector<bool>& is_known);
  void measure_divergence(const GridSamples& samples);
  void bound(const GridSamples& samples);
  const Node& node(std::size_t column, std::size_t row) const {
    return nodes_[row * columns_ + column];
  }

  Vector<2> origin_ = Vector<2>::Zero();  // [m]
  double spacing_ = 0;                    // [m]
  std::size_t columns_ = 0;
  std::size_t rows_ = 0;
  std::vector<Node> nodes_;
  Divergence divergence_;
  double largest_shear_rate_ = 0;  // [1/s]
  double largest_speed_ = 0;       // [m/s]
};

}  // namespace hemoscale::micro
