// Orders of a flow on a grid, with curved walls that cut the grid anywhere: pressure-driven flow
// around an annulus at rest on both circles [Dean 1928],
//
//   u_theta = r ln r + a r + b / r,   a and b such that u_theta = 0 at both radii.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "micro/ensemble/flow/grid_flow.hpp"
#include "micro/ensemble/flow/interpolation_error.hpp"

namespace hemoscale::micro {
namespace {

constexpr double inner = 1;
constexpr double outer = 2;

class Annulus {
 public:
  Annulus() {
    const double inner2 = inner * inner;
    const double outer2 = outer * outer;
    a_ = (inner2 * std::log(inner) - outer2 * std::log(outer)) / (outer2 - inner2);
    b_ = -inner2 * (std::log(inner) + a_);
  }

  LocalFlow at(const Vector<2>& x) const {
    const double r = x.norm();
    // w = u_theta / r, u = w (-y, x)
    const double w = std::log(r) + a_ + b_ / (r * r);
    const double w1 = 1 / r - 2 * b_ / (r * r * r);
    const double w2 = -1 / (r * r) + 6 * b_ / (r * r * r * r);
    const Vector<2> e = x / r;
    const Vector<2> first = w1 * e;  // gradient of w
    const Tensor<2> second =
        w2 * e * e.transpose() + w1 / r * (Tensor<2>::Identity() - e * e.transpose());
    LocalFlow flow;
    flow.velocity = w * Vector<2>(-x[1], x[0]);
    flow.gradient << -x[1] * first[0], -x[1] * first[1] - w, x[0] * first[0] + w, x[0] * first[1];
    for (Eigen::Index j = 0; j < 2; ++j) {
      for (Eigen::Index k = 0; k < 2; ++k) {
        const double dj = j == 1 ? 1 : 0;
        const double dk = k == 1 ? 1 : 0;
        flow.second[0](j, k) = -x[1] * second(j, k) - dj * first[k] - dk * first[j];
        flow.second[1](j, k) = x[0] * second(j, k) + (1 - dj) * first[k] + (1 - dk) * first[j];
      }
    }
    return flow;
  }

  static bool is_fluid(const Vector<2>& x) { return x.norm() > inner && x.norm() < outer; }

  static WallGeometry walls() {
    const int chords = 8000;
    std::vector<std::vector<Vector<2>>> circles(2);
    for (int k = 0; k <= chords; ++k) {
      const double angle = 2 * std::acos(-1) * (k % chords) / chords;
      circles[0].push_back(outer * Vector<2>(std::cos(angle), std::sin(angle)));
      circles[1].push_back(inner * Vector<2>(std::cos(angle), -std::sin(angle)));
    }
    return WallGeometry(circles, 0.3);
  }

 private:
  double a_ = 0, b_ = 0;
};

GridSamples sampled(const Annulus& annulus, int across) {
  const double spacing = (outer - inner) / across;
  const double half = 2.3;
  // Shifted, so that no level lies on the symmetry of the flow.
  GridSamples samples{.origin = Vector<2>(-half - 0.013, -half - 0.007),
                      .spacing = spacing,
                      .columns = 0,
                      .rows = 0,
                      .velocities = {}};
  samples.columns = samples.rows = static_cast<std::size_t>(std::ceil(2 * half / spacing)) + 2;
  for (std::size_t row = 0; row < samples.rows; ++row) {
    for (std::size_t column = 0; column < samples.columns; ++column) {
      const Vector<2> x = samples.place(column, row);
      samples.velocities.push_back(Annulus::is_fluid(x) ? std::optional(annulus.at(x).velocity)
                                                        : std::nullopt);
    }
  }
  return samples;
}

struct Errors {
  double rms = 0, velocity = 0, gradient = 0, second = 0;  // rms of the velocity, largest of all
};

Errors errors(const Annulus& annulus, const GridFlow& flow) {
  Errors result;
  double sum = 0;
  int count = 0;
  for (double x = -2.01; x < 2.02; x += 0.0173) {
    for (double y = -2.02; y < 2.02; y += 0.0191) {
      if (!Annulus::is_fluid({x, y})) continue;
      const LocalFlow exact = annulus.at({x, y});
      const LocalFlow here = flow.at({x, y}, 0);
      const double error = (here.velocity - exact.velocity).norm();
      sum += error * error;
      ++count;
      result.velocity = std::max(result.velocity, error);
      result.gradient = std::max(result.gradient, (here.gradient - exact.gradient).norm());
      for (std::size_t i = 0; i < 2; ++i) {
        result.second = std::max(result.second, (here.second[i] - exact.second[i]).norm());
      }
    }
  }
  result.rms = std::sqrt(sum / count);
  return result;
}

TEST(GridFlowOrder, in_an_annulus_that_cuts_the_grid) {
  const Annulus annulus;
  const WallGeometry walls = Annulus::walls();
  std::vector<Errors> levels;
  for (const int across : {12, 24, 48}) {
    const GridFlow flow(sampled(annulus, across), &walls);
    levels.push_back(errors(annulus, flow));
    std::printf(
        "%d across: velocity rms %.2e, largest %.2e, gradient %.2e, second %.2e, divergence %.2e\n",
        across, levels.back().rms, levels.back().velocity, levels.back().gradient,
        levels.back().second, flow.divergence().largest);
  }
  const auto order = [&](double Errors::*error) {
    return std::log2(levels.front().*error / (levels.back().*error)) / 2;
  };
  std::printf("orders: velocity rms %.2f, largest %.2f, gradient %.2f, second %.2f\n",
              order(&Errors::rms), order(&Errors::velocity), order(&Errors::gradient),
              order(&Errors::second));
  EXPECT_GE(order(&Errors::rms), 2.8);
  EXPECT_GE(order(&Errors::velocity), 2.8);
  EXPECT_GE(order(&Errors::gradient), 1.8);
  EXPECT_GE(order(&Errors::second), 0.8);
}

TEST(GridFlowOrder, the_error_stated_is_the_error_made) {
  const Annulus annulus;
  const WallGeometry walls = Annulus::walls();
  const GridSamples samples = sampled(annulus, 40);
  const InterpolationError stated = interpolation_error(samples, &walls);
  const Errors made = errors(annulus, GridFlow(samples, &walls));
  std::printf("rms stated %.2e made %.2e, largest stated %.2e made %.2e, orders %.2f %.2f\n",
              stated.rms, made.rms, stated.largest, made.velocity, stated.order_of_rms,
              stated.order_of_largest);
  EXPECT_GE(stated.rms, made.rms / 2);
  EXPECT_LE(stated.rms, made.rms * 4);
  EXPECT_GE(stated.largest, made.velocity / 3);
  EXPECT_LE(stated.largest, made.velocity * 4);
  EXPECT_GE(stated.order_of_rms, 2.5);
}

/// Without the walls the fluid is not known to rest on them: the error at them is some ten times
/// larger.
TEST(GridFlowOrder, without_walls) {
  const Annulus annulus;
  const Errors coarse = errors(annulus, GridFlow(sampled(annulus, 12)));
  const Errors fine = errors(annulus, GridFlow(sampled(annulus, 48)));
  const double rms = std::log2(coarse.rms / fine.rms) / 2;
  const double largest = std::log2(coarse.velocity / fine.velocity) / 2;
  std::printf("orders without walls: rms %.2f, largest %.2f (%.2e)\n", rms, largest, fine.velocity);
  EXPECT_GE(rms, 2.8);
  EXPECT_GE(largest, 2.5);
}

}  // namespace
}  // namespace hemoscale::micro
