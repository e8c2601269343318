#include <gtest/gtest.h>

#include "micro/immersed/secant_map.hpp"

namespace hemoscale::micro {
namespace {

Eigen::VectorXd column(double x, double y, double z) {
  return Eigen::Vector3d(x, y, z);
}

TEST(SecantMap, repeats_what_it_has_learned_and_changes_nothing_across) {
  SecantMap map(3);
  const Eigen::VectorXd f = column(1, 2, -1);
  const Eigen::VectorXd v = column(3, 0, 5);
  const Eigen::VectorXd across = column(1, 0, 1);  // no part along f
  EXPECT_EQ(map(f).norm(), 0);
  map.learn(across, column(7, 8, 9));
  map.learn(f, v);
  EXPECT_LT((map(f) - v).norm(), 1e-14);
  EXPECT_LT((map(2 * f) - 2 * v).norm(), 1e-14);
  EXPECT_LT((map(across) - column(7, 8, 9)).norm(), 1e-14);
}

TEST(SecantMap, knows_a_linear_map_after_as_many_independent_examples) {
  Eigen::Matrix3d truth;
  truth << 1, 2, 3, -4, 5, 6, 7, 8, -9;
  SecantMap map(3);
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d f = Eigen::Vector3d::Unit(axis) * (axis + 2);
    map.learn(f, truth * f);
  }
  EXPECT_LT((map.matrix() - truth).norm(), 1e-13);
}

TEST(SecantMap, learns_nothing_from_a_zero) {
  SecantMap map(3);
  map.learn(column(0, 0, 0), column(1, 1, 1));
  EXPECT_EQ(map.matrix().norm(), 0);
}

TEST(SecantMap, is_restored_from_its_matrix) {
  SecantMap map(3);
  map.learn(column(1, 2, -1), column(3, 0, 5));
  SecantMap other(3);
  other.restore(map.matrix());
  EXPECT_EQ(other(column(4, 5, 6)), map(column(4, 5, 6)));
}

}  // namespace
}  // namespace hemoscale::micro
