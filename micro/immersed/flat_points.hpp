#pragma once

#include <Eigen/Core>
#include <vector>

#include "micro/vector.hpp"

namespace hemoscale::micro {

/// Points as one column (x_0, y_0, x_1, ...), and back.
inline Eigen::VectorXd flat_of(const std::vector<Vector<2>>& points) {
  if (points.empty()) return {};
  return Eigen::Map<const Eigen::VectorXd>(points.front().data(),
                                           static_cast<Eigen::Index>(2 * points.size()));
}

inline std::vector<Vector<2>> points_of(const Eigen::VectorXd& flat) {
  std::vector<Vector<2>> points(static_cast<std::size_t>(flat.size() / 2));
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i] = flat.segment<2>(static_cast<Eigen::Index>(2 * i));
  }
  return points;
}

}  // namespace hemoscale::micro
