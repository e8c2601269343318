#include "macro/kinematics.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace hemoscale::macro {
namespace {

// L(i,j) = d u_i / d x_j of u = (x + 2 y, 5 x - y): symmetric part ((1, 3.5), (3.5, -1)).
Tensor<2> asymmetric_plane() {
  Tensor<2> L;
  L << 1, 2, 5, -1;
  return L;
}

// Rigid rotation u = Omega x r.
Tensor<3> rotation(const Vector<3>& omega) {
  Tensor<3> L;
  L << 0, -omega[2], omega[1], omega[2], 0, -omega[0], -omega[1], omega[0], 0;
  return L;
}

TEST(Kinematics, an_asymmetric_gradient_splits_into_deformation_and_spin) {
  const Tensor<2> L = asymmetric_plane();
  Tensor<2> D;
  D << 1, 3.5, 3.5, -1;
  Tensor<2> W;
  W << 0, -1.5, 1.5, 0;
  EXPECT_TRUE(rate_of_deformation<2>(L).isApprox(D, 1e-15));
  EXPECT_TRUE(spin<2>(L).isApprox(W, 1e-15));
}

TEST(Kinematics, shear_rate_is_the_root_of_twice_D_contracted_with_D) {
  EXPECT_NEAR(shear_rate<2>(asymmetric_plane()), std::sqrt(2 * (1 + 1 + 2 * 3.5 * 3.5)), 1e-14);
}

TEST(Kinematics, shear_rate_of_simple_shear_is_its_slope) {
  Tensor<2> plane = Tensor<2>::Zero();
  plane(0, 1) = -7;
  EXPECT_NEAR(shear_rate<2>(plane), 7, 1e-14);
  Tensor<3> space = Tensor<3>::Zero();
  space(2, 0) = 3;
  EXPECT_NEAR(shear_rate<3>(space), 3, 1e-14);
}

TEST(Kinematics, shear_rate_of_plane_extension_is_twice_the_stretching) {
  Tensor<3> L = Tensor<3>::Zero();
  L(0, 0) = 4;
  L(1, 1) = -4;
  EXPECT_NEAR(shear_rate<3>(L), 8, 1e-14);
}

TEST(Kinematics, shear_rate_does_not_notice_rotation) {
  const Tensor<3> W = rotation({1, -2, 3});
  EXPECT_EQ(shear_rate<3>(W), 0);
  Tensor<3> L = Tensor<3>::Zero();
  L(0, 1) = 5;
  EXPECT_NEAR(shear_rate<3>(Tensor<3>(L + W)), 5, 1e-14);
}

TEST(Kinematics, vorticity_is_twice_the_angular_velocity) {
  const Vector<3> omega(1, -2, 3);
  EXPECT_TRUE(vorticity(rotation(omega)).isApprox(2 * omega, 1e-15));
  EXPECT_EQ(vorticity(asymmetric_plane()), 3);
}

TEST(Kinematics, vorticity_of_a_transposed_gradient_has_the_opposite_sign) {
  const Tensor<2> L = asymmetric_plane();
  const Tensor<2> as_openfoam_stores_it = L.transpose();
  EXPECT_EQ(vorticity(as_openfoam_stores_it), -vorticity(L));
  EXPECT_EQ(shear_rate<2>(as_openfoam_stores_it), shear_rate<2>(L));
}

TEST(Kinematics, plane_vorticity_is_the_third_component_of_that_in_space) {
  Tensor<3> L = Tensor<3>::Zero();
  L.topLeftCorner<2, 2>() = asymmetric_plane();
  EXPECT_EQ(vorticity(L)[2], vorticity(asymmetric_plane()));
}

TEST(Kinematics, flow_type_of_plane_flows_is_their_ratio_of_gradients) {
  for (const double alpha : {-1.0, -0.4, 0.0, 0.3, 1.0}) {
    Tensor<2> L;
    L << 0, 2, 2 * alpha, 0;
    ASSERT_TRUE(flow_type<2>(L).has_value());
    EXPECT_NEAR(*flow_type<2>(L), alpha, 1e-15);
  }
}

TEST(Kinematics, flow_type_of_fluid_at_rest_is_empty) {
  EXPECT_FALSE(flow_type<2>(Tensor<2>::Zero()).has_value());
  EXPECT_FALSE(flow_type<3>(Tensor<3>::Zero()).has_value());
}

}  // namespace
}  // namespace hemoscale::macro
