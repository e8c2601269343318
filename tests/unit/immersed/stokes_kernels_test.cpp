#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "micro/immersed/stokes_kernels.hpp"

namespace hemoscale::micro {
namespace {

using std::numbers::pi;
using Potential = std::function<LogPotential(const Vector<2>&)>;
using Field = std::function<double(const Vector<2>&)>;

const std::vector<Vector<2>> places = {{0.7, 0.4}, {-0.3, 0.9}, {1.1, -0.2}, {-0.5, -0.6}};

// Both kernels obey the same equations: singularities at distances of 3, or one.
class StokesKernels : public testing::TestWithParam<bool> {
 protected:
  LogPotential at(const Vector<2>& r) const {
    return GetParam() ? PeriodicKernel{3.0}(r) : PlaneKernel{}(r);
  }
};
INSTANTIATE_TEST_SUITE_P(, StokesKernels, testing::Bool(),
                         [](const auto& each) { return each.param ? "periodic" : "plane"; });

double slope(const Field& f, const Vector<2>& r, int axis) {
  constexpr double h = 1e-4;
  const Vector<2> d = h * Vector<2>::Unit(axis);
  return (f(r + d) - f(r - d)) / (2 * h);
}

double laplacian(const Field& f, const Vector<2>& r) {
  constexpr double h = 1e-3;
  const Vector<2> x(h, 0);
  const Vector<2> y(0, h);
  return (f(r + x) + f(r - x) + f(r + y) + f(r - y) - 4 * f(r)) / (h * h);
}

TEST_P(StokesKernels, have_the_derivatives_of_their_potential) {
  for (const Vector<2>& r : places) {
    const LogPotential a = at(r);
    EXPECT_NEAR(slope([&](const auto& q) { return at(q).value; }, r, 0), a.x, 1e-6);
    EXPECT_NEAR(slope([&](const auto& q) { return at(q).value; }, r, 1), a.y, 1e-6);
    EXPECT_NEAR(slope([&](const auto& q) { return at(q).x; }, r, 1), a.xy, 1e-6);
    EXPECT_NEAR(slope([&](const auto& q) { return at(q).y; }, r, 1), a.yy, 1e-6);
    EXPECT_NEAR(slope([&](const auto& q) { return at(q).x; }, r, 0), -a.yy, 1e-6);
  }
}

TEST_P(StokesKernels, of_a_force_solve_the_equations_of_stokes) {
  for (const Vector<2>& r : places) {
    for (int force = 0; force < 2; ++force) {
      const auto u = [&](int axis) {
        return [this, axis, force](const Vector<2>& q) {
          return stokeslet(at(q), q.y())(axis, force);
        };
      };
      const Field p = [&](const Vector<2>& q) { return pressure_of_force(at(q))[force]; };
      EXPECT_NEAR(slope(u(0), r, 0) + slope(u(1), r, 1), 0, 1e-6);
      for (const int axis : {0, 1}) EXPECT_NEAR(laplacian(u(axis), r), slope(p, r, axis), 2e-5);
    }
  }
}

TEST_P(StokesKernels, stress_is_that_of_velocity_and_pressure) {
  const Vector<2> n(0.6, -0.8);
  for (const Vector<2>& r : places) {
    const Eigen::Matrix2d t = stresslet(at(r), r.y(), n);
    for (int force = 0; force < 2; ++force) {
      const auto u = [&](int axis) {
        return [this, axis, force](const Vector<2>& q) {
          return stokeslet(at(q), q.y())(axis, force);
        };
      };
      for (int i = 0; i < 2; ++i) {
        double traction = -pressure_of_force(at(r))[force] * n[i];
        for (int k = 0; k < 2; ++k) traction += (slope(u(i), r, k) + slope(u(k), r, i)) * n[k];
        EXPECT_NEAR(t(i, force), traction, 1e-5);
      }
    }
  }
}

// Of the double layer: u_k = -u_i T_ikl n_l / (4 pi), p = mu u_i P_ik n_k / (4 pi).
TEST_P(StokesKernels, of_a_stresslet_solve_the_equations_of_stokes) {
  const Vector<2> n(0.6, -0.8);
  for (const Vector<2>& r : places) {
    for (int jump = 0; jump < 2; ++jump) {
      const auto u = [&](int axis) {
        return [this, &n, axis, jump](const Vector<2>& q) {
          return -stresslet(at(q), q.y(), n)(axis, jump);
        };
      };
      const Field p = [&](const Vector<2>& q) { return pressure_of_stresslet(at(q), n)[jump]; };
      EXPECT_NEAR(slope(u(0), r, 0) + slope(u(1), r, 1), 0, 1e-5);
      for (const int axis : {0, 1}) EXPECT_NEAR(laplacian(u(axis), r), slope(p, r, axis), 1e-3);
    }
  }
}

TEST(PlaneKernel, gives_the_known_tensors) {
  const Vector<2> r(0.7, 0.4);
  const Vector<2> n(0.6, -0.8);
  const LogPotential a = PlaneKernel{}(r);
  const double square = r.squaredNorm();
  const Eigen::Matrix2d g =
      -std::log(r.norm()) * Eigen::Matrix2d::Identity() + r * r.transpose() / square;
  EXPECT_LT((stokeslet(a, r.y()) - g).norm(), 1e-14);
  const Eigen::Matrix2d t = -4 * r.dot(n) / (square * square) * r * r.transpose();
  EXPECT_LT((stresslet(a, r.y(), n) - t).norm(), 1e-14);
}

TEST(PeriodicKernel, of_a_long_period_is_the_plane_one_up_to_a_constant) {
  double before = 0;
  for (const double period : {1e2, 1e3}) {
    const PeriodicKernel kernel{period};
    double error = 0;
    for (const Vector<2>& r : places) {
      const LogPotential p = kernel(r);
      const LogPotential a = PlaneKernel{}(r);
      error =
          std::max({error, std::abs(p.value - kernel.remainder() - a.value), std::abs(p.x - a.x),
                    std::abs(p.y - a.y), std::abs(p.xy - a.xy), std::abs(p.yy - a.yy)});
    }
    EXPECT_LT(error, 10 / (period * period));
    if (before > 0) {
      EXPECT_NEAR(std::log10(before / error), 2, 0.01);  // of second order in r / period
    }
    before = error;
  }
}

TEST(PeriodicKernel, is_the_sum_over_the_images) {
  const PeriodicKernel kernel{3.0};
  const Vector<2> r(0.7, 0.4);
  double xy = 0;
  double yy = 0;
  for (int k = -2000; k <= 2000; ++k) {
    const LogPotential a = PlaneKernel{}({r.x() + 3.0 * k, r.y()});
    xy += a.xy;
    yy += a.yy;
  }
  EXPECT_NEAR(kernel(r).xy, xy, 1e-7);
  EXPECT_NEAR(kernel(r).yy, yy, 2e-4);  // what lies beyond is of first order in their number
  const LogPotential next = kernel({r.x() + 6, r.y()});
  EXPECT_NEAR(next.value, kernel(r).value, 1e-14);
  EXPECT_NEAR(next.x, kernel(r).x, 1e-14);
  // Far from the row, it is a uniform one.
  EXPECT_NEAR(kernel({0.3, 9}).y, pi / 3, 1e-7);
}

TEST(PeriodicKernel, finds_the_nearest_image) {
  const PeriodicKernel kernel{3.0};
  EXPECT_NEAR(kernel.nearest({2.9, 5}).x(), -0.1, 1e-15);
  EXPECT_EQ(kernel.nearest({2.9, 5}).y(), 5);
  EXPECT_NEAR(kernel.nearest({-7.4, 0}).x(), -1.4, 1e-15);
}

}  // namespace
}  // namespace hemoscale::micro
