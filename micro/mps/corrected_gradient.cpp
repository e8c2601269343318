#include "micro/mps/corrected_gradient.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>

namespace hemoscale::micro {

namespace {

template <int dim>
bool is_well_conditioned(const Tensor<dim>& matrix, double bound) {
  Eigen::SelfAdjointEigenSolver<Tensor<dim>> eigen;
  eigen.computeDirect(matrix, Eigen::EigenvaluesOnly);
  const double smallest = eigen.eigenvalues()[0];
  return smallest > 0 && eigen.eigenvalues()[dim - 1] <= bound * smallest;
}

}  // namespace

template <int dim>
std::size_t correct_gradient(const PairGeometry<dim>& pairs, const NeighbourTable& table,
                             double condition_bound, const std::vector<char>& wanted,
                             std::vector<Vector<dim>>& gradient) {
  const std::size_t count = table.size();
  std::vector<char> is_plain(count, 0);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < count; ++i) {
    if (!wanted.empty() && wanted[i] == 0) continue;
    Tensor<dim> matrix = Tensor<dim>::Zero();
    for (std::size_t k = table.begin(i); k < table.end(i); ++k) {
      matrix += gradient[k] * pairs.separations[k].transpose();
    }
    if (!is_well_conditioned<dim>(matrix, condition_bound)) {
      is_plain[i] = 1;
      continue;
    }
    const Tensor<dim> correction = matrix.inverse();
    for (std::size_t k = table.begin(i); k < table.end(i); ++k) {
      gradient[k] = (correction * gradient[k]).eval();
    }
  }
  return static_cast<std::size_t>(std::count(is_plain.begin(), is_plain.end(), 1));
}

template std::size_t correct_gradient<2>(const PairGeometry<2>&, const NeighbourTable&, double,
                                         const std::vector<char>&, std::vector<Vector<2>>&);
template std::size_t correct_gradient<3>(const PairGeometry<3>&, const NeighbourTable&, double,
                                         const std::vector<char>&, std::vector<Vector<3>>&);

}  // namespace hemoscale::micro
