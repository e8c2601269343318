#include "micro/ensemble/flow/grid_flow.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "micro/ensemble/flow/interpolation_error.hpp"
#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

using Velocity = std::function<Vector<2>(const Vector<2>&)>;
using IsFluid = std::function<bool(const Vector<2>&)>;

GridSamples sampled(
    std::size_t columns, std::size_t rows, double spacing, const Velocity& velocity,
    const IsFluid& is_fluid = [](const Vector<2>&) { return true; }) {
  GridSamples samples{
      .origin = {-1, -2}, .spacing = spacing, .columns = columns, .rows = rows, .velocities = {}};
  for (std::size_t row = 0; row < rows; ++row) {
    for (std::size_t column = 0; column < columns; ++column) {
      const Vector<2> x = samples.place(column, row);
      samples.velocities.push_back(is_fluid(x) ? std::optional(velocity(x)) : std::nullopt);
    }
  }
  return samples;
}

Vector<2> cubic(const Vector<2>& x) {
  return {1 + x[0] * x[1] * x[1] - x[0] * x[0] * x[0], x[1] - 2 * x[0] * x[0] * x[1] + x[1] * x[1]};
}

Vector<2> wave(const Vector<2>& x) {
  return {std::sin(2 * x[0]) * std::cos(x[1]), std::cos(2 * x[0] + x[1])};
}

TEST(GridFlow, is_exact_for_cubic_polynomials) {
  const GridFlow flow(sampled(12, 15, 0.25, cubic));
  for (double a = -0.9; a < 1.7; a += 0.173) {
    for (double b = -1.9; b < 1.4; b += 0.211) {
      const LocalFlow here = flow.at({a, b}, 3);
      EXPECT_NEAR((here.velocity - cubic({a, b})).norm(), 0, 1e-12);
      EXPECT_NEAR(here.gradient(0, 0), b * b - 3 * a * a, 1e-11);
      EXPECT_NEAR(here.gradient(0, 1), 2 * a * b, 1e-11);
      EXPECT_NEAR(here.gradient(1, 0), -4 * a * b, 1e-11);
      EXPECT_NEAR(here.gradient(1, 1), 1 - 2 * a * a + 2 * b, 1e-11);
      EXPECT_NEAR(here.second[0](0, 0), -6 * a, 1e-10);
      EXPECT_NEAR(here.second[0](0, 1), 2 * b, 1e-10);
      EXPECT_NEAR(here.second[0](1, 0), 2 * b, 1e-10);
      EXPECT_NEAR(here.second[0](1, 1), 2 * a, 1e-10);
      EXPECT_NEAR(here.second[1](0, 0), -4 * b, 1e-10);
      EXPECT_NEAR(here.second[1](0, 1), -4 * a, 1e-10);
      EXPECT_NEAR(here.second[1](1, 1), 2, 1e-10);
    }
  }
}

TEST(GridFlow, returns_its_samples_and_is_once_continuously_differentiable) {
  const GridSamples samples = sampled(12, 15, 0.25, wave);
  const GridFlow flow(samples);
  for (std::size_t row = 0; row < 15; ++row) {
    for (std::size_t column = 0; column < 12; ++column) {
      const Vector<2> x = samples.place(column, row);
      EXPECT_NEAR((flow.at(x, 0).velocity - wave(x)).norm(), 0, 1e-14);
    }
  }
  const double step = 1e-9;
  for (const double across : {-0.71, 0.02, 0.33}) {
    for (const auto& [place, d] : {std::pair{Vector<2>(0.25, across), Vector<2>(step, 0)},
                                   {Vector<2>(across, -0.75), Vector<2>(0, step)}}) {
      const LocalFlow before = flow.at(place - d, 0);
      const LocalFlow after = flow.at(place + d, 0);
      EXPECT_NEAR((before.velocity - after.velocity).norm(), 0, 1e-8);
      EXPECT_NEAR((before.gradient - after.gradient).norm(), 0, 1e-7);
    }
  }
}

TEST(GridFlow, has_derivatives_of_its_velocity) {
  const GridFlow flow(sampled(12, 15, 0.25, wave));
  const double step = 1e-4;
  for (const Vector<2>& x : {Vector<2>(0.1, 0.1), Vector<2>(-0.93, -1.9), Vector<2>(1.6, 0.9)}) {
    const LocalFlow here = flow.at(x, 0);
    for (Eigen::Index j = 0; j < 2; ++j) {
      const Vector<2> d = step * Vector<2>::Unit(j);
      const LocalFlow after = flow.at(x + d, 0);
      const LocalFlow before = flow.at(x - d, 0);
      for (Eigen::Index i = 0; i < 2; ++i) {
        EXPECT_NEAR(here.gradient(i, j), (after.velocity[i] - before.velocity[i]) / (2 * step),
                    1e-6);
        for (Eigen::Index k = 0; k < 2; ++k) {
          EXPECT_NEAR(here.second[static_cast<std::size_t>(i)](k, j),
                      (after.gradient(i, k) - before.gradient(i, k)) / (2 * step), 1e-6);
        }
      }
    }
  }
}

TEST(GridFlow, beyond_the_grid_is_that_of_the_nearest_point_of_it) {
  const GridFlow flow(sampled(9, 9, 0.25, cubic));  // -1 to 1, -2 to 0
  const LocalFlow edge = flow.at({1, -0.7}, 0);
  const LocalFlow beyond = flow.at({7, -0.7}, 0);
  EXPECT_NEAR((beyond.velocity - edge.velocity).norm(), 0, 1e-14);
  EXPECT_EQ(beyond.gradient.col(0).norm(), 0);
  EXPECT_NEAR((beyond.gradient.col(1) - edge.gradient.col(1)).norm(), 0, 1e-14);
  EXPECT_EQ(beyond.second[0](0, 1), 0);
  EXPECT_NEAR((flow.at({-9, 9}, 0).velocity - cubic({-1, 0})).norm(), 0, 1e-13);
}

TEST(GridFlow, has_bounds_that_hold_and_are_not_far_off) {
  const GridFlow flow(sampled(40, 40, 0.08, wave));
  double speed = 0;
  double rate = 0;
  for (double a = -1; a <= 2.12; a += 0.01) {
    for (double b = -2; b <= 1.12; b += 0.01) {
      const LocalFlow here = flow.at({a, b}, 0);
      const Tensor<2> D = 0.5 * (here.gradient + here.gradient.transpose());
      speed = std::max(speed, here.velocity.norm());
      rate = std::max(rate, std::sqrt(2 * D.squaredNorm()));
    }
  }
  EXPECT_GE(flow.largest_speed(), speed);
  EXPECT_LE(flow.largest_speed(), 1.1 * speed);
  EXPECT_GE(flow.largest_shear_rate(), rate);
  EXPECT_LE(flow.largest_shear_rate(), 1.3 * rate);
  EXPECT_TRUE(flow.is_steady());
}

/// Poiseuille flow in a slanting channel of half-height 0.6.
struct SlantingChannel {
  Vector<2> along = Vector<2>(0.8, 0.6);
  Vector<2> across = Vector<2>(-0.6, 0.8);
  double half = 0.6;
  double distance(const Vector<2>& x) const { return x.dot(across) + 0.4; }  // from the axis
  Vector<2> velocity(const Vector<2>& x) const {
    const double s = distance(x) / half;
    return (1 - s * s) * along;
  }
  bool is_fluid(const Vector<2>& x) const { return std::abs(distance(x)) < half; }
  WallGeometry walls(double reach) const {
    const Vector<2> axis = -0.4 * across;
    return WallGeometry({{axis - half * across - 9 * along, axis - half * across + 9 * along},
                         {axis + half * across + 9 * along, axis + half * across - 9 * along}},
                        reach);
  }
};

TEST(GridFlow, continues_a_parabola_exactly_into_the_walls) {
  const SlantingChannel channel;
  const GridSamples samples = sampled(
      31, 31, 0.1, [&](const Vector<2>& x) { return channel.velocity(x); },
      [&](const Vector<2>& x) { return channel.is_fluid(x); });
  const WallGeometry walls = channel.walls(1);
  const WallGeometry short_sighted = channel.walls(0.05);  // half a spacing
  for (const WallGeometry* known :
       {static_cast<const WallGeometry*>(nullptr), &walls, &short_sighted}) {
    const GridFlow flow(samples, known);
    for (double s = -1.25; s <= 1.25; s += 0.05) {
      for (double place = 0; place < 0.6; place += 0.07) {
        const Vector<2> x =
            (place + 0.1) * channel.along + (s * channel.half - 0.4) * channel.across;
        const LocalFlow here = flow.at(x, 0);
        EXPECT_NEAR((here.velocity - channel.velocity(x)).norm(), 0, 1e-11) << s;
        EXPECT_NEAR(here.gradient.trace(), 0, 1e-10);
      }
    }
    EXPECT_LE(flow.divergence().largest, 1e-10);
    EXPECT_LE(flow.divergence().rms, flow.divergence().largest);
    // Far out it rests.
    EXPECT_EQ(flow.at(1.4 * channel.across, 0).velocity.norm(), 0);
  }
}

TEST(GridFlow, does_not_look_across_a_thin_divider) {
  // Two channels with opposite flows; between them one column of nodes in the wall.
  const auto velocity = [](const Vector<2>& x) { return Vector<2>(0, x[0] < 0.4 ? 1 : -5); };
  const auto is_fluid = [](const Vector<2>& x) { return x[0] < 0.35 || x[0] > 0.45; };
  const GridFlow flow(sampled(31, 31, 0.1, velocity, is_fluid));
  EXPECT_NEAR(flow.at({0.4, -1}, 0).velocity[1], 1, 1e-10);
}

TEST(GridFlow, reports_the_divergence_of_its_samples) {
  const GridFlow flow(
      sampled(10, 10, 0.1, [](const Vector<2>& x) { return Vector<2>(3 * x[0], -x[1]); }));
  EXPECT_NEAR(flow.divergence().rms, 2, 1e-12);
  EXPECT_NEAR(flow.divergence().largest, 2, 1e-12);
}

TEST(InterpolationError, vanishes_for_what_is_interpolated_exactly) {
  const InterpolationError error = interpolation_error(sampled(21, 21, 0.1, cubic));
  EXPECT_LE(error.rms, 1e-13);
  EXPECT_LE(error.largest, 1e-12);
  EXPECT_EQ(error.points, 21U * 21 - 11 * 11);
}

TEST(InterpolationError, without_an_observed_order_is_the_one_measured) {
  const InterpolationError error = interpolation_error(sampled(9, 9, 0.2, wave));
  EXPECT_EQ(error.order_of_rms, 0);
  EXPECT_EQ(error.rms, error.coarse_rms);
  EXPECT_GT(error.rms, 0);
  EXPECT_EQ(error.largest, error.coarse_largest);
}

TEST(GridSamples, that_are_broken_are_refused) {
  using testing::HasSubstr;
  const GridSamples good = sampled(5, 5, 0.1, cubic);
  const auto refusal = [](const GridSamples& samples) -> std::string {
    try {
      const GridFlow flow(samples);
    } catch (const ParameterError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(refusal(good), "accepted");
  GridSamples bad = good;
  bad.spacing = 0;
  EXPECT_THAT(refusal(bad), HasSubstr("spacing 0"));
  bad = good;
  bad.velocities.pop_back();
  EXPECT_THAT(refusal(bad), HasSubstr("24 velocities"));
  bad = good;
  bad.velocities[7] = Vector<2>(0, std::nan(""));
  EXPECT_THAT(refusal(bad), HasSubstr("(-0.8, -1.9)"));
  bad = good;
  for (auto& velocity : bad.velocities) velocity.reset();
  EXPECT_THAT(refusal(bad), HasSubstr("no node lies in the fluid"));
  EXPECT_THAT(refusal(sampled(3, 9, 0.1, cubic)), HasSubstr("3 columns"));
}

}  // namespace
}  // namespace hemoscale::micro
