#include "coupling/study/order_fit.hpp"

#include <cassert>
#include <cmath>
#include <cstddef>

namespace hemoscale::coupling {

namespace {

bool counts(double value) {
  return std::isfinite(value) && value > 0;
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

}  // namespace

OrderFit fit_order(std::span<const double> refinements, std::span<const double> errors) {
  assert(refinements.size() == errors.size());
  std::vector<double> x;
  std::vector<double> y;
  for (std::size_t i = 0; i < refinements.size(); ++i) {
    if (!counts(refinements[i]) || !counts(errors[i])) continue;
    x.push_back(std::log(refinements[i]));
    y.push_back(std::log(errors[i]));
  }
  OrderFit fit;
  fit.points = static_cast<int>(x.size());
  if (x.size() < 2) return fit;
  const double sign = x.back() > x.front() ? -1 : 1;
  const double x_mean = mean(x);
  const double y_mean = mean(y);
  double spread = 0;
  double product = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    spread += (x[i] - x_mean) * (x[i] - x_mean);
    product += (x[i] - x_mean) * (y[i] - y_mean);
    if (i > 0) fit.pairwise.push_back(sign * (y[i] - y[i - 1]) / (x[i] - x[i - 1]));
  }
  if (spread == 0) return fit;
  const double slope = product / spread;
  fit.order = sign * slope;
  if (x.size() < 3) return fit;
  double residuals = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double residual = y[i] - y_mean - slope * (x[i] - x_mean);
    residuals += residual * residual;
  }
  fit.standard_error = std::sqrt(residuals / (static_cast<double>(x.size() - 2) * spread));
  return fit;
}

}  // namespace hemoscale::coupling
