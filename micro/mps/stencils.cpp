#include "micro/mps/stencils.hpp"

#include <cstddef>

namespace hemoscale::micro {

template <int dim>
void gather_rows(const Stencils<dim>& stencils, std::vector<double>& values) {
  if (stencils.ranks == nullptr) return;
  const std::vector<double> own(values.begin() + static_cast<std::ptrdiff_t>(stencils.own.begin),
                                values.begin() + static_cast<std::ptrdiff_t>(stencils.own.end));
  stencils.ranks->all_gather_ranges(own.data(), own.size(), values.data(), values.size());
}

template <int dim>
void gather_rows(const Stencils<dim>& stencils, std::vector<Vector<dim>>& values) {
  if (stencils.ranks == nullptr) return;
  constexpr auto components = static_cast<std::size_t>(dim);
  std::vector<double> own;
  own.reserve(stencils.own.size() * components);
  for (std::size_t i = stencils.own.begin; i < stencils.own.end; ++i) {
    own.insert(own.end(), values[i].data(), values[i].data() + dim);
  }
  std::vector<double> whole(values.size() * components);
  stencils.ranks->all_gather_ranges(own.data(), own.size(), whole.data(), whole.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = Eigen::Map<const Vector<dim>>(whole.data() + i * components);
  }
}

namespace {

/// result_i = sum over the neighbours of term(entry, i, j), from `zero`.
template <int dim, typename Value, typename Term>
void sum_rows(const Stencils<dim>& stencils, const NeighbourTable& table, const Value& zero,
              std::vector<Value>& result, const Term& term) {
  result.resize(table.size());
  const NodeRange rows = stencils.rows(table.size());
#pragma omp parallel for schedule(static)
  for (std::size_t i = rows.begin; i < rows.end; ++i) {
    Value sum = zero;
    for (std::size_t k = table.begin(i); k < table.end(i); ++k) sum += term(k, i, table[k]);
    result[i] = sum;
  }
  gather_rows(stencils, result);
}

}  // namespace

template <int dim>
void apply_gradient(const Stencils<dim>& stencils, const NeighbourTable& table,
                    const std::vector<double>& field, std::vector<Vector<dim>>& result) {
  const Vector<dim> zero = Vector<dim>::Zero();
  sum_rows(stencils, table, zero, result,
           [&](std::size_t k, std::size_t i, std::size_t j) -> Vector<dim> {
             return stencils.gradient[k] * (field[j] - field[i]);
           });
}

template <int dim>
void apply_laplacian(const Stencils<dim>& stencils, const NeighbourTable& table,
                     const std::vector<double>& field, std::vector<double>& result) {
  sum_rows(stencils, table, 0.0, result, [&](std::size_t k, std::size_t i, std::size_t j) {
    return stencils.laplacian[k] * (field[j] - field[i]);
  });
}

template <int dim>
void apply_laplacian(const Stencils<dim>& stencils, const NeighbourTable& table,
                     const std::vector<Vector<dim>>& field, std::vector<Vector<dim>>& result) {
  const Vector<dim> zero = Vector<dim>::Zero();
  sum_rows(stencils, table, zero, result,
           [&](std::size_t k, std::size_t i, std::size_t j) -> Vector<dim> {
             return stencils.laplacian[k] * (field[j] - field[i]);
           });
}

template <int dim>
void apply_divergence(const Stencils<dim>& stencils, const NeighbourTable& table,
                      const std::vector<Vector<dim>>& field, std::vector<double>& result) {
  sum_rows(stencils, table, 0.0, result, [&](std::size_t k, std::size_t i, std::size_t j) {
    return stencils.gradient[k].dot(field[j] - field[i]);
  });
}

template <int dim>
Tensor<dim> velocity_gradient(const Stencils<dim>& stencils, const NeighbourTable& table,
                              const std::vector<Vector<dim>>& velocities, std::size_t particle) {
  Tensor<dim> gradient = Tensor<dim>::Zero();
  for (std::size_t k = table.begin(particle); k < table.end(particle); ++k) {
    gradient += (velocities[table[k]] - velocities[particle]) * stencils.gradient[k].transpose();
  }
  return gradient;
}

#define HEMOSCALE_INSTANTIATE(dim)                                                                \
  template void gather_rows<dim>(const Stencils<dim>&, std::vector<double>&);                     \
  template void gather_rows<dim>(const Stencils<dim>&, std::vector<Vector<dim>>&);                \
  template void apply_gradient<dim>(const Stencils<dim>&, const NeighbourTable&,                  \
                                    const std::vector<double>&, std::vector<Vector<dim>>&);       \
  template void apply_laplacian<dim>(const Stencils<dim>&, const NeighbourTable&,                 \
                                     const std::vector<double>&, std::vector<double>&);           \
  template void apply_laplacian<dim>(const Stencils<dim>&, const NeighbourTable&,                 \
                                     const std::vector<Vector<dim>>&, std::vector<Vector<dim>>&); \
  template void apply_divergence<dim>(const Stencils<dim>&, const NeighbourTable&,                \
                                      const std::vector<Vector<dim>>&, std::vector<double>&);     \
  template Tensor<dim> velocity_gradient<dim>(const Stencils<dim>&, const NeighbourTable&,        \
                                              const std::vector<Vector<dim>>&, std::size_t);
HEMOSCALE_INSTANTIATE(2)
HEMOSCALE_INSTANTIATE(3)
#undef HEMOSCALE_INSTANTIATE

}  // namespace hemoscale::micro
