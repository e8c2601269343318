#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "macro/kinematics.hpp"
#include "tests/property/macro/random_numbers.hpp"

namespace hemoscale::macro {
namespace {

Tensor<3> random_gradient(RandomNumbers& numbers) {
  Tensor<3> L;
  for (int i = 0; i < 9; ++i) L(i / 3, i % 3) = numbers.between(-100, 100);
  return L;
}

Tensor<3> random_rotation(RandomNumbers& numbers) {
  Vector<3> axis;
  for (int i = 0; i < 3; ++i) axis[i] = numbers.between(-1, 1);
  return Eigen::AngleAxisd(numbers.between(-3, 3), axis.normalized()).toRotationMatrix();
}

TEST(KinematicsProperty, invariants_do_not_depend_on_the_frame) {
  RandomNumbers numbers(11);
  for (int trial = 0; trial < 200; ++trial) {
    const Tensor<3> L = random_gradient(numbers);
    const Tensor<3> Q = random_rotation(numbers);
    const Tensor<3> turned = Q * L * Q.transpose();
    EXPECT_NEAR(shear_rate<3>(turned), shear_rate<3>(L), 1e-11);
    EXPECT_NEAR(*flow_type<3>(turned), *flow_type<3>(L), 1e-13);
    EXPECT_LT((vorticity(turned) - Q * vorticity(L)).norm(), 1e-11);
  }
}

TEST(KinematicsProperty, deformation_and_spin_add_up_and_do_not_overlap) {
  RandomNumbers numbers(12);
  for (int trial = 0; trial < 200; ++trial) {
    const Tensor<3> L = random_gradient(numbers);
    const Tensor<3> D = rate_of_deformation<3>(L);
    const Tensor<3> W = spin<3>(L);
    EXPECT_LT((D + W - L).norm(), 1e-12);
    EXPECT_NEAR(D.cwiseProduct(W).sum(), 0, 1e-9);
    // |W|^2 = |omega|^2 / 2 ties the spin to the vorticity.
    EXPECT_NEAR(W.squaredNorm(), 0.5 * vorticity(L).squaredNorm(), 1e-9);
  }
}

}  // namespace
}  // namespace hemoscale::macro
