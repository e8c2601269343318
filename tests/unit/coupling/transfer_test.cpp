#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include "coupling/error.hpp"
#include "coupling/transfer/shear_frame.hpp"
#include "coupling/transfer/to_forcing.hpp"
#include "coupling/transfer/to_rheology.hpp"

namespace hemoscale::coupling {
namespace {

macro::Tensor<2> gradient(double xx, double xy, double yx, double yy) {
  macro::Tensor<2> L;
  L << xx, xy, yx, yy;
  return L;
}

macro::Tensor<2> rotation(double angle) {
  return gradient(std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle));
}

void expect_near(const macro::Tensor<2>& a, const macro::Tensor<2>& b, double tolerance) {
  EXPECT_LE((a - b).cwiseAbs().maxCoeff(), tolerance) << a << "\n\n" << b;
}

TEST(ShearFrame, simple_shear_along_x_is_already_in_the_frame) {
  const macro::Tensor<2> L = gradient(0, 3, 0, 0);
  const macro::Tensor<2> Q = shear_frame(L);
  expect_near(in_frame(Q, L), L, 1e-15);
  expect_near(Q, macro::Tensor<2>::Identity(), 1e-15);
}

TEST(ShearFrame, shear_of_either_sign_and_direction_becomes_positive_shear) {
  const macro::Tensor<2> wanted = gradient(0, 3, 0, 0);
  for (const macro::Tensor<2>& L :
       {gradient(0, -3, 0, 0), gradient(0, 0, 3, 0), gradient(0, 0, -3, 0)}) {
    expect_near(in_frame(shear_frame(L), L), wanted, 1e-14);
  }
}

// An asymmetric gradient of every kind: straining, shear and rotation in a turned frame. A
// transposed gradient has the opposite vorticity and another flow direction.
TEST(ShearFrame, flow_direction_of_a_turned_shear_is_found) {
  for (const double angle : {0.2, 1.0, 2.5, -0.7}) {
    const macro::Tensor<2> R = rotation(angle);
    const macro::Tensor<2> L = R * gradient(0, 5, 0, 0) * R.transpose();
    const macro::Tensor<2> Q = shear_frame(L);
    EXPECT_NEAR(std::abs(Q.row(0).dot(R.col(0))), 1, 1e-14);
    EXPECT_NEAR(Q.determinant(), 1, 1e-14);
    const macro::Tensor<2> transposed = L.transpose();
    const macro::Tensor<2> Q_transposed = shear_frame(transposed);
    EXPECT_NEAR(std::abs(Q_transposed.row(0).dot(R.col(1))), 1, 1e-14);
    EXPECT_NEAR(Q_transposed.determinant(), -1, 1e-14);
  }
}

TEST(ShearFrame, a_mixed_flow_keeps_its_vorticity_and_divergence) {
  const macro::Tensor<2> L = gradient(2, 1, -4, 1);
  const macro::Tensor<2> Q = shear_frame(L);
  expect_near(Q * Q.transpose(), macro::Tensor<2>::Identity(), 1e-15);
  const macro::Tensor<2> A = in_frame(Q, L);
  EXPECT_NEAR(A(0, 0), 1.5, 1e-14);
  EXPECT_NEAR(A(1, 1), 1.5, 1e-14);
  EXPECT_NEAR(A(0, 1) + A(1, 0), std::hypot(2 - 1, 1 - 4), 1e-14);
  EXPECT_NEAR(A(0, 1) - A(1, 0), 5, 1e-14);  // |vorticity|
}

TEST(ShearFrame, without_strain_it_is_the_frame_of_the_flow) {
  EXPECT_EQ(shear_frame(gradient(0, 2, -2, 0)), (macro::Tensor<2>::Identity()));
  EXPECT_EQ(shear_frame(gradient(0, 0, 0, 0)), (macro::Tensor<2>::Identity()));
}

TEST(ToForcing, simple_shear_at_the_shear_rate_of_an_asymmetric_gradient) {
  macro::FlowState<2> state;
  state.velocity_gradient = gradient(2, 1, -4, -2);
  const ShearForcing result = to_forcing<2>(state, 0.3);
  const double rate = std::sqrt(2 * (4 + 4) + 9.0);  // D = [[2, -1.5], [-1.5, -2]]
  EXPECT_NEAR(result.shear_rate, rate, 1e-14);
  expect_near(result.forcing.velocity_gradient, gradient(0, result.shear_rate, 0, 0), 0);
  EXPECT_EQ(result.forcing.hematocrit, 0.3);
  EXPECT_EQ(result.forcing.body_force, (micro::Vector<2>::Zero()));
  EXPECT_FALSE(result.forcing.profile);
}

TEST(ToForcing, flow_type_tells_shear_from_straining_and_rotation) {
  macro::FlowState<2> state;
  state.velocity_gradient = gradient(0, 0, -7, 0);
  EXPECT_NEAR(to_forcing<2>(state, 0).flow_type, 0, 1e-15);
  state.velocity_gradient = gradient(1, 0, 0, -1);
  EXPECT_NEAR(to_forcing<2>(state, 0).flow_type, 1, 1e-15);
  state.velocity_gradient = gradient(0, 1, -1, 0);
  EXPECT_NEAR(to_forcing<2>(state, 0).flow_type, -1, 1e-15);
  state.velocity_gradient.setZero();
  EXPECT_EQ(to_forcing<2>(state, 0).flow_type, 0);
  EXPECT_EQ(to_forcing<2>(state, 0).shear_rate, 0);
}

TEST(ToForcing, shear_in_space_in_any_plane) {
  macro::FlowState<3> state;
  state.velocity_gradient(2, 0) = -6;  // d u_z / d x
  const ShearForcing result = to_forcing<3>(state, 0.45);
  EXPECT_NEAR(result.shear_rate, 6, 1e-14);
  EXPECT_NEAR(result.flow_type, 0, 1e-15);
  EXPECT_EQ(result.forcing.velocity_gradient(0, 1), result.shear_rate);
}

TEST(ToForcing, a_gradient_that_is_not_finite_is_refused) {
  macro::FlowState<2> state;
  state.velocity_gradient(1, 0) = std::nan("");
  EXPECT_THROW(to_forcing<2>(state, 0), NumericalError);
}

micro::Observation<2> observation() {
  micro::Observation<2> result;
  result.shear_rate = 50;
  result.hematocrit = 0.42;
  result.shear_stress = {0.2, 0.004, 0.1, 60};
  result.first_normal_difference = {-0.01, 0.003, 0.2, 40};
  result.averaging_time = 2;
  result.termination = micro::Termination::precision_reached;
  return result;
}

TEST(ToRheology, viscosity_is_stress_over_rate_and_so_is_its_error) {
  const RheologySample sample = to_rheology<2>(observation(), 0.4);
  EXPECT_DOUBLE_EQ(sample.viscosity, 0.2 / 50);
  EXPECT_DOUBLE_EQ(sample.viscosity_error, 0.004 / 50);
  EXPECT_EQ(sample.shear_rate, 50);
  EXPECT_EQ(sample.hematocrit, 0.4);
  EXPECT_EQ(sample.shear_stress, 0.2);
  EXPECT_EQ(sample.first_normal_difference, -0.01);
  EXPECT_EQ(sample.first_normal_error, 0.003);
  EXPECT_EQ(sample.effective_samples, 60);
  EXPECT_EQ(sample.averaging_time, 2);
  EXPECT_TRUE(sample.precision_reached);
  EXPECT_EQ(sample.dimension, 2);
}

TEST(ToRheology, says_when_the_allowance_was_spent_and_which_dimension) {
  micro::Observation<3> in_space;
  in_space.shear_rate = 1;
  in_space.shear_stress = {1, 0.5, 1, 3};
  const RheologySample sample = to_rheology<3>(in_space, 0.4);
  EXPECT_FALSE(sample.precision_reached);
  EXPECT_EQ(sample.dimension, 3);
}

TEST(ToRheology, what_is_no_viscosity_is_refused) {
  const auto broken = [](auto change) {
    micro::Observation<2> result = observation();
    change(result);
    return result;
  };
  const double nan = std::nan("");
  EXPECT_THROW(to_rheology<2>(broken([](auto& o) { o.shear_rate = 0; }), 0.4), NumericalError);
  EXPECT_THROW(to_rheology<2>(broken([](auto& o) { o.shear_stress.mean = -0.2; }), 0.4),
               NumericalError);
  EXPECT_THROW(to_rheology<2>(broken([&](auto& o) { o.shear_stress.mean = nan; }), 0.4),
               NumericalError);
  EXPECT_THROW(to_rheology<2>(broken([](auto& o) { o.shear_stress.standard_error = -1; }), 0.4),
               NumericalError);
  EXPECT_THROW(to_rheology<2>(broken([&](auto& o) { o.first_normal_difference.mean = nan; }), 0.4),
               NumericalError);
}

}  // namespace
}  // namespace hemoscale::coupling
