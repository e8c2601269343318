#include "micro/mps/least_squares.hpp"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <string>

#include "micro/error.hpp"
#include "micro/particles/weight.hpp"

namespace hemoscale::micro {

namespace {

/// Number of first and second derivatives.
template <int dim>
constexpr int terms = dim + dim*(dim + 1) / 2;

template <int dim>
using Moments = Eigen::Matrix<double, terms<dim>, terms<dim>>;
template <int dim>
using Monomials = Eigen::Matrix<double, terms<dim>, 1>;

/// (x, y, x^2/2, xy, y^2/2) in two dimensions; (x, y, z, x^2/2, xy, xz, y^2/2, yz, z^2/2) in three.
template <int dim>
Monomials<dim> monomials(const Vector<dim>& r) {
  Monomials<dim> q;
  if constexpr (dim == 2) {
    q << r[0], r[1], r[0] * r[0] / 2, r[0] * r[1], r[1] * r[1] / 2;
  } else {
    q << r[0], r[1], r[2], r[0] * r[0] / 2, r[0] * r[1], r[0] * r[2], r[1] * r[1] / 2, r[1] * r[2],
        r[2] * r[2] / 2;
  }
  return q;
}

/// Where the diagonal second derivatives stand among the monomials.
template <int dim>
double laplacian_of(const Monomials<dim>& a) {
  if constexpr (dim == 2) return a[2] + a[4];
  if constexpr (dim == 3) return a[3] + a[6] + a[8];
}

template <int dim>
Tensor<dim> hessian_of(const Monomials<dim>& a) {
  Tensor<dim> h;
  if constexpr (dim == 2) {
    h << a[2], a[3], a[3], a[4];
  } else {
    h << a[3], a[4], a[5], a[4], a[6], a[7], a[5], a[7], a[8];
  }
  return h;
}

template <int dim>
double norm1(const Moments<dim>& matrix) {
  return matrix.cwiseAbs().colwise().sum().maxCoeff();
}

/// Inverse of the moment matrix of a particle, lengths over the radius; its condition number, or a
/// negative value if the matrix is singular.
template <int dim>
double invert_moments(const LeastSquares& fit, const std::vector<Vector<dim>>& positions,
                      const PeriodicBox<dim>& box, const NeighbourTable& table, std::size_t i,
                      Moments<dim>& inverse) {
  Moments<dim> moments = Moments<dim>::Zero();
  for (std::size_t k = table.begin(i); k < table.end(i); ++k) {
    const Vector<dim> r = separation(box, positions[i], positions[table[k]]);
    const double weight = compact_weight(r.norm(), fit.radius);
    if (weight == 0) continue;
    const Monomials<dim> q = monomials<dim>(r / fit.radius);
    moments.template selfadjointView<Eigen::Lower>().rankUpdate(q, weight);
  }
  moments = moments.template selfadjointView<Eigen::Lower>();
  const Eigen::LLT<Moments<dim>> factor(moments);
  if (factor.info() != Eigen::Success) return -1;
  inverse = factor.solve(Moments<dim>::Identity());
  return norm1<dim>(moments) * norm1<dim>(inverse);
}

template <int dim>
std::string place_of(const Vector<dim>& x) {
  std::string text = fmt::format("({:.6g}, {:.6g}", x[0], x[1]);
  if constexpr (dim == 3) text += fmt::format(", {:.6g}", x[2]);
  return text + ") m";
}

template <int dim>
void check_condition(const LeastSquares& fit, const std::vector<Vector<dim>>& positions,
                     const PeriodicBox<dim>& box, const NeighbourTable& table, std::size_t i,
                     double condition) {
  if (condition >= 0 && condition <= fit.condition_bound) return;
  int near = 0;
  for (std::size_t k = table.begin(i); k < table.end(i); ++k) {
    if (separation(box, positions[i], positions[table[k]]).norm() < fit.radius) ++near;
  }
  throw NumericalError(fmt::format(
      "particle {} at {} has {} neighbours within {:.4g} m; its moment matrix {}, the limit is "
      "{:.3g}; enlarge the kernel radius, or reduce the time step if particles have drifted apart",
      i, place_of<dim>(positions[i]), near, fit.radius,
      condition < 0 ? std::string("is singular")
                    : fmt::format("has the condition number {:.3g}", condition),
      fit.condition_bound));
}

}  // namespace

template <int dim>
Stencils<dim> least_squares_stencils(const LeastSquares& fit,
                                     const std::vector<Vector<dim>>& positions,
                                     const PeriodicBox<dim>& box, const NeighbourTable& table,
                                     FitQuality* quality, const Communicator* ranks) {
  const std::size_t count = table.size();
  Stencils<dim> stencils;
  if (ranks != nullptr && ranks->size() > 1) {
    stencils.ranks = ranks;
    stencils.own = own_nodes(count, *ranks);
  }
  const NodeRange rows = stencils.rows(count);
  stencils.gradient.resize(table.pairs());
  stencils.laplacian.resize(table.pairs());
  std::vector<double> conditions(count);
  const double first = 1 / fit.radius;
  const double second = 1 / (fit.radius * fit.radius);
#pragma omp parallel for schedule(static)
  for (std::size_t i = rows.begin; i < rows.end; ++i) {
    Moments<dim> inverse;
    conditions[i] = invert_moments(fit, positions, box, table, i, inverse);
    if (conditions[i] < 0) continue;
    for (std::size_t k = table.begin(i); k < table.end(i); ++k) {
      const Vector<dim> r = separation(box, positions[i], positions[table[k]]);
      const double weight = compact_weight(r.norm(), fit.radius);
      const Monomials<dim> a = inverse * (weight * monomials<dim>(r / fit.radius));
      stencils.gradient[k] = first * a.template head<dim>();
      stencils.laplacian[k] = second * laplacian_of<dim>(a);
    }
  }
  // The first particle in order is named, whichever thread or rank has met it.
  gather_rows(stencils, conditions);
  FitQuality worst;
  for (std::size_t i = 0; i < count; ++i) {
    check_condition(fit, positions, box, table, i, conditions[i]);
    if (conditions[i] > worst.largest_condition) worst = {conditions[i], i};
  }
  if (quality != nullptr) *quality = worst;
  return stencils;
}

template <int dim>
std::vector<double> laplacian_weights(const LeastSquares& fit,
                                      const std::vector<Vector<dim>>& points) {
  const std::size_t centre = points.size() - 1;
  NeighbourTable table;
  table.build<dim>(points, {}, fit.radius);
  Moments<dim> inverse;
  check_condition(fit, points, {}, table, centre,
                  invert_moments(fit, points, {}, table, centre, inverse));
  std::vector<double> weights(centre, 0.0);
  for (std::size_t k = table.begin(centre); k < table.end(centre); ++k) {
    const Vector<dim> r = points[table[k]] - points[centre];
    const Monomials<dim> a =
        inverse * (compact_weight(r.norm(), fit.radius) * monomials<dim>(r / fit.radius));
    weights[table[k]] = laplacian_of<dim>(a) / (fit.radius * fit.radius);
  }
  return weights;
}

template <int dim>
FlowDerivatives<dim> flow_derivatives(const LeastSquares& fit,
                                      const std::vector<Vector<dim>>& positions,
                                      const PeriodicBox<dim>& box, const NeighbourTable& table,
                                      const std::vector<Vector<dim>>& velocities,
                                      const std::vector<double>& pressures, std::size_t particle) {
  Moments<dim> inverse;
  check_condition(fit, positions, box, table, particle,
                  invert_moments(fit, positions, box, table, particle, inverse));
  // One column for each component of the velocity, the last for the pressure.
  Eigen::Matrix<double, terms<dim>, dim + 1> sums =
      Eigen::Matrix<double, terms<dim>, dim + 1>::Zero();
  for (std::size_t k = table.begin(particle); k < table.end(particle); ++k) {
    const std::size_t j = table[k];
    const Vector<dim> r = separation(box, positions[particle], positions[j]);
    const double weight = compact_weight(r.norm(), fit.radius);
    Eigen::Matrix<double, 1, dim + 1> difference;
    difference.template head<dim>() = (velocities[j] - velocities[particle]).transpose();
    difference[dim] = pressures[j] - pressures[particle];
    sums += weight * monomials<dim>(r / fit.radius) * difference;
  }
  const Eigen::Matrix<double, terms<dim>, dim + 1> solution = inverse * sums;
  const auto derivatives = [&](int column) {
    const Monomials<dim> a = solution.col(column);
    Derivatives<dim> d;
    d.gradient = a.template head<dim>() / fit.radius;
    d.hessian = hessian_of<dim>(a) / (fit.radius * fit.radius);
    return d;
  };
  FlowDerivatives<dim> result;
  for (int c = 0; c < dim; ++c) result.velocity[static_cast<std::size_t>(c)] = derivatives(c);
  result.pressure = derivatives(dim);
  return result;
}

template <int dim>
std::vector<FlowSample<dim>> interpolate_flow(const LeastSquares& fit,
                                              const std::vector<Vector<dim>>& positions,
                                              const PeriodicBox<dim>& box,
                                              const std::vector<Vector<dim>>& velocities,
                                              const std::vector<double>& pressures,
                                              const std::vector<Vector<dim>>& points) {
  // The points join the particles for the search of neighbours alone.
  std::vector<Vector<dim>> all = positions;
  all.insert(all.end(), points.begin(), points.end());
  NeighbourTable table;
  table.build(all, box, fit.radius);

  constexpr int unknowns = terms<dim> + 1;
  std::vector<FlowSample<dim>> samples(points.size());
  for (std::size_t p = 0; p < points.size(); ++p) {
    const std::size_t row = positions.size() + p;
    std::vector<std::size_t> near;
    for (std::size_t k = table.begin(row); k < table.end(row); ++k) {
      if (table[k] < positions.size()) near.push_back(table[k]);
    }
    const auto equations = static_cast<Eigen::Index>(near.size());
    Eigen::Matrix<double, Eigen::Dynamic, unknowns> matrix(equations, unknowns);
    Eigen::Matrix<double, Eigen::Dynamic, dim + 1> values(equations, dim + 1);
    for (Eigen::Index e = 0; e < equations; ++e) {
      const std::size_t j = near[static_cast<std::size_t>(e)];
      const Vector<dim> r = separation(box, points[p], positions[j]);
      const double root_weight = std::sqrt(compact_weight(r.norm(), fit.radius));
      matrix(e, 0) = root_weight;
      matrix.template block<1, terms<dim>>(e, 1) =
          root_weight * monomials<dim>(r / fit.radius).transpose();
      values.template block<1, dim>(e, 0) = root_weight * velocities[j].transpose();
      values(e, dim) = root_weight * pressures[j];
    }
    Eigen::ColPivHouseholderQR<Eigen::Matrix<double, Eigen::Dynamic, unknowns>> qr(matrix);
    if (equations < unknowns || qr.rank() < unknowns) {
      throw NumericalError(fmt::format(
          "the flow at {} cannot be interpolated: {} particles lie within {:.4g} m, {} in general "
          "position are needed; is the point in the fluid?",
          place_of<dim>(points[p]), equations, fit.radius, unknowns));
    }
    const Eigen::Matrix<double, unknowns, dim + 1> solution = qr.solve(values);
    samples[p].velocity = solution.template block<1, dim>(0, 0).transpose();
    samples[p].pressure = solution(0, dim);
    samples[p].velocity_gradient = solution.template block<dim, dim>(1, 0).transpose() / fit.radius;
  }
  return samples;
}

#define HEMOSCALE_INSTANTIATE(dim)                                                        \
  template std::vector<double> laplacian_weights<dim>(const LeastSquares&,                \
                                                      const std::vector<Vector<dim>>&);   \
  template Stencils<dim> least_squares_stencils<dim>(                                     \
      const LeastSquares&, const std::vector<Vector<dim>>&, const PeriodicBox<dim>&,      \
      const NeighbourTable&, FitQuality*, const Communicator*);                           \
  template FlowDerivatives<dim> flow_derivatives<dim>(                                    \
      const LeastSquares&, const std::vector<Vector<dim>>&, const PeriodicBox<dim>&,      \
      const NeighbourTable&, const std::vector<Vector<dim>>&, const std::vector<double>&, \
      std::size_t);                                                                       \
  template std::vector<FlowSample<dim>> interpolate_flow<dim>(                            \
      const LeastSquares&, const std::vector<Vector<dim>>&, const PeriodicBox<dim>&,      \
      const std::vector<Vector<dim>>&, const std::vector<double>&,                        \
      const std::vector<Vector<dim>>&);
HEMOSCALE_INSTANTIATE(2)
HEMOSCALE_INSTANTIATE(3)
#undef HEMOSCALE_INSTANTIATE

}  // namespace hemoscale::micro
