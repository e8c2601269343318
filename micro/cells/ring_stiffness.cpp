#include "micro/cells/ring_stiffness.hpp"

namespace hemoscale::micro {

void RingStiffness::clear() {
  for (auto& row : blocks) {
    row.fill(Tensor<2>::Zero());
  }
  area_coefficient = 0;
}

void multiply(const RingStiffness& stiffness, std::span<const Vector<2>> x,
              std::span<Vector<2>> result) {
  const std::size_t n = stiffness.nodes;
  constexpr std::size_t width = 2 * RingStiffness::reach + 1;
  double volume = 0;
  for (std::size_t i = 0; i < n; ++i) {
    volume += stiffness.area_gradient[i].dot(x[i]);
  }
  volume *= stiffness.area_coefficient;
  for (std::size_t i = 0; i < n; ++i) {
    Vector<2> sum = volume * stiffness.area_gradient[i];
    // n may be less than the reach: blocks then fall on the same column, and add up.
    for (std::size_t k = 0; k < width; ++k) {
      sum += stiffness.blocks[i][k] * x[(i + k + 2 * n - RingStiffness::reach) % n];
    }
    result[i] = sum;
  }
}

Eigen::MatrixXd dense(const RingStiffness& stiffness) {
  const std::size_t n = stiffness.nodes;
  const auto size = static_cast<Eigen::Index>(2 * n);
  Eigen::VectorXd gradient(size);
  for (std::size_t i = 0; i < n; ++i) {
    gradient.segment<2>(static_cast<Eigen::Index>(2 * i)) = stiffness.area_gradient[i];
  }
  Eigen::MatrixXd matrix = stiffness.area_coefficient * gradient * gradient.transpose();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < stiffness.blocks[i].size(); ++k) {
      const std::size_t j = (i + k + 2 * n - RingStiffness::reach) % n;
      matrix.block<2, 2>(static_cast<Eigen::Index>(2 * i), static_cast<Eigen::Index>(2 * j)) +=
          stiffness.blocks[i][k];
    }
  }
  return matrix;
}

}  // namespace hemoscale::micro
