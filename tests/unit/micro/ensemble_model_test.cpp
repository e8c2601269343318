#include "micro/ensemble/ensemble_model.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "micro/error.hpp"
#include "tests/support/micro/ensembles.hpp"

namespace hemoscale::micro {
namespace {

using test::shear;
using test::small_ensemble;
using testing::HasSubstr;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr Run run{.warm_up_strain = 0.1,
                  .minimum_strain = 0.2,
                  .maximum_strain = 0.4,
                  .relative_standard_error = 0.02};

std::string fault_of(const EnsembleParameters& p) {
  try {
    EnsembleModel model(p, 1);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "";
}

TEST(EnsembleModel, box_has_the_area_that_hematocrit_and_aspect_ratio_ask_for) {
  EnsembleParameters p = small_ensemble();
  p.domain = ShearBox{.aspect_ratio = 1.5};
  const EnsembleModel model(p, 1);
  const EnsembleFrame frame = model.frame();
  EXPECT_NEAR(6 * model.cell_area() / (frame.length * frame.height), 0.3, 1e-12);
  EXPECT_NEAR(frame.length / frame.height, 1.5, 1e-12);
  EXPECT_EQ(frame.positions.size(), 2U * 6 * 24);
  EXPECT_EQ(frame.cell_ids[24], 1);
  EXPECT_FALSE(frame.walls);
}

TEST(EnsembleModel, channel_has_its_height_and_the_length_that_hematocrit_asks_for) {
  EnsembleParameters p = small_ensemble();
  p.domain = PlaneChannel{.height = 15e-6};
  const EnsembleModel model(p, 1);
  const EnsembleFrame frame = model.frame();
  EXPECT_DOUBLE_EQ(frame.height, 15e-6);
  EXPECT_NEAR(6 * model.cell_area() / (frame.length * frame.height), 0.3, 1e-12);
  EXPECT_TRUE(frame.walls);
}

TEST(EnsembleModel, names_every_fault_at_once) {
  EnsembleParameters p;
  p.cells = 0;
  p.nodes = 7;
  p.hematocrit = 0.76;
  p.membrane.stretch_modulus = nan;
  p.contact.cutoff = p.contact.rest_distance;
  const std::string fault = fault_of(p);
  EXPECT_THAT(fault, HasSubstr("0 cells"));
  EXPECT_THAT(fault, HasSubstr("7 nodes"));
  EXPECT_THAT(fault, HasSubstr("0.76"));
  EXPECT_THAT(fault, HasSubstr("stretch modulus is nan"));
  EXPECT_THAT(fault, HasSubstr("cutoff"));
}

TEST(EnsembleModel, refuses_every_parameter_out_of_range) {
  const auto refuses = [](auto&& change) {
    EnsembleParameters p = small_ensemble();
    change(p);
    EXPECT_NE(fault_of(p), "");
  };
  refuses([](auto& p) { p.hematocrit = 0; });
  refuses([](auto& p) { p.plasma_viscosity = 0; });
  refuses([](auto& p) { p.membrane.bending_modulus = -1e-19; });
  refuses([](auto& p) { p.membrane.area_modulus = -1; });
  refuses([](auto& p) { p.drag.coefficient = 0; });
  refuses([](auto& p) { p.contact.stiffness = -1; });
  refuses([](auto& p) { p.contact.rest_distance = 0; });
  refuses([](auto& p) { p.contact.attraction = 11; });
  refuses([](auto& p) { p.contact.attraction = nan; });
  refuses([](auto& p) { p.wall.range = 0; });
  refuses([](auto& p) { p.wall.stiffness = nan; });
  refuses([](auto& p) { p.outline.length = -1; });
  refuses([](auto& p) { p.time_step = -1e-6; });
  refuses([](auto& p) { p.sampling_strain = 0; });
  refuses([](auto& p) { p.segment_strain_limit = 0; });
  refuses([](auto& p) { p.threads = 0; });
  refuses([](auto& p) { p.domain = ShearBox{.aspect_ratio = 0}; });
  refuses([](auto& p) { p.domain = PlaneChannel{.height = nan}; });
}

TEST(EnsembleModel, refuses_boxes_in_which_cells_meet_themselves) {
  EnsembleParameters p = small_ensemble();
  p.cells = 1;
  EXPECT_THAT(fault_of(p), HasSubstr("more cells"));
  p = small_ensemble();
  p.domain = ShearBox{.aspect_ratio = 8};
  EXPECT_THAT(fault_of(p), HasSubstr("aspect ratio"));
}

TEST(EnsembleModel, advance_refuses_what_is_no_simple_shear) {
  EnsembleModel model(small_ensemble(), 1);
  EXPECT_THROW(model.advance(shear(0, 0.3), run), ParameterError);
  EXPECT_THROW(model.advance(shear(nan, 0.3), run), ParameterError);
  EXPECT_THROW(model.advance(shear(100, 0.4), run), ParameterError);
  Forcing<2> extension = shear(100, 0.3);
  extension.velocity_gradient(0, 0) = 1;
  EXPECT_THROW(model.advance(extension, run), ParameterError);
  EXPECT_THROW(model.advance(shear(100, 0.3), {}), ParameterError);
  EXPECT_NO_THROW(model.advance(shear(100, 0.3), run));
}

TEST(EnsembleModel, advance_by_refuses_wrong_durations_and_profiles) {
  EnsembleModel model(small_ensemble(), 1);
  EXPECT_THROW(model.advance_by(shear(100, 0.3), 0), ParameterError);
  EXPECT_THROW(model.advance_by(shear(100, 0.3), nan), ParameterError);
  EnsembleParameters p = small_ensemble();
  p.domain = PlaneChannel{.height = 15e-6};
  EnsembleModel channel(p, 1);
  EXPECT_THROW(channel.advance(shear(100, 0.3), run), ParameterError);
  EXPECT_THROW(channel.advance_by(shear(100, 0.3), 1e-4), ParameterError);
  Forcing<2> forcing = shear(0, 0.3);
  forcing.profile = VelocityProfile{.height = 14e-6, .velocities = {0, 1e-3, 1e-3, 0}};
  EXPECT_THROW(channel.advance_by(forcing, 1e-4), ParameterError);
  forcing.profile->height = 15e-6;
  EXPECT_NO_THROW(channel.advance_by(forcing, 1e-4));
}

TEST(EnsembleModel, observer_sees_every_interval_once) {
  EnsembleModel model(small_ensemble(), 1);
  std::vector<double> strains;
  model.observe(FrameClock::strain, 0.1,
                [&](const EnsembleFrame& f) { strains.push_back(f.strain); });
  model.advance_by(shear(100, 0.3), 0.00555);
  model.advance_by(shear(100, 0.3), 0.005);
  ASSERT_EQ(strains.size(), 10U);
  for (std::size_t i = 0; i < strains.size(); ++i) {
    EXPECT_NEAR(strains[i], 0.1 * static_cast<double>(i + 1), 2 * 100 * model.time_step());
  }
  model.observe(FrameClock::time, 0.001,
                [&](const EnsembleFrame& f) { strains.push_back(f.time); });
  model.advance_by(shear(100, 0.3), 0.0021);
  EXPECT_EQ(strains.size(), 12U);
  EXPECT_THROW(model.observe(FrameClock::time, 0, nullptr), ParameterError);
}

TEST(EnsembleModel, frame_holds_whole_cells_with_their_centres_in_the_box) {
  EnsembleModel model(small_ensemble(), 1);
  model.advance_by(shear(300, 0.3), 0.02);
  const EnsembleFrame f = model.frame();
  EXPECT_GE(f.image_offset, 0);
  EXPECT_LT(f.image_offset, f.length);
  for (std::size_t cell = 0; cell < 6; ++cell) {
    Vector<2> centre = Vector<2>::Zero();
    for (std::size_t k = 0; k < 24; ++k) {
      const std::size_t i = cell * 24 + k;
      const std::size_t j = cell * 24 + (k + 1) % 24;
      centre += Vector<2>(f.positions[2 * i], f.positions[2 * i + 1]) / 24;
      EXPECT_LT(std::hypot(f.positions[2 * j] - f.positions[2 * i],
                           f.positions[2 * j + 1] - f.positions[2 * i + 1]),
                2e-6);
    }
    EXPECT_GE(centre.y(), 0);
    EXPECT_LT(centre.y(), f.height);
  }
}

TEST(EnsembleModel, channel_reports_profiles_and_shear_box_does_not) {
  EnsembleParameters p = small_ensemble();
  p.domain = PlaneChannel{.height = 15e-6};
  EnsembleModel channel(p, 1);
  const SceneObservation o = channel.advance_by(test::poiseuille(15e-6, 4e-3, 0.3), 1e-3);
  ASSERT_TRUE(o.profile.has_value());
  double mean = 0;
  for (const double fraction : o.profile->area_fraction) {
    mean += fraction / static_cast<double>(o.profile->area_fraction.size());
  }
  EXPECT_NEAR(mean, 0.3, 0.01);
  EXPECT_GT(o.profile->cell_free_layer, 0);
  EXPECT_NEAR(o.time, 1e-3, channel.time_step());
  EnsembleModel box(small_ensemble(), 1);
  EXPECT_FALSE(box.advance_by(shear(100, 0.3), 1e-4).profile.has_value());
}

}  // namespace
}  // namespace hemoscale::micro
