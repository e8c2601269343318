#include "micro/mps/node_sampler.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>

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
    : bins_(std::move(positions), box, radius), radius_(radius) {}

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
  bins_.visit_around(point, 1, [&](std::size_t j, const Vector<dim>& r) {
    const double weight = compact_weight(r.norm(), radius_);
    if (weight == 0) return;
    const typename Fit::Row q = polynomials<dim>(r / radius_);
    moments.noalias() += weight * q * q.transpose();
    fit.nodes.push_back(static_cast<std::int32_t>(j));
    fit.rows.push_back(weight * q);
  });
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
