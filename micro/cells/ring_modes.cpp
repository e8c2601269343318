#include "micro/cells/ring_modes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "micro/error.hpp"

namespace hemoscale::micro {

namespace {

using Complex = std::complex<double>;

// Length of a segment from its start to t.
double arc_length(const RingCurve::Cubic& c, double t) {
  double length = 0;
  for (std::size_t k = 0; k < GaussRule::points.size(); ++k) {
    length += t * GaussRule::weights[k] * slope(c, t * GaussRule::points[k]).norm();
  }
  return length;
}

// c_k -> c_k exp(i (k shift + turn)) * factor: another origin of the arc length, another
// orientation, another size.
RingModes transformed(const RingModes& modes, double shift, double turn, double factor) {
  RingModes result = modes;
  for (int k = -modes.order; k <= modes.order; ++k) {
    result.coefficients[static_cast<std::size_t>(k + modes.order)] *=
        std::polar(factor, k * shift + turn);
  }
  return result;
}

}  // namespace

RingModes fourier_modes(const RingCurve& curve, int order) {
  const int highest = static_cast<int>(curve.segments()) / 3;
  if (order < 1 || order > highest) {
    throw ParameterError(
        fmt::format("{} Fourier modes of a ring of {} nodes; admissible are 1 to {}", order,
                    curve.segments(), highest));
  }
  double perimeter = 0;
  for (std::size_t i = 0; i < curve.segments(); ++i) perimeter += arc_length(curve.segment(i), 1);
  const double radius = perimeter / (2 * std::numbers::pi);
  RingModes modes;
  modes.order = order;
  modes.coefficients.assign(static_cast<std::size_t>(2 * order + 1), Complex(0));
  double start = 0;
  for (std::size_t i = 0; i < curve.segments(); ++i) {
    const RingCurve::Cubic& c = curve.segment(i);
    for (std::size_t p = 0; p < GaussRule::points.size(); ++p) {
      const double t = GaussRule::points[p];
      const double phase = (start + arc_length(c, t)) / radius;
      const double share = GaussRule::weights[p] * slope(c, t).norm() / perimeter;
      const Vector<2> r = value(c, t) / radius;
      for (int k = -order; k <= order; ++k) {
        modes.coefficients[static_cast<std::size_t>(k + order)] +=
            share * Complex(r.x(), r.y()) * std::polar(1.0, -k * phase);
      }
    }
    start += arc_length(c, 1);
  }
  return transformed(modes, -std::arg(modes(1)), 0, 1);
}

RingModes normalised(const RingModes& modes) {
  const double forward = std::arg(modes(1));
  const double backward = std::arg(modes(-1));
  RingModes result = transformed(modes, (backward - forward) / 2, -(forward + backward) / 2,
                                 1 / (std::abs(modes(1)) + std::abs(modes(-1))));
  result.coefficients[static_cast<std::size_t>(modes.order)] = 0;
  if (modes.order < 2) return result;
  double largest = 0;
  for (const Complex c : {result(2), result(-2)}) {
    for (const double part : {c.real(), c.imag()}) {
      if (std::abs(part) > std::abs(largest)) largest = part;
    }
  }
  return largest < 0 ? transformed(result, std::numbers::pi, std::numbers::pi, 1) : result;
}

}  // namespace hemoscale::micro
