#include "coupling/transfer/shear_frame.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

#include "coupling/transfer/to_forcing.hpp"
#include "macro/kinematics.hpp"

namespace hemoscale::coupling {
namespace {

class RandomGradients {
 public:
  macro::Tensor<2> next() {
    macro::Tensor<2> L;
    for (int i = 0; i < 4; ++i)
      L(i % 2, i / 2) = static_cast<double>(engine_() >> 11) * 0x1p-52 - 1;
    return 100 * L;
  }

 private:
  std::mt19937_64 engine_{21};
};

TEST(ShearFrameProperty, any_gradient_becomes_shear_plus_rotation_plus_divergence) {
  RandomGradients gradients;
  for (int repeat = 0; repeat < 1000; ++repeat) {
    const macro::Tensor<2> L = gradients.next();
    const macro::Tensor<2> Q = shear_frame(L);
    const macro::Tensor<2> A = in_frame(Q, L);
    const macro::Tensor<2> one = Q * Q.transpose();
    ASSERT_LE((one - macro::Tensor<2>::Identity()).norm(), 1e-14);
    ASSERT_NEAR(A(0, 0), A(1, 1), 1e-11);
    ASSERT_NEAR(A.trace(), L.trace(), 1e-11);
    ASSERT_GE(A(0, 1), std::abs(A(1, 0)) - 1e-11);
    ASSERT_NEAR(A(0, 1) - A(1, 0), std::abs(macro::vorticity(L)), 1e-11);
    ASSERT_NEAR(macro::shear_rate<2>(A), macro::shear_rate<2>(L), 1e-11);
  }
}

// Turning the observer changes neither what the micro model is given nor the gradient in its frame.
TEST(ShearFrameProperty, nothing_depends_on_the_frame_of_the_macro_flow) {
  RandomGradients gradients;
  for (int repeat = 0; repeat < 1000; ++repeat) {
    macro::FlowState<2> state;
    state.velocity_gradient = gradients.next();
    const double angle = 0.01 * repeat;
    macro::Tensor<2> R;
    R << std::cos(angle), -std::sin(angle), std::sin(angle), std::cos(angle);
    macro::FlowState<2> turned;
    turned.velocity_gradient = R * state.velocity_gradient * R.transpose();
    const ShearForcing a = to_forcing<2>(state, 0.4);
    const ShearForcing b = to_forcing<2>(turned, 0.4);
    ASSERT_NEAR(a.shear_rate, b.shear_rate, 1e-11);
    ASSERT_NEAR(a.flow_type, b.flow_type, 1e-13);
    const macro::Tensor<2> A =
        in_frame(shear_frame(state.velocity_gradient), state.velocity_gradient);
    const macro::Tensor<2> B =
        in_frame(shear_frame(turned.velocity_gradient), turned.velocity_gradient);
    ASSERT_LE((A - B).norm(), 1e-10);
  }
}

}  // namespace
}  // namespace hemoscale::coupling
