#include "macro/viscosity/monotone_slopes.hpp"

#include <cmath>
#include <cstddef>

namespace hemoscale::macro {

namespace {

struct Intervals {
  std::vector<double> widths;
  std::vector<double> secants;
};

Intervals intervals(const std::vector<double>& x, const std::vector<double>& y) {
  Intervals result;
  for (std::size_t i = 0; i + 1 < x.size(); ++i) {
    result.widths.push_back(x[i + 1] - x[i]);
    result.secants.push_back((y[i + 1] - y[i]) / result.widths.back());
  }
  return result;
}

// Derivative of the parabola through three knots at the middle one and at the outer one of interval
// `near`, where `far` is the other interval.
double parabola_inside(double h0, double h1, double d0, double d1) {
  return (h1 * d0 + h0 * d1) / (h0 + h1);
}
double parabola_at_end(double h_near, double h_far, double d_near, double d_far) {
  return d_near + h_near * (d_near - d_far) / (h_near + h_far);
}

std::vector<double> parabolic_slopes(const Intervals& of) {
  const std::vector<double>& h = of.widths;
  const std::vector<double>& d = of.secants;
  const std::size_t last = h.size();
  if (last == 1) return {d[0], d[0]};
  std::vector<double> slopes(last + 1);
  slopes[0] = parabola_at_end(h[0], h[1], d[0], d[1]);
  slopes[last] = parabola_at_end(h[last - 1], h[last - 2], d[last - 1], d[last - 2]);
  for (std::size_t i = 1; i < last; ++i) {
    slopes[i] = parabola_inside(h[i - 1], h[i], d[i - 1], d[i]);
  }
  return slopes;
}

}  // namespace

std::vector<double> monotone_slopes(const std::vector<double>& x, const std::vector<double>& y) {
  if (x.size() < 2) return std::vector<double>(x.size(), 0.0);
  const Intervals of = intervals(x, y);
  std::vector<double> slopes = parabolic_slopes(of);
  for (std::size_t i = 0; i < of.secants.size(); ++i) {
    const double secant = of.secants[i];
    for (const std::size_t knot : {i, i + 1}) {
      if (slopes[knot] * secant <= 0) slopes[knot] = 0;
    }
  }
  // Scaling towards zero keeps the neighbouring interval inside its region: one pass is enough.
  for (std::size_t i = 0; i < of.secants.size(); ++i) {
    const double limit = 3 * std::abs(of.secants[i]);
    const double length = std::hypot(slopes[i], slopes[i + 1]);
    if (length > limit) {
      slopes[i] *= limit / length;
      slopes[i + 1] *= limit / length;
    }
  }
  return slopes;
}

}  // namespace hemoscale::macro
