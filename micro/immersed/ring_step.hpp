#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "micro/cells/ring_membrane.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// One implicit step of one ring in a flow that answers its forces at once:
///
///   rate X - known = ambient + W F(X, tau) + beta n,     W mobility of the ring,
///   F = -dE/dX - sum_k tau_k dl_k/dX,                    E bending (and area penalty),
///   (l_k - l0_k) / l0_k = compliance_k tau_k,            stretch; compliance 0: inextensible,
///   A(X) = A0                                            exact area: beta n makes up for what the
///                                                        discrete flow leaks; else beta = 0.
///
/// Tensions are unknowns of their own, so that the stiffness of the segments sets no limit.
struct RingStep {
  const RingMembrane* resistance = nullptr;   // the laws but stretch
  std::span<const double> compliances;        // [m/N] of the segments
  double rate = 0;                            // [1/s]
  std::span<const Vector<2>> known;           // [m/s]
  std::span<const Vector<2>> ambient;         // [m/s]
  const Eigen::MatrixXd* mobility = nullptr;  // [m/s per N/m] over (x_0, y_0, x_1, ...)
  std::span<const Vector<2>> normals;         // [-] outwards
  bool holds_area = true;
  double friction = 0;  // [Pa s] viscosity that scales the equations
};

struct RingUnknowns {
  std::vector<Vector<2>> positions;  // [m]
  std::vector<double> tensions;      // [N/m] of the segments, positive where pulled
  double leak = 0;                   // [m/s] beta
};

struct RingReport {
  int iterations = 0;
  int factorisations = 0;
  double change = 0;  // [-] of the last iteration, over the size of the ring
};

/// Elastic force on every node [N/m].
std::vector<Vector<2>> elastic_forces(const RingMembrane& resistance,
                                      std::span<const Vector<2>> positions,
                                      std::span<const double> tensions);

/// Newton's method from the given unknowns, with the full rotation-invariant Jacobian but for the
/// geometric stiffness of compressed segments, which is left out.
/// @throws NumericalError if it does not converge
RingReport solve_ring(const RingStep& step, RingUnknowns& unknowns);

}  // namespace hemoscale::micro
