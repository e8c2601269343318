#pragma once

#include <Eigen/Core>
#include <span>
#include <variant>
#include <vector>

#include "micro/immersed/ring_quadrature.hpp"
#include "micro/immersed/stokes_kernels.hpp"

namespace hemoscale::micro {

/// Which images of the cells move the fluid.
using StokesKernel = std::variant<PlaneKernel, PeriodicKernel>;

/// Velocity at the nodes of a ring by unit forces on them, as a matrix over (x_0, y_0, x_1, ...)
/// [m/s per N/m]: the single layer
///
///   u(x_i) = 1/(4 pi mu) sum_j G(x_i - x_j) F_j,   F_j force on node j per unit depth,
///
/// with the logarithm integrated as Kress 1991 does: spectral accuracy for smooth rings and forces.
/// Where another part of the ring is within three node spacings, as across a thin waist, what is
/// smooth beside the logarithm is summed over the refined points; the matrix is then symmetric up
/// to the error that is left, exp(-8 pi d / s) at the distance d with the nodes s apart.
/// @param viscosity  mu of the fluid outside [Pa s]
Eigen::MatrixXd single_layer(const RingQuadrature& quadrature, const RingContour& ring,
                             const StokesKernel& kernel, double viscosity);

/// Principal value of the double layer at the nodes of the ring, as a matrix [-]:
///
///   d_k(x_i) = 1/(4 pi) pv int u_j T_jkl(x - x_i) n_l ds
///
/// refined in the same places. A rigid velocity U gives -U/2.
Eigen::MatrixXd double_layer(const RingQuadrature& quadrature, const RingContour& ring,
                             const StokesKernel& kernel);

/// One ring as a source of flow, and the same with more nodes for places near it.
class RingSource {
 public:
  /// @param forces           [N/m] on the nodes
  /// @param velocities       [m/s] of the nodes; they count unless the ratio is 1
  /// @param viscosity_ratio  [-] inside over outside
  RingSource(const RingQuadrature& quadrature, const RingContour& ring,
             std::span<const Vector<2>> forces, std::span<const Vector<2>> velocities,
             double viscosity_ratio);

  /// Points of a trapezoidal sum.
  struct Points {
    std::vector<Vector<2>> positions;   // [m]
    std::vector<Vector<2>> forces;      // [N/m]
    std::vector<Vector<2>> normals;     // [m] times the arc length of a point
    std::vector<Vector<2>> velocities;  // [m/s]
  };
  const Points& coarse() const { return coarse_; }
  const Points& fine() const { return fine_; }
  double spacing() const { return spacing_; }  // [m] largest of the coarse points
  double viscosity_ratio() const { return viscosity_ratio_; }

 private:
  Points coarse_;
  Points fine_;
  double spacing_ = 0;
  double viscosity_ratio_ = 1;
};

/// Velocity and pressure at some places, or on all nodes of a domain.
struct FlowValues {
  std::vector<Vector<2>> velocities;  // [m/s]
  std::vector<double> pressures;      // [Pa]
};

/// Adds the flow of a ring at places off it: trapezoidal sums, whose relative error is
/// exp(-2 pi d / s) at the distance d with the points s apart; the fine ones serve within three
/// spacings. Inside the ring this is viscosity_ratio times the velocity. Same bits for any number
/// of threads.
/// @param viscosity  of the fluid outside [Pa s]
void add_ring_flow(const RingSource& source, const StokesKernel& kernel, double viscosity,
                   std::span<const Vector<2>> places, FlowValues& flow);

}  // namespace hemoscale::micro
