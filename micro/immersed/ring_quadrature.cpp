#include "micro/immersed/ring_quadrature.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "micro/error.hpp"
#include "micro/linear/one_blas_thread.hpp"

namespace hemoscale::micro {

namespace {

constexpr double two_pi = 2 * std::numbers::pi;

/// Derivative of the trigonometric interpolant at the nodes.
Eigen::MatrixXd trigonometric_derivative(std::size_t nodes) {
  const auto n = static_cast<Eigen::Index>(nodes);
  const double step = two_pi / static_cast<double>(nodes);
  Eigen::MatrixXd d = Eigen::MatrixXd::Zero(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      if (i == j) continue;
      const double half = 0.5 * step * static_cast<double>(i - j);
      const double sign = (i - j) % 2 == 0 ? 0.5 : -0.5;
      d(i, j) = n % 2 == 0 ? sign / std::tan(half) : sign / std::sin(half);
    }
  }
  return d;
}

/// Value at distance t from a node of the interpolant that is one there and zero at the others.
double cardinal(std::size_t nodes, double t) {
  const auto n = static_cast<double>(nodes);
  const double half_sine = std::sin(0.5 * t);
  if (std::abs(half_sine) < 1e-14) return 1;
  const double sine = std::sin(0.5 * n * t);
  return nodes % 2 == 0 ? sine * std::cos(0.5 * t) / (n * half_sine) : sine / (n * half_sine);
}

Eigen::MatrixXd trigonometric_refinement(std::size_t nodes, std::size_t factor) {
  const std::size_t fine = nodes * factor;
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(fine), static_cast<Eigen::Index>(nodes));
  for (std::size_t i = 0; i < fine; ++i) {
    for (std::size_t j = 0; j < nodes; ++j) {
      const double t = two_pi * (static_cast<double>(i) / static_cast<double>(fine) -
                                 static_cast<double>(j) / static_cast<double>(nodes));
      matrix(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) = cardinal(nodes, t);
    }
  }
  return matrix;
}

}  // namespace

RingQuadrature::RingQuadrature(std::size_t nodes)
    : nodes_(nodes), log_weights_(nodes), log_chords_(nodes, 0.0) {
  if (nodes < 8) {
    throw ParameterError(
        fmt::format("a ring of {} nodes; at least 8 are needed to show a shape; use more", nodes));
  }
  // Products with its matrices, and of those of the layers, are the same for any number of threads.
  use_one_blas_thread();
  derivative_ = trigonometric_derivative(nodes);
  refinement_ = trigonometric_refinement(nodes, refinement_factor);
  const double step = two_pi / static_cast<double>(nodes);
  for (std::size_t d = 0; d < nodes; ++d) {
    // -ln|2 sin(t/2)| = sum_m cos(m t) / m, cut at the highest wave that the nodes carry.
    const double t = step * static_cast<double>(d);
    double sum = 0;
    for (std::size_t m = 1; 2 * m < nodes; ++m) {
      sum += std::cos(static_cast<double>(m) * t) / static_cast<double>(m);
    }
    if (nodes % 2 == 0) {
      const auto last = static_cast<double>(nodes / 2);
      sum += 0.5 * std::cos(last * t) / last;
    }
    log_weights_[d] = sum;
    if (d > 0) log_chords_[d] = std::log(2 * std::abs(std::sin(0.5 * t)));
  }
}

RingContour RingQuadrature::contour(std::span<const Vector<2>> positions) const {
  const auto n = static_cast<Eigen::Index>(nodes_);
  Eigen::Matrix<double, Eigen::Dynamic, 2> x(n, 2);
  for (Eigen::Index i = 0; i < n; ++i) x.row(i) = positions[static_cast<std::size_t>(i)];
  const Eigen::Matrix<double, Eigen::Dynamic, 2> first = derivative_ * x;
  const Eigen::Matrix<double, Eigen::Dynamic, 2> second = derivative_ * first;
  RingContour contour;
  contour.positions.assign(positions.begin(), positions.end());
  contour.tangents.resize(nodes_);
  contour.normals.resize(nodes_);
  contour.lengths.resize(nodes_);
  contour.curvatures.resize(nodes_);
  for (std::size_t i = 0; i < nodes_; ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const Vector<2> d = first.row(row);
    const Vector<2> dd = second.row(row);
    const double speed = d.norm();
    contour.tangents[i] = d / speed;
    contour.normals[i] = Vector<2>(d.y(), -d.x()) / speed;
    contour.lengths[i] = speed * two_pi / static_cast<double>(nodes_);
    contour.curvatures[i] = (d.x() * dd.y() - d.y() * dd.x()) / (speed * speed * speed);
  }
  return contour;
}

}  // namespace hemoscale::micro
