#include "macro/analytic/womersley.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <vector>

#include "macro/analytic/poiseuille.hpp"

namespace hemoscale::macro {
namespace {

constexpr double pi = 3.14159265358979323846;

// Unit half-height or radius, viscosity, density and amplitude: u is then a function of alpha.
WomersleyChannel<2> channel(double alpha) {
  return WomersleyChannel<2>(WomersleyChannelProfile{2, 0, 1, alpha * alpha, 1, 1});
}
WomersleyPipe pipe(double alpha) {
  return WomersleyPipe(WomersleyPipeProfile{1, 0, 1, alpha * alpha, 1, 1});
}

// Complex amplitude U of u = Re(U exp(i omega t)), from two times a quarter period apart.
std::complex<double> amplitude(const WomersleyChannel<2>& flow, double eta) {
  const double quarter = 0.5 * pi / flow.profile().angular_frequency;
  return {flow.at({0, 1 + eta}, 0)->velocity[0], -flow.at({0, 1 + eta}, quarter)->velocity[0]};
}
std::complex<double> amplitude(const WomersleyPipe& flow, double xi) {
  const double quarter = 0.5 * pi / flow.profile().angular_frequency;
  return {flow.at({0, xi, 0}, 0)->velocity[0], -flow.at({0, xi, 0}, quarter)->velocity[0]};
}

// Largest deviation from the quasi-steady parabola over its maximum.
double channel_deviation(double alpha) {
  double largest = 0;
  for (int i = -20; i <= 20; ++i) {
    const double eta = i / 20.0;
    largest = std::max(largest, std::abs(amplitude(channel(alpha), eta) - 0.5 * (1 - eta * eta)));
  }
  return largest / 0.5;
}
double pipe_deviation(double alpha) {
  double largest = 0;
  for (int i = 0; i <= 20; ++i) {
    const double xi = i / 20.0;
    largest = std::max(largest, std::abs(amplitude(pipe(alpha), xi) - 0.25 * (1 - xi * xi)));
  }
  return largest / 0.25;
}

TEST(Womersley, is_quasi_steady_for_small_alpha_with_an_error_of_second_order) {
  for (const auto& deviation : {channel_deviation, pipe_deviation}) {
    for (const double alpha : {2e-3, 2e-2, 0.2}) {
      const double order = std::log2(deviation(alpha) / deviation(0.5 * alpha));
      EXPECT_NEAR(order, 2, 0.02) << alpha;
    }
  }
  // The phase lag at the axis: 5 alpha^2 / 12 between plates, 3 alpha^2 / 16 in a pipe.
  EXPECT_NEAR(-std::arg(amplitude(channel(1e-2), 0)) / 1e-4, 5.0 / 12, 1e-6);
  EXPECT_NEAR(-std::arg(amplitude(pipe(1e-2), 0)) / 1e-4, 3.0 / 16, 1e-6);
}

TEST(Womersley, is_a_plug_with_stokes_layers_for_large_alpha) {
  for (const double alpha : {300.0, 9e3}) {
    const double plug = 1 / (alpha * alpha);
    const std::complex<double> i(0, 1);
    for (const double layers : {0.5, 1.0, 4.0}) {
      const std::complex<double> stokes = -i * plug * (1.0 - std::exp(-std::sqrt(i) * layers));
      const double distance = layers / alpha;
      EXPECT_LT(std::abs(amplitude(channel(alpha), 1 - distance) - stokes), 1e-11 * plug);
      // The wall of a pipe is curved: the layer feels it in first order of its thickness.
      EXPECT_LT(std::abs(amplitude(pipe(alpha), 1 - distance) - stokes), 4 / alpha * plug);
    }
    EXPECT_LT(std::abs(amplitude(channel(alpha), 0) + i * plug), 1e-12 * plug);
    EXPECT_LT(std::abs(amplitude(pipe(alpha), 0) + i * plug), 1e-12 * plug);
  }
}

TEST(Womersley, channel_satisfies_the_textbook_formula) {
  const std::complex<double> i(0, 1);
  for (const double alpha : {0.5, 3.0, 12.0}) {
    const std::complex<double> q = std::sqrt(i) * alpha;
    for (const double eta : {-0.9, -0.2, 0.0, 0.55, 1.0}) {
      const std::complex<double> exact =
          (1.0 - std::cosh(q * eta) / std::cosh(q)) / (i * alpha * alpha);
      EXPECT_LT(std::abs(amplitude(channel(alpha), eta) - exact), 1e-14);
    }
  }
}

// 1 - I_0(q xi) / I_0(q) with the power series in extended precision.
std::complex<long double> long_bessel(long double x) {
  std::complex<long double> term = 1;
  std::complex<long double> sum = 0;
  const std::complex<long double> quarter(0, x * x / 4);
  for (int k = 1; k < 200; ++k) {
    sum += term;
    term *= quarter / (static_cast<long double>(k) * k);
  }
  return sum;
}

TEST(Womersley, pipe_satisfies_the_textbook_formula) {
  const std::complex<double> i(0, 1);
  for (const double alpha : {0.5, 3.0, 12.0, 17.99, 18.01, 24.0, 30.0}) {
    for (const double xi : {0.0, 0.3, 0.77, 0.99, 1.0}) {
      const long double wall = static_cast<long double>(alpha);
      const std::complex<double> ratio(long_bessel(wall * static_cast<long double>(xi)) /
                                       long_bessel(wall));
      const std::complex<double> exact = (1.0 - ratio) / (i * alpha * alpha);
      EXPECT_LT(std::abs(amplitude(pipe(alpha), xi) - exact), 1e-12 / (alpha * alpha) + 1e-15)
          << alpha << " " << xi;
    }
  }
}

TEST(Womersley, velocity_next_to_the_wall_keeps_its_relative_accuracy) {
  for (const double alpha : {1e-3, 1.0, 15.0, 300.0}) {
    for (const double t : {0.0, 1.3 / (alpha * alpha)}) {
      const double y = 1e-10;
      const double gradient = channel(alpha).at({0, 0}, t)->velocity_gradient(0, 1);
      EXPECT_NEAR(channel(alpha).at({0, y}, t)->velocity[0] / (y * gradient), 1, 1e-7) << alpha;
    }
  }
  for (const double alpha : {1e-3, 1.0, 15.0}) {
    const double r = 1 - 1e-10;
    const double gradient = pipe(alpha).at({0, 1, 0}, 0)->velocity_gradient(0, 1);
    EXPECT_NEAR(pipe(alpha).at({0, r, 0}, 0)->velocity[0] / ((r - 1) * gradient), 1, 1e-7) << alpha;
  }
}

TEST(Womersley, steady_part_adds_up) {
  const WomersleyChannel<2> both(WomersleyChannelProfile{2, 5, 3, 7, 1, 1});
  const WomersleyChannel<2> oscillating(WomersleyChannelProfile{2, 0, 3, 7, 1, 1});
  const PlanePoiseuille<2> steady(PlanePoiseuilleProfile{2, 5, 1});
  for (const double t : {0.0, 0.1, 0.7}) {
    const FlowState<2> sum = *both.at({1.5, 0.3}, t);
    const FlowState<2> first = *oscillating.at({1.5, 0.3}, t);
    const FlowState<2> second = *steady.at({1.5, 0.3}, t);
    EXPECT_NEAR(sum.velocity[0], first.velocity[0] + second.velocity[0], 1e-15);
    EXPECT_NEAR(sum.pressure, first.pressure + second.pressure, 1e-14);
    EXPECT_NEAR(sum.velocity_gradient(0, 1),
                first.velocity_gradient(0, 1) + second.velocity_gradient(0, 1), 1e-14);
  }
}

TEST(Womersley, number_is_half_width_over_layer) {
  const WomersleyChannelProfile blood{2e-3, 0, 1, 2 * pi, 3.5e-3, 1060};
  EXPECT_NEAR(womersley_number(blood), 1e-3 * std::sqrt(2 * pi * 1060 / 3.5e-3), 1e-12);
  const WomersleyPipeProfile aorta{1.25e-2, 0, 1, 2 * pi, 3.5e-3, 1060};
  EXPECT_NEAR(womersley_number(aorta), 12.5 * womersley_number(blood), 1e-12);
}

}  // namespace
}  // namespace hemoscale::macro
