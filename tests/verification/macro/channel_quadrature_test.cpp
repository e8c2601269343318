// The channel model against its equations, for laws without a closed profile.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "macro/analytic/channel_model.hpp"

namespace hemoscale::macro {
namespace {

constexpr double h = 75e-6;  // [m]
constexpr double H = 0.4;    // [-] hematocrit

struct Subject {
  std::string name;
  ViscosityLaw law;
};

void PrintTo(const Subject& subject, std::ostream* out) {
  *out << subject.name;
}

class EveryLawInAChannel : public testing::TestWithParam<Subject> {
 protected:
  double pressure_gradient() const { return flow->pressure_gradient(); }
  const ViscosityLaw& law() const { return GetParam().law; }

  std::shared_ptr<const ChannelFlow<2>> flow =
      ChannelModel<2>(Channel{h, H, MeanVelocity{2e-3}}).solve(GetParam().law);
};

TEST_P(EveryLawInAChannel, stress_is_linear_at_every_point) {
  for (int i = 0; i <= 1000; ++i) {
    const double y = h * i / 1000.0;
    const double rate = flow->shear_rate(y);
    const double stress = pressure_gradient() * std::abs(0.5 * h - y);
    EXPECT_NEAR(law().viscosity(rate, H) * rate, stress, 1e-13 * pressure_gradient() * h) << y;
    if (stress > 0) {
      EXPECT_NEAR(law().viscosity(rate, H) * rate / stress, 1, 1e-10);
    }
  }
}

// Relative accuracy holds also where the shear rate is many decades below that at the wall.
TEST_P(EveryLawInAChannel, stress_is_linear_close_to_the_axis) {
  for (int decades = 1; decades < 14; ++decades) {
    const double distance = std::pow(0.1, decades) * h;
    const double y = 0.5 * h - distance;
    const double stress = pressure_gradient() * (0.5 * h - y);
    if (stress == 0) continue;
    const double rate = flow->shear_rate(y);
    EXPECT_NEAR(law().viscosity(rate, H) * rate / stress, 1, 1e-10) << distance;
  }
}

// Shear rate by plain bisection, velocity by the trapezoidal rule with a tanh-sinh map on pieces:
// shares nothing with the implementation but the law.
double bisected_shear_rate(const ViscosityLaw& law, double stress) {
  double low = 0;
  double high = 1;
  while (law.viscosity(high, H) * high < stress) high *= 2;
  for (int step = 0; step < 200; ++step) {
    const double middle = 0.5 * (low + high);
    (law.viscosity(middle, H) * middle < stress ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

template <typename Function>
double tanh_sinh(const Function& f, double a, double b) {
  double sum = 0;
  const double step = 1.0 / 32;
  for (int k = -110; k <= 110; ++k) {
    const double t = k * step;
    const double argument = 0.5 * std::acos(-1.0) * std::sinh(t);
    const double weight = 0.5 * std::acos(-1.0) * std::cosh(t) / std::pow(std::cosh(argument), 2);
    sum += weight * f(0.5 * (a + b) + 0.5 * (b - a) * std::tanh(argument));
  }
  return 0.5 * (b - a) * step * sum;
}

// Stresses where the law bends, as ends of the pieces.
std::vector<double> pieces(double stress, double wall_stress, const std::vector<double>& bends) {
  std::vector<double> ends{stress};
  for (const double bend : bends) {
    if (bend > stress && bend < wall_stress) ends.push_back(bend);
  }
  ends.push_back(wall_stress);
  return ends;
}

std::vector<double> bend_stresses(const ViscosityLaw& law) {
  std::vector<double> stresses;
  if (const auto* table = std::get_if<ViscosityTable>(&law.model())) {
    std::vector<double> knots;
    for (const ViscosityRow& row : table->rows()) {
      knots.insert(knots.end(), row.shear_rates.begin(), row.shear_rates.end());
    }
    std::sort(knots.begin(), knots.end());
    for (const double rate : knots) stresses.push_back(law.viscosity(rate, H) * rate);
  }
  return stresses;
}

TEST_P(EveryLawInAChannel, velocity_is_the_integral_of_the_shear_rate) {
  const double wall_stress = 0.5 * pressure_gradient() * h;
  const std::vector<double> bends = bend_stresses(law());
  for (const double y : {1e-3 * h, 0.1 * h, 0.3 * h, 0.45 * h, 0.5 * h}) {
    const std::vector<double> ends =
        pieces(pressure_gradient() * (0.5 * h - y), wall_stress, bends);
    double integral = 0;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
      integral += tanh_sinh([&](double tau) { return bisected_shear_rate(law(), tau); }, ends[i],
                            ends[i + 1]);
    }
    EXPECT_NEAR(flow->velocity(y) / (integral / pressure_gradient()), 1, 1e-9) << y / h;
  }
}

TEST_P(EveryLawInAChannel, mean_velocity_is_the_mean_of_the_velocity) {
  const std::vector<double> ends = pieces(0, 0.5 * pressure_gradient() * h, bend_stresses(law()));
  double integral = 0;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    integral += tanh_sinh(
        [&](double tau) {
          return flow->velocity(std::max(0.0, 0.5 * h - tau / pressure_gradient()));
        },
        ends[i], ends[i + 1]);
  }
  EXPECT_NEAR(2 * integral / (pressure_gradient() * h) / flow->mean_velocity(), 1, 1e-9);
  EXPECT_NEAR(flow->mean_velocity() / 2e-3, 1, 1e-13);
  EXPECT_EQ(flow->flow_rate_per_depth(), h * flow->mean_velocity());
}

TEST_P(EveryLawInAChannel, gradient_is_the_derivative_of_the_velocity) {
  const double d = 1e-4 * h;
  for (int i = 0; i < 32; ++i) {
    const double y = (0.0123 + 0.0307 * i) * h;
    const double difference = (8 * (flow->velocity(y + d) - flow->velocity(y - d)) -
                               (flow->velocity(y + 2 * d) - flow->velocity(y - 2 * d))) /
                              (12 * d);
    EXPECT_NEAR(flow->at({0, y}, 0)->velocity_gradient(0, 1), difference,
                1e-5 * flow->wall_shear_rate());
  }
}

ViscosityTable blood_table() {
  std::vector<ViscosityRow> rows;
  for (const double hematocrit : {0.3, 0.5}) {
    ViscosityRow row;
    row.hematocrit = hematocrit;
    const double shift = hematocrit;  // knots of the two rows interleave
    for (const double rate : {0.1, 1.0, 6.0, 30.0, 200.0, 1e3}) {
      row.shear_rates.push_back(rate * (1 + shift));
      row.viscosities.push_back(
          viscosity(quemada_cokelet(1.2e-3, hematocrit), rate * (1 + shift), hematocrit));
    }
    rows.push_back(row);
  }
  return ViscosityTable(rows);
}

// Steep, flat and steep again: the worst that a monotone table of blood would look like.
ViscosityTable stepped_table() {
  return ViscosityTable({{0.4, {0.1, 1, 2, 20, 30, 100}, {60e-3, 20e-3, 20e-3, 6e-3, 6e-3, 5e-3}}});
}

INSTANTIATE_TEST_SUITE_P(
    Laws, EveryLawInAChannel,
    testing::Values(Subject{"carreau", cho_kensey_1991()},
                    Subject{"carreau_yasuda", CarreauYasuda{22e-3, 2.2e-3, 0.11, 0.392, 0.644}},
                    Subject{"sharp_carreau_yasuda", CarreauYasuda{22e-3, 2.2e-3, 0.02, 0.2, 8}},
                    Subject{"cross", Cross{56e-3, 3.45e-3, 3.736, 0.718}},
                    Subject{"thickening_cross", Cross{3e-3, 30e-3, 0.02, 2}},
                    Subject{"quemada", quemada_cokelet(1.2e-3, H)}, Subject{"table", blood_table()},
                    Subject{"stepped_table", stepped_table()}),
    [](const auto& subject) { return subject.param.name; });

}  // namespace
}  // namespace hemoscale::macro
