#pragma once

#include <array>

#include "micro/vector.hpp"

namespace hemoscale::micro {

/// Second-order expansion of a given flow about a point:
///
///   u_i(x + d) = velocity_i + gradient_ij d_j + (1/2) second[i]_jk d_j d_k + O(|d|^3)
///
/// Exact for linear and parabolic flows. A cell is carried by one expansion about its frame, so
/// that the flow costs one evaluation per cell instead of one per node.
struct LocalFlow {
  Vector<2> velocity = Vector<2>::Zero();                 // [m/s]
  Tensor<2> gradient = Tensor<2>::Zero();                 // [1/s] L(i,j) = d u_i / d x_j
  std::array<Tensor<2>, 2> second = {Tensor<2>::Zero(),   // [1/(m s)] of u_x, symmetric
                                     Tensor<2>::Zero()};  // [1/(m s)] of u_y, symmetric
};

/// A flow that the cells do not change. Immutable: it may be asked from several threads at once.
class GivenFlow {
 public:
  virtual ~GivenFlow() = default;

  /// Expansion about x [m] at a time [s]. Outside the fluid the flow is continued smoothly.
  virtual LocalFlow at(const Vector<2>& x, double time) const = 0;

  /// Whether `at` does not depend on the time.
  virtual bool is_steady() const = 0;

  /// Upper bound on sqrt(2 D:D) in the fluid at any time [1/s]; it decides how often lists are
  /// rebuilt, never a result.
  virtual double largest_shear_rate() const = 0;

  /// Upper bound on the speed in the fluid at any time [m/s].
  virtual double largest_speed() const = 0;
};

}  // namespace hemoscale::micro
