// From the keys micro.shape to the outline of the cells.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "coupling/scene/build_micro.hpp"

#include "tests/unit/config/case_text.hpp"

namespace hemoscale::coupling {
namespace {

micro::OutlineParameters outline_of(const std::string& shape) {
  const std::string text =
      "case.name = \"a\"\nscene.kind = \"micro\"\nfluid.hematocrit = 0.4\n[micro]\n"
      "shear_rate = \"10 1/s\"\nduration = \"1 s\"\noutput_interval = \"1 s\"\n" +
      shape;
  return build_ensemble_parameters(settings_of(text), 1, false).outline;
}

TEST(ShapeKeys, choose_the_outline) {
  EXPECT_EQ(outline_of("").outline, micro::Outline::evans_fung);
  EXPECT_EQ(outline_of("shape.outline = \"ellipse\"").outline, micro::Outline::ellipse);
  const auto thin = outline_of("shape.outline = \"deflated\"\nshape.length = \"7 um\"");
  EXPECT_EQ(thin.outline, micro::Outline::deflated);
  EXPECT_DOUBLE_EQ(thin.reduced_area, 0.3);
  EXPECT_DOUBLE_EQ(thin.length, 7e-6);
  EXPECT_DOUBLE_EQ(
      outline_of("shape.outline = \"deflated\"\nshape.reduced_area = 0.46").reduced_area, 0.46);
}

TEST(ShapeKeys, refuse_a_reduced_area_at_which_sides_touch) {
  EXPECT_THROW(outline_of("shape.outline = \"deflated\"\nshape.reduced_area = 0.27"), CaseError);
  EXPECT_THROW(outline_of("shape.outline = \"deflated\"\nshape.reduced_area = 1.1"), CaseError);
}

}  // namespace
}  // namespace hemoscale::coupling
