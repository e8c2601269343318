#pragma once

#include <complex>
#include <functional>
#include <numbers>
#include <vector>

#include "micro/vector.hpp"

namespace hemoscale::test {

/// Smooth closed curve z(t) = x + i y, t in [0, 2 pi), with derivatives: the Fourier series through
/// points at equal steps of t. Spectrally accurate; made for tests, not for speed.
class PeriodicCurve {
 public:
  explicit PeriodicCurve(const std::vector<micro::Vector<2>>& points) {
    const auto n = static_cast<int>(points.size());
    for (int k = -(n - 1) / 2; k <= (n - 1) / 2; ++k) {
      std::complex<double> sum = 0;
      for (int j = 0; j < n; ++j) {
        const auto& point = points[static_cast<std::size_t>(j)];
        sum += std::complex<double>(point.x(), point.y()) *
               std::polar(1.0, -2 * std::numbers::pi * k * j / n);
      }
      terms_.push_back({k, sum / static_cast<double>(n)});
    }
  }

  std::complex<double> at(double t, int derivative = 0) const {
    std::complex<double> sum = 0;
    for (const auto& [k, coefficient] : terms_) {
      std::complex<double> factor = 1;
      for (int d = 0; d < derivative; ++d) {
        factor *= std::complex<double>(0, k);
      }
      sum += factor * coefficient * std::polar(1.0, k * t);
    }
    return sum;
  }

  double speed(double t) const { return std::abs(at(t, 1)); }

  double curvature(double t) const {
    return (std::conj(at(t, 1)) * at(t, 2)).imag() / std::pow(speed(t), 3);
  }

  /// Distance of a point, by Newton's method from the parameter of a point of the curve nearby.
  double distance(const micro::Vector<2>& point, double t) const {
    const std::complex<double> p(point.x(), point.y());
    for (int i = 0; i < 6; ++i) {
      const std::complex<double> way = at(t) - p;
      const std::complex<double> slope = at(t, 1);
      t -=
          (std::conj(slope) * way).real() / (std::norm(slope) + (std::conj(at(t, 2)) * way).real());
    }
    return std::abs(at(t) - p);
  }

 private:
  struct Term {
    int k;
    std::complex<double> coefficient;
  };
  std::vector<Term> terms_;
};

/// Integral over one period by the trapezoidal rule, which converges faster than any power for
/// smooth functions.
inline double over_period(const std::function<double(double)>& f, int points = 2000) {
  double sum = 0;
  for (int i = 0; i < points; ++i) {
    sum += f(2 * std::numbers::pi * i / points);
  }
  return sum * 2 * std::numbers::pi / points;
}

}  // namespace hemoscale::test
