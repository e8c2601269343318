#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "micro/vector.hpp"

namespace hemoscale::micro {

/// A box whose opposite faces may be joined. With `slide`, the box is sheared: the image above the
/// upper face of the second axis lies shifted by `slide` along the first (Lees and Edwards 1972).
template <int dim>
struct PeriodicBox {
  Vector<dim> lower = Vector<dim>::Zero();  // [m]
  Vector<dim> upper = Vector<dim>::Zero();  // [m]
  std::array<bool, static_cast<std::size_t>(dim)> periodic =
      {};            // [-] without any, the box has no meaning
  double slide = 0;  // [m] needs both first axes periodic

  Vector<dim> extent() const { return upper - lower; }
  bool is_periodic() const {
    for (const bool joined : periodic) {
      if (joined) return true;
    }
    return false;
  }
};

/// Nearest image of `to`, seen from `from`: to - from.
/// @pre periodic extents are at least twice the distances of interest
template <int dim>
Vector<dim> separation(const PeriodicBox<dim>& box, const Vector<dim>& from,
                       const Vector<dim>& to) {
  Vector<dim> d = to - from;
  // The second axis first: crossing it shifts the image along the first.
  for (int axis = dim - 1; axis >= 0; --axis) {
    if (!box.periodic[static_cast<std::size_t>(axis)]) continue;
    const double extent = box.upper[axis] - box.lower[axis];
    const double turns = std::nearbyint(d[axis] / extent);
    d[axis] -= turns * extent;
    if (axis == 1) d[0] -= turns * box.slide;
  }
  return d;
}

/// The image of x in the box.
template <int dim>
Vector<dim> wrapped(const PeriodicBox<dim>& box, const Vector<dim>& x) {
  Vector<dim> y = x;
  for (int axis = dim - 1; axis >= 0; --axis) {
    if (!box.periodic[static_cast<std::size_t>(axis)]) continue;
    const double extent = box.upper[axis] - box.lower[axis];
    const double turns = std::floor((y[axis] - box.lower[axis]) / extent);
    y[axis] -= turns * extent;
    // Rounding may leave a tiny negative distance at the upper face.
    if (y[axis] >= box.upper[axis]) y[axis] = box.lower[axis];
    if (axis == 1) y[0] -= turns * box.slide;
  }
  return y;
}

}  // namespace hemoscale::micro
