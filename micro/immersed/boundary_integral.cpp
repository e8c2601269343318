#include "micro/immersed/boundary_integral.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace hemoscale::micro {

namespace {

constexpr double four_pi = 4 * std::numbers::pi;

/// Within these many spacings trapezoidal sums take more points.
constexpr double near_spacings = 3;

std::vector<Vector<2>> refined(const Eigen::MatrixXd& refinement, std::span<const Vector<2>> values,
                               double factor) {
  std::vector<Vector<2>> result(static_cast<std::size_t>(refinement.rows()), Vector<2>::Zero());
  for (std::size_t j = 0; j < values.size(); ++j) {
    for (std::size_t i = 0; i < result.size(); ++i) {
      result[i] += factor * refinement(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) *
                   values[j];
    }
  }
  return result;
}

/// A point stands for its share of an arc length.
constexpr double share = 1.0 / RingQuadrature::refinement_factor;

std::vector<Vector<2>> weighted_normals(const RingContour& ring) {
  std::vector<Vector<2>> normals;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    normals.emplace_back(ring.lengths[i] * ring.normals[i]);
  }
  return normals;
}

/// Nodes near another part of the ring, or an image of it: along a bend of constant radius the arc
/// is at most pi/2 times the chord, here it is more than twice.
template <typename Kernel>
std::vector<std::size_t> crowded_nodes(const RingContour& ring, const Kernel& kernel) {
  const std::size_t n = ring.size();
  std::vector<double> along(n + 1, 0.0);
  for (std::size_t i = 0; i < n; ++i) along[i + 1] = along[i] + ring.lengths[i];
  const double reach = near_spacings * *std::max_element(ring.lengths.begin(), ring.lengths.end());
  std::vector<std::size_t> crowded;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const double way = std::abs(along[j] - along[i]);
      const double arc = std::min(way, along[n] - way);
      const double distance = kernel.nearest(ring.positions[i] - ring.positions[j]).norm();
      if (distance >= reach || arc <= 2 * distance) continue;
      crowded.push_back(i);
      break;
    }
  }
  return crowded;
}

/// The rows of a crowded node over the refined points, `block` of each, brought to the nodes.
template <typename Block>
void refine_rows(const Eigen::MatrixXd& refinement, std::size_t node, const Block& block,
                 Eigen::MatrixXd& matrix) {
  Eigen::Matrix<double, 4, Eigen::Dynamic> blocks(4, refinement.rows());
  for (Eigen::Index f = 0; f < refinement.rows(); ++f) {
    const Eigen::Matrix2d b = block(static_cast<std::size_t>(f));
    blocks.col(f) = Eigen::Map<const Eigen::Vector4d>(b.data());
  }
  const Eigen::Matrix<double, 4, Eigen::Dynamic> at_nodes = blocks * refinement;
  const auto row = static_cast<Eigen::Index>(2 * node);
  for (Eigen::Index j = 0; j < refinement.cols(); ++j) {
    matrix.block<2, 2>(row, 2 * j) = Eigen::Map<const Eigen::Matrix2d>(at_nodes.col(j).data());
  }
}

template <typename Kernel>
Eigen::MatrixXd single_layer_of(const RingQuadrature& quadrature, const RingContour& ring,
                                const Kernel& kernel, double viscosity) {
  const auto n = static_cast<Eigen::Index>(ring.size());
  Eigen::MatrixXd matrix(2 * n, 2 * n);
  const double scale = 1 / (four_pi * viscosity);
  const double node = 2 * std::numbers::pi / static_cast<double>(n);
  // ln|x_i - x_j| = ln|2 sin| + ln(|x_i - x_j| / |2 sin|), whose limit is ln|dx/dalpha|.
  const auto own = [&](std::size_t q, double log_weight) -> Eigen::Matrix2d {
    const double limit = std::log(ring.lengths[q] / node) + kernel.remainder() - log_weight;
    Eigen::Matrix2d block = ring.tangents[q] * ring.tangents[q].transpose();
    block.diagonal().array() -= limit;
    return scale * block;
  };
  for (Eigen::Index j = 0; j < n; ++j) {
    const auto q = static_cast<std::size_t>(j);
    matrix.block<2, 2>(2 * j, 2 * j) = own(q, quadrature.log_weight(q, q));
    for (Eigen::Index i = j + 1; i < n; ++i) {
      const auto p = static_cast<std::size_t>(i);
      const Vector<2> r = ring.positions[p] - ring.positions[q];
      LogPotential a = kernel(r);
      a.value -= quadrature.log_chord(p, q) + quadrature.log_weight(p, q);
      const Eigen::Matrix2d block = scale * stokeslet(a, r.y());
      matrix.block<2, 2>(2 * i, 2 * j) = block;
      matrix.block<2, 2>(2 * j, 2 * i) = block;
    }
  }
  const std::vector<std::size_t> crowded = crowded_nodes(ring, kernel);
  if (crowded.empty()) return matrix;
  const Eigen::MatrixXd& refinement = quadrature.refinement();
  const std::vector<Vector<2>> points = refined(refinement, ring.positions, 1);
  for (const std::size_t i : crowded) {
    const std::size_t here = RingQuadrature::refinement_factor * i;
    const auto remainder = [&](std::size_t f) -> Eigen::Matrix2d {
      if (f == here) return share * own(i, 0);
      const Vector<2> r = ring.positions[i] - points[f];
      LogPotential a = kernel(r);
      const double turn = node * share * (static_cast<double>(here) - static_cast<double>(f));
      a.value -= std::log(2 * std::abs(std::sin(0.5 * turn)));
      return share * scale * stokeslet(a, r.y());
    };
    refine_rows(refinement, i, remainder, matrix);
    // The logarithm itself is as well off with the nodes.
    for (std::size_t j = 0; j < ring.size(); ++j) {
      const double weight = scale * quadrature.log_weight(i, j);
      const auto row = static_cast<Eigen::Index>(2 * i);
      const auto column = static_cast<Eigen::Index>(2 * j);
      matrix(row, column) += weight;
      matrix(row + 1, column + 1) += weight;
    }
  }
  return matrix;
}

template <typename Kernel>
Eigen::MatrixXd double_layer_of(const RingQuadrature& quadrature, const RingContour& ring,
                                const Kernel& kernel) {
  const auto n = static_cast<Eigen::Index>(ring.size());
  Eigen::MatrixXd matrix(2 * n, 2 * n);
  const auto own = [&](std::size_t q) -> Eigen::Matrix2d {
    const Vector<2>& t = ring.tangents[q];
    return (-2 * ring.curvatures[q] * ring.lengths[q] / four_pi) * t * t.transpose();
  };
  for (Eigen::Index j = 0; j < n; ++j) {
    const auto q = static_cast<std::size_t>(j);
    const Vector<2> weighted = ring.normals[q] * (ring.lengths[q] / four_pi);
    for (Eigen::Index i = 0; i < n; ++i) {
      if (i == j) {
        matrix.block<2, 2>(2 * i, 2 * i) = own(q);
        continue;
      }
      const Vector<2> r = ring.positions[q] - ring.positions[static_cast<std::size_t>(i)];
      matrix.block<2, 2>(2 * i, 2 * j) = stresslet(kernel(r), r.y(), weighted);
    }
  }
  const std::vector<std::size_t> crowded = crowded_nodes(ring, kernel);
  if (crowded.empty()) return matrix;
  const Eigen::MatrixXd& refinement = quadrature.refinement();
  const std::vector<Vector<2>> points = refined(refinement, ring.positions, 1);
  const std::vector<Vector<2>> normals =
      refined(refinement, weighted_normals(ring), share / four_pi);
  for (const std::size_t i : crowded) {
    const auto block = [&](std::size_t f) -> Eigen::Matrix2d {
      if (f == RingQuadrature::refinement_factor * i) return share * own(i);
      const Vector<2> r = points[f] - ring.positions[i];
      return stresslet(kernel(r), r.y(), normals[f]);
    };
    refine_rows(refinement, i, block, matrix);
  }
  return matrix;
}

/// Flow of the points at one place.
struct Sum {
  Vector<2> velocity = Vector<2>::Zero();
  double pressure = 0;
};

template <typename Kernel>
Sum sum_of(const RingSource::Points& points, const Kernel& kernel, double viscosity,
           double contrast, const Vector<2>& place) {
  Vector<2> by_forces = Vector<2>::Zero();
  Vector<2> by_contrast = Vector<2>::Zero();
  double pressure = 0;
  for (std::size_t j = 0; j < points.positions.size(); ++j) {
    const Vector<2> r = place - points.positions[j];
    const LogPotential a = kernel(r);
    by_forces += stokeslet(a, r.y()) * points.forces[j];
    pressure += pressure_of_force(a).dot(points.forces[j]);
    if (contrast == 0) continue;
    const Vector<2> weighted = contrast * points.normals[j];
    // T changes its sign with the distance, which runs from the point here.
    by_contrast -= stresslet(a, r.y(), weighted) * points.velocities[j];
    pressure += viscosity * pressure_of_stresslet(a, weighted).dot(points.velocities[j]);
  }
  return {by_forces / (four_pi * viscosity) + by_contrast / four_pi, pressure / four_pi};
}

template <typename Kernel>
double square_distance(const RingSource::Points& points, const Kernel& kernel,
                       const Vector<2>& place) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vector<2>& x : points.positions) {
    nearest = std::min(nearest, kernel.nearest(place - x).squaredNorm());
  }
  return nearest;
}

template <typename Kernel>
void add_flow_of(const RingSource& source, const Kernel& kernel, double viscosity,
                 std::span<const Vector<2>> places, FlowValues& flow) {
  const double contrast = 1 - source.viscosity_ratio();
  const double reach = near_spacings * source.spacing();
  const std::size_t count = places.size();
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_near = square_distance(source.coarse(), kernel, places[i]) < reach * reach;
    const Sum sum =
        sum_of(is_near ? source.fine() : source.coarse(), kernel, viscosity, contrast, places[i]);
    flow.velocities[i] += sum.velocity;
    flow.pressures[i] += sum.pressure;
  }
}

}  // namespace

RingSource::RingSource(const RingQuadrature& quadrature, const RingContour& ring,
                       std::span<const Vector<2>> forces, std::span<const Vector<2>> velocities,
                       double viscosity_ratio)
    : viscosity_ratio_(viscosity_ratio) {
  coarse_.positions = ring.positions;
  coarse_.forces.assign(forces.begin(), forces.end());
  coarse_.velocities.assign(velocities.begin(), velocities.end());
  coarse_.normals = weighted_normals(ring);
  for (const double length : ring.lengths) spacing_ = std::max(spacing_, length);
  const Eigen::MatrixXd& matrix = quadrature.refinement();
  fine_ = {refined(matrix, coarse_.positions, 1), refined(matrix, coarse_.forces, share),
           refined(matrix, coarse_.normals, share), refined(matrix, coarse_.velocities, 1)};
}

Eigen::MatrixXd single_layer(const RingQuadrature& quadrature, const RingContour& ring,
                             const StokesKernel& kernel, double viscosity) {
  return std::visit([&](const auto& k) { return single_layer_of(quadrature, ring, k, viscosity); },
                    kernel);
}

Eigen::MatrixXd double_layer(const RingQuadrature& quadrature, const RingContour& ring,
                             const StokesKernel& kernel) {
  return std::visit([&](const auto& k) { return double_layer_of(quadrature, ring, k); }, kernel);
}

void add_ring_flow(const RingSource& source, const StokesKernel& kernel, double viscosity,
                   std::span<const Vector<2>> places, FlowValues& flow) {
  std::visit([&](const auto& k) { add_flow_of(source, k, viscosity, places, flow); }, kernel);
}

}  // namespace hemoscale::micro
