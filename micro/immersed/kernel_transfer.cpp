#include "micro/immersed/kernel_transfer.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <limits>

#include "micro/error.hpp"

namespace hemoscale::micro {

std::vector<double> node_areas(const ParticleSet<2>& nodes, const NodeBins<2>& bins,
                               double spacing) {
  constexpr int samples = 8;  // to a spacing
  const double step = spacing / samples;
  const Vector<2> extent = bins.upper() - bins.lower();
  const auto columns = std::max(1L, std::lround(extent[0] / step));
  const auto lines = std::max(1L, std::lround(extent[1] / step));
  const Vector<2> h(extent[0] / static_cast<double>(columns),
                    extent[1] / static_cast<double>(lines));
  std::vector<double> areas(nodes.size(), 0);
  for (long j = 0; j < lines; ++j) {
    for (long i = 0; i < columns; ++i) {
      const Vector<2> x = bins.lower() + h.cwiseProduct(Vector<2>(static_cast<double>(i) + 0.5,
                                                                  static_cast<double>(j) + 0.5));
      double least = spacing * spacing;  // farther from any node there is no fluid
      std::size_t nearest = nodes.size();
      Vector<2> towards = Vector<2>::Zero();
      bins.visit_around(x, 1, [&](std::size_t k, const Vector<2>& r) {
        const double squared = r.squaredNorm();
        if (squared > least || (squared == least && k > nearest)) return;
        least = squared;
        nearest = k;
        towards = r;
      });
      if (nearest == nodes.size() || towards.dot(nodes.normals[nearest]) < 0) continue;
      areas[nearest] += h[0] * h[1];
    }
  }
  return areas;
}

KernelTransfer::KernelTransfer(const ParticleSet<2>& nodes, const PeriodicBox<2>& box,
                               double spacing, TransferKernel kernel)
    : spacing_(spacing),
      kernel_(kernel),
      bins_(nodes.positions, box, spacing),
      areas_(node_areas(nodes, bins_, spacing)) {}

KernelRows KernelTransfer::rows(std::span<const Vector<2>> points) const {
  using Moments = Eigen::Matrix3d;
  KernelRows rows;
  rows.first.reserve(points.size() + 1);
  std::vector<Vector<2>> places;  // of the nodes of one row, in spacings
  for (const Vector<2>& point : points) {
    const std::size_t begin = rows.nodes.size();
    Moments moments = Moments::Zero();
    places.clear();
    bins_.visit_around(point, 2, [&](std::size_t k, const Vector<2>& distance) {
      const Vector<2> r = distance / spacing_;
      const double weight = kernel_weight(kernel_, r[0]) * kernel_weight(kernel_, r[1]) *
                            areas_[k] / (spacing_ * spacing_);
      if (!(weight > 0)) return;
      const Eigen::Vector3d p(1, r[0], r[1]);
      moments += weight * p * p.transpose();
      rows.nodes.push_back(k);
      rows.weights.push_back(weight);
      places.push_back(r);
    });
    const Eigen::LDLT<Moments> factored(moments);
    // Inside the domain, also on a wall, the smallest pivot is some hundredths.
    const double pivot = places.empty() ? 0 : factored.vectorD().minCoeff();
    if (!(pivot > 1e-6)) {
      throw NumericalError(fmt::format(
          "the {} nodes around a membrane node at ({:.6g}, {:.6g}) m do not determine its velocity "
          "(smallest pivot {:.3g}, at least 1e-06 is needed): it is outside the fluid; move the "
          "cell, or reduce the time step",
          places.size(), point[0], point[1], pivot));
    }
    const Eigen::Vector3d c = factored.solve(Eigen::Vector3d::UnitX());
    for (std::size_t n = begin; n < rows.nodes.size(); ++n) {
      const Vector<2>& r = places[n - begin];
      rows.weights[n] *= c[0] + c[1] * r[0] + c[2] * r[1];
    }
    rows.first.push_back(rows.nodes.size());
  }
  return rows;
}

std::vector<Vector<2>> KernelTransfer::interpolate(const KernelRows& rows,
                                                   const std::vector<Vector<2>>& field) const {
  std::vector<Vector<2>> values(rows.first.size() - 1, Vector<2>::Zero());
  for (std::size_t p = 0; p < values.size(); ++p) {
    for (std::size_t n = rows.first[p]; n < rows.first[p + 1]; ++n) {
      values[p] += rows.weights[n] * field[rows.nodes[n]];
    }
  }
  return values;
}

void KernelTransfer::spread(const KernelRows& rows, std::span<const Vector<2>> forces,
                            double density, std::vector<Vector<2>>& accelerations) const {
  for (std::size_t p = 0; p < forces.size(); ++p) {
    for (std::size_t n = rows.first[p]; n < rows.first[p + 1]; ++n) {
      const std::size_t node = rows.nodes[n];
      accelerations[node] += rows.weights[n] / (density * areas_[node]) * forces[p];
    }
  }
}

}  // namespace hemoscale::micro
