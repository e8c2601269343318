#include "micro/linear/vector_operations.hpp"

#include <cstddef>

namespace hemoscale::micro {
namespace {

constexpr std::size_t worth_threads = 32768;  // elements

}  // namespace

void add(double factor, std::span<const double> x, std::span<double> y) {
#pragma omp parallel for schedule(static) if (y.size() > worth_threads)
  for (std::size_t i = 0; i < y.size(); ++i) {
    y[i] += factor * x[i];
  }
}

void combine(std::span<const double> x, double factor, std::span<double> y) {
#pragma omp parallel for schedule(static) if (y.size() > worth_threads)
  for (std::size_t i = 0; i < y.size(); ++i) {
    y[i] = x[i] + factor * y[i];
  }
}

void scale(double factor, std::span<double> y) {
#pragma omp parallel for schedule(static) if (y.size() > worth_threads)
  for (double& each : y) {
    each *= factor;
  }
}

void subtract(std::span<const double> a, std::span<const double> b, std::span<double> y) {
#pragma omp parallel for schedule(static) if (y.size() > worth_threads)
  for (std::size_t i = 0; i < y.size(); ++i) {
    y[i] = a[i] - b[i];
  }
}

}  // namespace hemoscale::micro
