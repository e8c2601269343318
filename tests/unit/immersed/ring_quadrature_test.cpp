#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "micro/error.hpp"
#include "micro/immersed/ring_quadrature.hpp"

namespace hemoscale::micro {
namespace {

using std::numbers::pi;

double angle(std::size_t i, std::size_t n) {
  return 2 * pi * static_cast<double>(i) / static_cast<double>(n);
}

// Of odd and of even numbers the highest waves differ.
class RingQuadratures : public testing::TestWithParam<std::size_t> {};
INSTANTIATE_TEST_SUITE_P(, RingQuadratures, testing::Values(8U, 31U, 32U));

TEST_P(RingQuadratures, contour_of_an_ellipse_is_exact) {
  const std::size_t n = GetParam();
  const double a = 3;
  const double b = 1.2;
  std::vector<Vector<2>> nodes;
  for (std::size_t i = 0; i < n; ++i) {
    nodes.emplace_back(5 + a * std::cos(angle(i, n)), b * std::sin(angle(i, n)));
  }
  const RingContour ring = RingQuadrature(n).contour(nodes);
  ASSERT_EQ(ring.size(), n);
  for (std::size_t i = 0; i < n; ++i) {
    const double c = std::cos(angle(i, n));
    const double s = std::sin(angle(i, n));
    const double speed = std::hypot(a * s, b * c);
    EXPECT_LT((ring.tangents[i] - Vector<2>(-a * s, b * c) / speed).norm(), 1e-13);
    EXPECT_LT((ring.normals[i] - Vector<2>(b * c, a * s) / speed).norm(), 1e-13);
    EXPECT_NEAR(ring.lengths[i], speed * 2 * pi / static_cast<double>(n), 1e-13);
    EXPECT_NEAR(ring.curvatures[i], a * b / std::pow(speed, 3), 1e-11);
  }
}

TEST_P(RingQuadratures, logarithm_times_each_wave_is_integrated_exactly) {
  const std::size_t n = GetParam();
  const RingQuadrature quadrature(n);
  for (std::size_t m = 0; 2 * m <= n; ++m) {
    const auto wave = static_cast<double>(m);
    for (const std::size_t i : {std::size_t{0}, std::size_t{3}, n - 1}) {
      double by_cosine = 0;
      double by_sine = 0;
      for (std::size_t j = 0; j < n; ++j) {
        const double step = 2 * pi / static_cast<double>(n);
        by_cosine += quadrature.log_weight(i, j) * std::cos(wave * angle(j, n)) * step;
        by_sine += quadrature.log_weight(i, j) * std::sin(wave * angle(j, n)) * step;
      }
      // -int ln|2 sin((a - b)/2)| e^(imb) db = pi/m e^(ima); without waves it vanishes
      const double factor = m == 0 ? 0 : pi / wave;
      EXPECT_NEAR(by_cosine, factor * std::cos(wave * angle(i, n)), 1e-13) << m;
      EXPECT_NEAR(by_sine, factor * std::sin(wave * angle(i, n)), 1e-13) << m;
    }
  }
}

TEST_P(RingQuadratures, chords_are_those_of_the_unit_circle) {
  const std::size_t n = GetParam();
  const RingQuadrature quadrature(n);
  EXPECT_EQ(quadrature.log_chord(2, 2), 0);
  for (const auto& [i, j] : {std::pair{2, 5}, {5, 2}, {7, 0}, {0, 7}}) {
    const double chord = 2 * std::abs(std::sin(pi * (i - j) / static_cast<double>(n)));
    EXPECT_NEAR(quadrature.log_chord(static_cast<std::size_t>(i), static_cast<std::size_t>(j)),
                std::log(chord), 1e-14);
  }
}

TEST_P(RingQuadratures, refinement_reproduces_waves) {
  const std::size_t n = GetParam();
  const RingQuadrature quadrature(n);
  const Eigen::MatrixXd& matrix = quadrature.refinement();
  const std::size_t fine = n * RingQuadrature::refinement_factor;
  ASSERT_EQ(matrix.rows(), static_cast<Eigen::Index>(fine));
  for (std::size_t m = 0; 2 * m < n; ++m) {
    const auto wave = static_cast<double>(m);
    Eigen::VectorXd coarse(matrix.cols());
    for (std::size_t j = 0; j < n; ++j) {
      coarse[static_cast<Eigen::Index>(j)] = std::sin(wave * angle(j, n) + 0.4);
    }
    const Eigen::VectorXd refined = matrix * coarse;
    for (std::size_t i = 0; i < fine; ++i) {
      EXPECT_NEAR(refined[static_cast<Eigen::Index>(i)], std::sin(wave * angle(i, fine) + 0.4),
                  1e-13);
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    const auto row = static_cast<Eigen::Index>(RingQuadrature::refinement_factor * i);
    EXPECT_NEAR(matrix(row, static_cast<Eigen::Index>(i)), 1, 1e-14);
  }
}

TEST(RingQuadrature, refuses_too_few_nodes) {
  try {
    RingQuadrature quadrature(7);
    FAIL();
  } catch (const ParameterError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("7 nodes; at least 8"));
  }
}

}  // namespace
}  // namespace hemoscale::micro
