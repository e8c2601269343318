#pragma once

#include <Eigen/Core>

namespace hemoscale::macro {

/// Vector and second-order tensor of `dim` components; the same Eigen types as in `micro`, so that
/// values cross between the scales without conversion.
template <int dim>
using Vector = Eigen::Matrix<double, dim, 1>;
template <int dim>
using Tensor = Eigen::Matrix<double, dim, dim>;

}  // namespace hemoscale::macro
