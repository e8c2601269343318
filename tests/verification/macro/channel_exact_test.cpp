// The channel model against profiles that are known in closed form.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "macro/analytic/channel_model.hpp"

namespace hemoscale::macro {
namespace {

constexpr double h = 75e-6;  // [m]
constexpr double G = 4e4;    // [Pa/m]

std::shared_ptr<const ChannelFlow<2>> by_pressure(const ViscosityLaw& law, double gradient = G) {
  return ChannelModel<2>(Channel{h, 0.4, PressureGradient{gradient}}).solve(law);
}
std::shared_ptr<const ChannelFlow<2>> by_velocity(const ViscosityLaw& law, double velocity) {
  return ChannelModel<2>(Channel{h, 0.4, MeanVelocity{velocity}}).solve(law);
}

std::vector<double> heights() {
  std::vector<double> ys;
  for (int i = 0; i <= 200; ++i) ys.push_back(h * i / 200.0);
  ys.push_back(h * (0.5 - 1e-9));
  ys.push_back(h * 1e-9);
  return ys;
}

void expect_parabola(const ChannelFlow<2>& flow, double mu) {
  const double top = G * h * h / (8 * mu);
  for (const double y : heights()) {
    EXPECT_NEAR(flow.velocity(y), G * y * (h - y) / (2 * mu), 1e-12 * top) << y;
    EXPECT_NEAR(flow.at({0, y}, 0)->velocity_gradient(0, 1), G * (h / 2 - y) / mu,
                1e-12 * G * h / mu);
  }
  EXPECT_NEAR(flow.wall_shear_rate(), G * h / (2 * mu), 1e-12 * G * h / mu);
  EXPECT_NEAR(flow.mean_velocity(), 2 * top / 3, 1e-12 * top);
  EXPECT_NEAR(flow.flow_rate_per_depth(), 2 * top * h / 3, 1e-12 * top * h);
  EXPECT_NEAR(flow.pressure_gradient(), G, 1e-12 * G);
}

TEST(ChannelExact, newtonian_flow_is_the_parabola) {
  const double mu = 3.5e-3;
  expect_parabola(*by_pressure(Newtonian{mu}), mu);
  expect_parabola(*by_velocity(Newtonian{mu}, G * h * h / (12 * mu)), mu);
}

TEST(ChannelExact, every_law_with_newtonian_parameters_gives_the_parabola) {
  const double mu = 3.5e-3;
  expect_parabola(*by_pressure(CarreauYasuda{mu, mu, 3, 0.4, 2}), mu);
  expect_parabola(*by_pressure(Casson{0, mu, 1}), mu);
  expect_parabola(*by_pressure(Cross{mu, mu, 3, 0.4}), mu);
  expect_parabola(*by_pressure(PowerLaw{mu, 1, 1, 100}), mu);
  expect_parabola(*by_pressure(Quemada{mu, 0, 0, 1}), mu);
}

TEST(ChannelExact, a_table_of_one_viscosity_gives_the_parabola) {
  const double mu = 3.5e-3;
  const ViscosityTable knots({{0.4, {0.1, 1, 7, 90, 200}, {mu, mu, mu, mu, mu}}});
  expect_parabola(*by_pressure(knots), mu);
  expect_parabola(*by_velocity(knots, G * h * h / (12 * mu)), mu);
  expect_parabola(*by_pressure(ViscosityTable({{0.4, {5}, {mu}}})), mu);
}

struct PowerLawExact {
  double K, n;
  double scale() const { return n / (n + 1) * std::pow(G / K, 1 / n); }
  double velocity(double y) const {
    const double p = (n + 1) / n;
    return scale() * (std::pow(0.5 * h, p) - std::pow(std::abs(0.5 * h - y), p));
  }
  double mean() const { return scale() * std::pow(0.5 * h, (n + 1) / n) * (n + 1) / (2 * n + 1); }
  double wall_shear_rate() const { return std::pow(0.5 * G * h / K, 1 / n); }
};

void expect_power_law(const ChannelFlow<2>& flow, const PowerLawExact& exact) {
  const double top = exact.velocity(0.5 * h);
  for (const double y : heights()) {
    EXPECT_NEAR(flow.velocity(y), exact.velocity(y), 1e-10 * top) << exact.n << " " << y;
    EXPECT_NEAR(flow.shear_rate(y), std::pow(G * std::abs(h / 2 - y) / exact.K, 1 / exact.n),
                1e-10 * exact.wall_shear_rate());
  }
  EXPECT_NEAR(flow.mean_velocity() / exact.mean(), 1, 1e-10);
  EXPECT_NEAR(flow.wall_shear_rate() / exact.wall_shear_rate(), 1, 1e-10);
  EXPECT_NEAR(flow.pressure_gradient() / G, 1, 1e-10);
}

TEST(ChannelExact, power_law_profiles_are_exact) {
  for (const double n : {0.25, 0.5, 0.8, 1.0, 1.7}) {
    // Bounds far outside the flow, so that the fluid that is held contributes below 1e-10.
    const double wall = 200;  // [1/s]
    const PowerLawExact exact{0.5 * G * h / std::pow(wall, n), n};
    const PowerLaw law{exact.K, n, 1e-9 * wall, 1e3 * wall};
    expect_power_law(*by_pressure(law), exact);
    expect_power_law(*by_velocity(law, exact.mean()), exact);
  }
}

// The same fluid as a table with few knots: in logarithms the interpolation is exact.
TEST(ChannelExact, a_table_of_a_power_law_is_the_power_law) {
  const double n = 0.6;
  const PowerLawExact exact{0.5 * G * h / std::pow(200, n), n};
  ViscosityRow row;
  row.hematocrit = 0.4;
  for (const double rate : {1e-7, 1e-3, 0.5, 40.0, 1e4}) {
    row.shear_rates.push_back(rate);
    row.viscosities.push_back(exact.K * std::pow(rate, n - 1));
  }
  expect_power_law(*by_pressure(ViscosityTable({row})), exact);
}

// Integrals of gamma = (sqrt(tau) - sqrt(tau_y))^2 / mu_inf over the stress, tau > tau_y.
struct CassonExact {
  double yield, mu;
  double slip_primitive(double tau) const {
    return (0.5 * tau * tau - 4.0 / 3 * std::sqrt(yield) * std::pow(tau, 1.5) + yield * tau) / mu;
  }
  double moment_primitive(double tau) const {
    return (std::pow(tau, 3) / 3 - 0.8 * std::sqrt(yield) * std::pow(tau, 2.5) +
            0.5 * yield * tau * tau) /
           mu;
  }
  double velocity(double y) const {
    const double tau = std::max(yield, G * std::abs(0.5 * h - y));
    return (slip_primitive(0.5 * G * h) - slip_primitive(tau)) / G;
  }
  double mean() const {
    return 2 * (moment_primitive(0.5 * G * h) - moment_primitive(yield)) / (G * G * h);
  }
};

TEST(ChannelExact, casson_flow_tends_to_the_plug_as_the_lowest_shear_rate_vanishes) {
  const CassonExact exact{0.5, 3.5e-3};  // plug: one third of the channel
  std::vector<double> errors;
  for (const double lowest : {1e-1, 1e-2, 1e-3, 1e-4}) {
    const auto flow = by_pressure(Casson{exact.yield, exact.mu, lowest});
    double largest = 0;
    for (const double y : heights()) {
      largest = std::max(largest, std::abs(flow->velocity(y) - exact.velocity(y)));
      // Fluid that shears faster than the bound knows nothing of it.
      if (flow->shear_rate(y) > lowest) {
        EXPECT_NEAR(flow->velocity(y), exact.velocity(y), 1e-10 * exact.velocity(0.5 * h));
      }
    }
    EXPECT_LT(largest, lowest * h);  // creep of at most the bound over the plug
    errors.push_back(largest);
  }
  for (std::size_t i = 0; i + 1 < errors.size(); ++i) {
    EXPECT_NEAR(std::log10(errors[i] / errors[i + 1]), 1, 0.1);
  }
}

TEST(ChannelExact, casson_flow_with_a_tiny_bound_is_exact_to_ten_digits) {
  const CassonExact exact{0.5, 3.5e-3};
  const Casson law{exact.yield, exact.mu, 1e-11};
  const double top = exact.velocity(0.5 * h);
  for (const auto& flow : {by_pressure(law), by_velocity(law, exact.mean())}) {
    for (const double y : heights()) EXPECT_NEAR(flow->velocity(y), exact.velocity(y), 1e-10 * top);
    EXPECT_NEAR(flow->mean_velocity() / exact.mean(), 1, 1e-10);
    EXPECT_NEAR(flow->pressure_gradient() / G, 1, 1e-10);
  }
}

}  // namespace
}  // namespace hemoscale::macro
