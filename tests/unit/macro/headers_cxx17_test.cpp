// Every header of the macro scale, compiled as the OpenFOAM library compiles them.
#include <gtest/gtest.h>

#include "macro/analytic/bessel.hpp"
#include "macro/analytic/bracketed_root.hpp"
#include "macro/analytic/channel_model.hpp"
#include "macro/analytic/channel_profile.hpp"
#include "macro/analytic/couette.hpp"
#include "macro/analytic/flow_curve.hpp"
#include "macro/analytic/gauss_legendre.hpp"
#include "macro/analytic/pipe_flow.hpp"
#include "macro/analytic/plane_flow.hpp"
#include "macro/analytic/poiseuille.hpp"
#include "macro/analytic/start_up.hpp"
#include "macro/analytic/womersley.hpp"
#include "macro/error.hpp"
#include "macro/flow_field.hpp"
#include "macro/flow_state.hpp"
#include "macro/kinematics.hpp"
#include "macro/macro_model.hpp"
#include "macro/parameter_check.hpp"
#include "macro/vector.hpp"
#include "macro/viscosity/kinks.hpp"
#include "macro/viscosity/monotone_slopes.hpp"
#include "macro/viscosity/viscosity_law.hpp"

static_assert(__cplusplus < 202002L, "this file must be compiled as C++17");

namespace hemoscale::macro {
namespace {

TEST(HeadersInCxx17, see_the_same_types_as_the_library) {
  const ViscosityLaw law = cho_kensey_1991();
  ChannelModel<3> model(Channel{75e-6, 0.45, MeanVelocity{2e-3}});
  const auto flow = model.advance(law, Window{0, 1});
  const auto state = flow->at(Vector<3>(0, 10e-6, 0), 0);
  ASSERT_TRUE(state.has_value());
  const double rate = shear_rate<3>(state->velocity_gradient);
  EXPECT_NEAR(law.viscosity(rate, 0.45) * rate,
              model.solve(law)->pressure_gradient() * (37.5e-6 - 10e-6), 1e-10);
}

}  // namespace
}  // namespace hemoscale::macro
