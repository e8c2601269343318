#include "micro/mps/pressure_gradient.hpp"

#include <algorithm>

namespace hemoscale::micro {

namespace {

template <int dim>
void lowest_around(const std::vector<Vector<dim>>& gradient, const NeighbourTable& table,
                   const std::vector<double>& pressures, std::vector<double>& lowest) {
  const std::size_t count = table.size();
  lowest.resize(count);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < count; ++i) {
    double least = pressures[i];
    for (std::size_t k = table.begin(i); k < table.end(i); ++k) {
      if (!gradient[k].isZero(0)) least = std::min(least, pressures[table[k]]);
    }
    lowest[i] = least;
  }
}

/// result_i = sum_j g_ij value(i, j).
template <int dim, typename PairValue>
void sum_pairs(const std::vector<Vector<dim>>& gradient, const NeighbourTable& table,
               std::vector<Vector<dim>>& result, const PairValue& value) {
  const std::size_t count = table.size();
  result.resize(count);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < count; ++i) {
    Vector<dim> sum = Vector<dim>::Zero();
    for (std::size_t k = table.begin(i); k < table.end(i); ++k) {
      sum += value(i, table[k]) * gradient[k];
    }
    result[i] = sum;
  }
}

}  // namespace

template <int dim>
void apply_pressure_gradient(GradientForm form, const std::vector<Vector<dim>>& gradient,
                             const NeighbourTable& table, const std::vector<double>& pressures,
                             std::vector<double>& lowest, std::vector<Vector<dim>>& result) {
  if (form != GradientForm::difference) lowest_around(gradient, table, pressures, lowest);
  switch (form) {
    case GradientForm::difference:
      sum_pairs(gradient, table, result,
                [&](std::size_t i, std::size_t j) { return pressures[j] - pressures[i]; });
      break;
    case GradientForm::minimum:
      sum_pairs(gradient, table, result,
                [&](std::size_t i, std::size_t j) { return pressures[j] - lowest[i]; });
      break;
    case GradientForm::antisymmetric:
      sum_pairs(gradient, table, result, [&](std::size_t i, std::size_t j) {
        return pressures[i] + pressures[j] - (lowest[i] + lowest[j]);
      });
      break;
  }
}

template void apply_pressure_gradient<2>(GradientForm, const std::vector<Vector<2>>&,
                                         const NeighbourTable&, const std::vector<double>&,
                                         std::vector<double>&, std::vector<Vector<2>>&);
template void apply_pressure_gradient<3>(GradientForm, const std::vector<Vector<3>>&,
                                         const NeighbourTable&, const std::vector<double>&,
                                         std::vector<double>&, std::vector<Vector<3>>&);

}  // namespace hemoscale::micro
