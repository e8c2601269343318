#include "micro/mps/node_sampler.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>

#include "micro/error.hpp"
#include "micro/particles/weight.hpp"

namespace hemoscale::micro {

namespace {

template <int dim>
constexpr int unknowns = 1 + dim + dim*(dim + 1) / 2;

/// 1, x, y, ..., x^2, xy, y^2, ...
template <int dim>
Eigen::Matrix<double, unknowns<dim>, 1> polynomials(const Vector<dim>& r) {
  Eigen::Matrix<double, unknowns<dim>, 1> q;
  q[0] = 1;
  int next = 1;
  for (int a = 0; a < dim; ++a) q[next++] = r[a];
  for (int a = 0; a < dim; ++a) {
    for (int b = a; b < dim; ++b) q[next++] = r[a] * r[b];
  }
  return q;
}

}  // namespace

template <int dim>
NodeSampler<dim>::NodeSampler(std::vector<Vector<dim>> positions, const PeriodicBox<dim>& box,
                              double radius)
    : positions_(std::move(positions)), box_(box), radius_(radius) {
  Vector<dim> upper = positions_.front();
  lower_ = upper;
  for (const Vector<dim>& x : positions_) {
    lower_ = lower_.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }
  std::int64_t count = 1;
  for (int axis = 0; axis < dim; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    if (box_.periodic[a]) {
      lower_[axis] = box_.lower[axis];
      upper[axis] = box_.upper[axis];
    }
    const double extent = upper[axis] - lower_[axis];
    bins_[a] = std::max<std::int64_t>(1, static_cast<std::int64_t>(extent / radius_));
    width_[axis] =
        bins_[a] > 1 ? extent / static_cast<double>(bins_[a]) : std::max(extent, radius_);
    count *= bins_[a];
  }
  bin_first_.assign(static_cast<std::size_t>(count) + 1, 0);
  std::array<std::int64_t, 3> index{};
  std::vector<std::int64_t> bin(positions_.size());
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    bin[i] = bin_of(positions_[i], index);
    ++bin_first_[static_cast<std::size_t>(bin[i]) + 1];
  }
  for (std::size_t b = 1; b < bin_first_.size(); ++b) bin_first_[b] += bin_first_[b - 1];
  bin_nodes_.resize(positions_.size());
  std::vector<std::int32_t> next(bin_first_.begin(), bin_first_.end() - 1);
  for (std::size_t i = 0; i < positions_.size(); ++i) {
    bin_nodes_[static_cast<std::size_t>(next[static_cast<std::size_t>(bin[i])]++)] =
        static_cast<std::int32_t>(i);
  }
}

template <int dim>
std::int64_t NodeSampler<dim>::bin_of(const Vector<dim>& point,
                                      std::array<std::int64_t, 3>& index) const {
  const Vector<dim> x = wrapped(box_, point);
  std::int64_t bin = 0;
  for (int axis = dim - 1; axis >= 0; --axis) {
    const auto a = static_cast<std::size_t>(axis);
    const auto i = static_cast<std::int64_t>(std::floor((x[axis] - lower_[axis]) / width_[axis]));
    index[a] = std::clamp<std::int64_t>(i, 0, bins_[a] - 1);
    bin = bin * bins_[a] + index[a];
  }
  return bin;
}

template <int dim>
std::vector<std::int32_t> NodeSampler<dim>::near(const Vector<dim>& point) const {
  std::array<std::int64_t, 3> centre{};
  bin_of(point, centre);
  std::vector<std::int32_t> found;
  const int cells = dim == 2 ? 9 : 27;
  std::array<std::int64_t, 27> visited{};
  int visits = 0;
  for (int cell = 0; cell < cells; ++cell) {
    std::int64_t bin = 0;
    bool is_inside = true;
    for (int axis = dim - 1; axis >= 0; --axis) {
      const auto a = static_cast<std::size_t>(axis);
      const int digit = (axis == 0 ? cell : axis == 1 ? cell / 3 : cell / 9) % 3 - 1;
      std::int64_t i = centre[a] + digit;
      if (box_.periodic[a]) i = (i + bins_[a]) % bins_[a];
      is_inside = is_inside && i >= 0 && i < bins_[a];
      bin = bin * bins_[a] + i;
    }
    // With fewer than three bins around a period one comes up more than once.
    const auto end = visited.begin() + visits;
    if (!is_inside || std::find(visited.begin(), end, bin) != end) continue;
    visited[static_cast<std::size_t>(visits++)] = bin;
    for (std::int32_t k = bin_first_[static_cast<std::size_t>(bin)];
         k < bin_first_[static_cast<std::size_t>(bin) + 1]; ++k) {
      found.push_back(bin_nodes_[static_cast<std::size_t>(k)]);
    }
  }
  return found;
}

/// Nodes around a point, their weighted polynomials and the factors of the moment matrix.
template <int dim>
struct NodeSampler<dim>::Fit {
  using Row = Eigen::Matrix<double, unknowns<dim>, 1>;
  using Moments = Eigen::Matrix<double, unknowns<dim>, unknowns<dim>>;
  std::vector<std::int32_t> nodes;
  std::vector<Row> rows;
  Eigen::LDLT<Moments> factors;
};

template <int dim>
typename NodeSampler<dim>::Fit NodeSampler<dim>::fit(const Vector<dim>& point) const {
  Fit fit;
  typename Fit::Moments moments = Fit::Moments::Zero();
  for (const std::int32_t j : near(point)) {
    const Vector<dim> r = separation(box_, point, positions_[static_cast<std::size_t>(j)]);
    const double weight = compact_weight(r.norm(), radius_);
    if (weight == 0) continue;
    const typename Fit::Row q = polynomials<dim>(r / radius_);
    moments.noalias() += weight * q * q.transpose();
    fit.nodes.push_back(j);
    fit.rows.push_back(weight * q);
  }
  fit.factors.compute(moments);
  const auto pivots = fit.factors.vectorD();
  if (fit.rows.size() < static_cast<std::size_t>(unknowns<dim>) ||
      !(pivots.minCoeff() > 1e-10 * pivots.maxCoeff())) {
    std::string place;
    for (int axis = 0; axis < dim; ++axis) {
      place += fmt::format("{}{:.4g}", axis == 0 ? "" : ", ", point[axis]);
    }
    throw NumericalError(fmt::format(
        "the flow at ({}) m cannot be interpolated: {} nodes lie within {:.4g} m, {} in general "
        "position are needed; is the point in the fluid?",
        place, fit.rows.size(), radius_, unknowns<dim>));
  }
  return fit;
}

template <int dim>
SampleWeights NodeSampler<dim>::weights(const std::vector<Vector<dim>>& points) const {
  SampleWeights result;
  for (const Vector<dim>& point : points) {
    const Fit around = fit(point);
    const typename Fit::Row value = around.factors.solve(Fit::Row::Unit(0));
    result.nodes.insert(result.nodes.end(), around.nodes.begin(), around.nodes.end());
    for (const auto& row : around.rows) result.weights.push_back(value.dot(row));
    result.first.push_back(result.nodes.size());
  }
  return result;
}

template <int dim>
std::vector<Tensor<dim>> NodeSampler<dim>::gradients(const std::vector<Vector<dim>>& points,
                                                     const std::vector<Vector<dim>>& field) const {
  std::vector<Tensor<dim>> result(points.size(), Tensor<dim>::Zero());
  for (std::size_t p = 0; p < points.size(); ++p) {
    const Fit around = fit(points[p]);
    for (int axis = 0; axis < dim; ++axis) {
      const typename Fit::Row slope = around.factors.solve(Fit::Row::Unit(1 + axis));
      for (std::size_t k = 0; k < around.nodes.size(); ++k) {
        result[p].col(axis) +=
            slope.dot(around.rows[k]) / radius_ * field[static_cast<std::size_t>(around.nodes[k])];
      }
    }
  }
  return result;
}

template class NodeSampler<2>;
template class NodeSampler<3>;

}  // namespace hemoscale::micro
