#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "micro/immersed/kernel_function.hpp"
#include "micro/particles/node_bins.hpp"
#include "micro/particles/particle_set.hpp"

namespace hemoscale::micro {

/// Share of the fluid that belongs to each resting node [m^2]: the part of the domain that is
/// nearer to it than to any other, by 64 samples to a square spacing. On a lattice exact: l0^2, on
/// walls half of it.
std::vector<double> node_areas(const ParticleSet<2>& nodes, const NodeBins<2>& bins,
                               double spacing);

/// Weights w_i between one set of points X and the nodes x_i around each,
///
///   w_i = phi(r_x) phi(r_y) A_i / l0^2 (a + b . r),   r = (x_i - X) / l0,
///
/// with A_i the area of a node, and a, b such that sum w = 1 and sum w r = 0: constant and linear
/// fields are met exactly and forces and torques kept, next to walls too, where part of the kernel
/// is missing. In the bulk of a lattice a = 1, b = 0 (Peskin 2002).
struct KernelRows {
  std::vector<std::size_t> first = {0};  // of each point in the arrays below
  std::vector<std::size_t> nodes;
  std::vector<double> weights;  // [-]
};

/// Takes velocities from resting nodes to points, and forces from points to nodes with the same
/// weights: what the forces do at the points is what the fluid receives at the nodes,
///
///   sum_points F . (J u) = sum_nodes rho A (S F) . u.
class KernelTransfer {
 public:
  /// @throws ParameterError if the box slides or is too narrow
  KernelTransfer(const ParticleSet<2>& nodes, const PeriodicBox<2>& box, double spacing,
                 TransferKernel kernel);

  /// @throws NumericalError naming the point if the nodes around it do not determine the weights:
  ///         it is outside the domain
  KernelRows rows(std::span<const Vector<2>> points) const;

  /// (J u) at each point.
  std::vector<Vector<2>> interpolate(const KernelRows& rows,
                                     const std::vector<Vector<2>>& field) const;

  /// Adds (S F) = sum w F / (rho A) to the accelerations of the nodes [m/s^2].
  /// @param forces  [N/m] at each point
  void spread(const KernelRows& rows, std::span<const Vector<2>> forces, double density,
              std::vector<Vector<2>>& accelerations) const;

  const std::vector<double>& areas() const { return areas_; }

 private:
  double spacing_;
  TransferKernel kernel_;
  NodeBins<2> bins_;
  std::vector<double> areas_;  // [m^2]
};

}  // namespace hemoscale::micro
