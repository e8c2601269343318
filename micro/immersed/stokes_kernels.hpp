#pragma once

#include <Eigen/Core>
#include <cmath>
#include <numbers>

#include "micro/vector.hpp"

namespace hemoscale::micro {

/// Value and derivatives of the harmonic function A of which the plane Stokes kernels are made,
/// grad^2 A = 2 pi delta: A_xx = -A_yy.
struct LogPotential {
  double value = 0;  // [-] A
  double x = 0;      // [1/m] A_x
  double y = 0;      // [1/m] A_y
  double xy = 0;     // [1/m^2] A_xy
  double yy = 0;     // [1/m^2] A_yy
};

/// Point forces in the plane: A = ln r (r in m; a constant moves no fluid if the forces sum to
/// zero).
struct PlaneKernel {
  LogPotential operator()(const Vector<2>& r) const {
    const double square = r.squaredNorm();
    const double inverse = 1 / square;
    return {.value = 0.5 * std::log(square),
            .x = r.x() * inverse,
            .y = r.y() * inverse,
            .xy = -2 * r.x() * r.y() * inverse * inverse,
            .yy = (r.x() - r.y()) * (r.x() + r.y()) * inverse * inverse};
  }

  /// Limit of A - ln r at r = 0.
  double remainder() const { return 0; }

  /// Distance to the nearest image of a point at distance r.
  Vector<2> nearest(const Vector<2>& r) const { return r; }
};

/// Rows of point forces at distances `period` along x [Pozrikidis1992, section 3.5]:
/// A = ln(2 (cosh k y - cos k x)) / 2, k = 2 pi / period.
struct PeriodicKernel {
  double period = 0;  // [m]

  LogPotential operator()(const Vector<2>& r) const {
    const double k = 2 * std::numbers::pi / period;
    const double x = k * r.x();
    const double y = k * r.y();
    // cosh y - cos x without cancellation at small distances.
    const double half_sinh = std::sinh(0.5 * y);
    const double half_sin = std::sin(0.5 * x);
    const double d = 2 * (half_sinh * half_sinh + half_sin * half_sin);
    const double sinh = std::sinh(y);
    const double sin = std::sin(x);
    return {.value = 0.5 * std::log(2 * d),
            .x = 0.5 * k * sin / d,
            .y = 0.5 * k * sinh / d,
            .xy = -0.5 * k * k * sin * sinh / (d * d),
            // (cosh y d - sinh^2 y) / d^2, d = cosh y - cos x
            .yy = 0.5 * k * k * (1 - std::cosh(y) * std::cos(x)) / (d * d)};
  }

  double remainder() const { return std::log(2 * std::numbers::pi / period); }
  Vector<2> nearest(const Vector<2>& r) const {
    return {r.x() - period * std::nearbyint(r.x() / period), r.y()};
  }
};

/// Velocity of a point force, u = G f / (4 pi mu):
///
///   G_xx = 1 - A - y A_y,   G_xy = G_yx = y A_x,   G_yy = -A + y A_y,
///
/// in the free plane -ln r + r r^T / r^2. @param y  second component of the distance [m]
inline Eigen::Matrix2d stokeslet(const LogPotential& a, double y) {
  Eigen::Matrix2d g;
  g << 1 - a.value - y * a.y, y * a.x, y * a.x, -a.value + y * a.y;
  return g;
}

/// Stress of a point force contracted with a direction, T_ijk n_k [1/m] (in the free plane
/// -4 r_i r_j r_k n_k / r^4):
///
///   T_111 = -4 A_x - 2 y A_xy,  T_112 = -2 A_y - 2 y A_yy,  T_122 = 2 y A_xy,
///   T_222 = -2 A_y + 2 y A_yy.
inline Eigen::Matrix2d stresslet(const LogPotential& a, double y, const Vector<2>& n) {
  const double t30 = -4 * a.x - 2 * y * a.xy;
  const double t21 = -2 * a.y - 2 * y * a.yy;
  const double t12 = 2 * y * a.xy;
  const double t03 = -2 * a.y + 2 * y * a.yy;
  Eigen::Matrix2d t;
  t << t30 * n.x() + t21 * n.y(), t21 * n.x() + t12 * n.y(), t21 * n.x() + t12 * n.y(),
      t12 * n.x() + t03 * n.y();
  return t;
}

/// Pressure of a point force, p = P f / (4 pi): P = 2 grad A [1/m].
inline Vector<2> pressure_of_force(const LogPotential& a) {
  return {2 * a.x, 2 * a.y};
}

/// Pressure of a stresslet distribution, p = mu u_i P_ik n_k / (4 pi): P = -4 grad grad A [1/m^2].
inline Vector<2> pressure_of_stresslet(const LogPotential& a, const Vector<2>& n) {
  return {4 * (a.yy * n.x() - a.xy * n.y()), -4 * (a.xy * n.x() + a.yy * n.y())};
}

}  // namespace hemoscale::micro
