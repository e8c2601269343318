#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "micro/ensemble/ensemble_model.hpp"
#include "micro/error.hpp"
#include "micro/random/philox.hpp"
#include "tests/support/micro/ensembles.hpp"

namespace hemoscale::micro {
namespace {

using testing::HasSubstr;

struct RingCase {
  const char* name;
  int nodes;
  MembraneParameters membrane;
};

void PrintTo(const RingCase& c, std::ostream* out) {
  *out << c.name;
}

class RingLimit : public testing::TestWithParam<RingCase> {
 protected:
  /// A lonely cell at rest whose nodes are displaced at random by a thousandth of a segment.
  EnsembleModel disturbed(double share) const {
    EnsembleParameters p = test::lonely_cell();
    p.nodes = GetParam().nodes;
    p.membrane = GetParam().membrane;
    p.time_step = share * step_limit(p).time_step;
    p.force = share > 1;
    EnsembleModel model(p, 1);
    test::move_nodes(model, [](std::size_t i, double x, double y) {
      return std::pair(x + 1e-10 * normal({3, 0, i}), y + 1e-10 * normal({3, 1, i}));
    });
    return model;
  }
};

/// Root mean square of the velocities over some steps, from the positions.
double motion(EnsembleModel& model, int steps) {
  const auto before = model.frame().positions;
  model.advance_by(test::shear(0, 0.01), steps * model.time_step());
  const auto after = model.frame().positions;
  double sum = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    sum += std::pow(after[i] - before[i], 2);
  }
  return std::sqrt(sum);
}

TEST_P(RingLimit, below_it_a_disturbance_dies_out) {
  EnsembleModel model = disturbed(0.9);
  const double first = motion(model, 1);
  model.advance_by(test::shear(0, 0.01), 2000 * model.time_step());
  EXPECT_LT(motion(model, 1), 0.01 * first);
}

TEST_P(RingLimit, above_it_the_run_is_refused) {
  EnsembleParameters p = test::lonely_cell();
  p.nodes = GetParam().nodes;
  p.membrane = GetParam().membrane;
  p.time_step = 1.01 * step_limit(p).time_step;
  try {
    EnsembleModel model(p, 1);
    FAIL();
  } catch (const ParameterError& error) {
    EXPECT_THAT(error.what(), HasSubstr("exceeds the explicit limit"));
    EXPECT_THAT(error.what(), HasSubstr("reduce the time step"));
  }
}

TEST_P(RingLimit, above_it_a_forced_run_ends_with_the_diagnosis) {
  EnsembleModel model = disturbed(1.1);
  try {
    model.advance_by(test::shear(0, 0.01), 4000 * model.time_step());
    FAIL() << "still stable at 1.1 of the limit";
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), HasSubstr("step "));
    EXPECT_THAT(error.what(), HasSubstr("explicit limit"));
    EXPECT_THAT(error.what(), HasSubstr("reduce the time step"));
  }
}

INSTANTIATE_TEST_SUITE_P(Rings, RingLimit,
                         testing::Values(RingCase{"stretching", 40, {}},
                                         RingCase{"bending", 100, {}},
                                         RingCase{"half_angle_bending",
                                                  100,
                                                  {.bending_law = BendingLaw::half_angle_tangent}},
                                         RingCase{"swelling", 40, {.area_modulus = 500}}),
                         [](const auto& each) { return each.param.name; });

class ContactLimit : public testing::Test {
 protected:
  /// Contacts forty times stiffer than membranes: they alone set the step.
  static EnsembleModel crowd(double share) {
    EnsembleParameters p = test::small_ensemble();
    p.hematocrit = 0.45;
    p.contact.stiffness = 400;
    p.time_step = share * step_limit(p).time_step;
    p.force = share > 1;
    return EnsembleModel(p, 1);
  }
};

TEST_F(ContactLimit, below_it_a_crowd_runs) {
  EnsembleModel model = crowd(0.9);
  EXPECT_NO_THROW(model.advance_by(test::shear(50, 0.45), 0.02));
}

TEST_F(ContactLimit, far_above_it_a_forced_crowd_does_not_run_soundly) {
  EnsembleModel model = crowd(4);
  EXPECT_THROW(model.advance_by(test::shear(50, 0.45), 0.02), NumericalError);
}

TEST(WallLimit, is_part_of_the_limit_of_a_channel_alone) {
  EnsembleParameters p = test::small_ensemble();
  const double box = step_limit(p).time_step;
  p.domain = PlaneChannel{.height = 20e-6};
  p.wall.stiffness = 100;
  const StepLimit limit = step_limit(p);
  EXPECT_LT(limit.time_step, box);
  EXPECT_DOUBLE_EQ(limit.time_step, 2 * limit.drag / (limit.ring + limit.contact + limit.wall));
  EXPECT_EQ(limit.wall, 100);
}

TEST(ShearRateLimit, a_membrane_that_is_too_soft_is_named) {
  EnsembleParameters p = test::lonely_cell();
  p.membrane.stretch_modulus = 1e-7;
  EnsembleModel model(p, 1);
  try {
    model.advance_by(test::shear(300, 0.01), 0.05);
    FAIL();
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), HasSubstr("raise the stretch modulus"));
  }
}

}  // namespace
}  // namespace hemoscale::micro
