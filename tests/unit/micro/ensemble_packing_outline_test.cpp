#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "micro/cells/outline.hpp"
#include "micro/cells/outline_checks.hpp"
#include "micro/cells/ring_mesh.hpp"
#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

constexpr OutlineParameters literal{
    .outline = Outline::deflated, .length = 7e-6, .reduced_area = 0.3};

// At a reduced area of 0.30 and 7 um a cell has 6.1 um^2 and is 1.49 um thick: 1200 of them fill 49
// % of 200 um by 75 um.
TEST(DeflatedOutline, fits_the_window_of_the_paper) {
  const auto nodes = outline_nodes(literal, 100);
  const RingMesh mesh = make_ring_mesh(nodes, NaturalShape::outline);
  EXPECT_NEAR(mesh.rest_area, 6.1e-12, 0.05e-12);
  EXPECT_NEAR(1200 * mesh.rest_area / (200e-6 * 75e-6), 0.49, 0.005);
  double thickest = 0;
  for (const auto& node : nodes) thickest = std::max(thickest, 2 * node.y());
  EXPECT_NEAR(thickest, 1.49e-6, 0.02e-6);
}

TEST(DeflatedOutline, has_the_length_and_the_reduced_area_that_were_asked_for) {
  for (const double reduced_area : {0.3, 0.46, 0.7, 1.0}) {
    const auto nodes = outline_nodes(
        {.outline = Outline::deflated, .length = 5e-6, .reduced_area = reduced_area}, 80);
    const RingMesh mesh = make_ring_mesh(nodes, NaturalShape::outline);
    EXPECT_NEAR(4 * std::numbers::pi * mesh.rest_area / std::pow(mesh.rest_perimeter, 2),
                reduced_area, 2e-3);
    double left = 0;
    double right = 0;
    for (const auto& node : nodes) {
      left = std::min(left, node.x());
      right = std::max(right, node.x());
    }
    EXPECT_NEAR(right - left, 5e-6, 1e-15);
    for (const double length : mesh.rest_length) {
      EXPECT_NEAR(length, mesh.rest_perimeter / 80, 1e-9 * mesh.rest_perimeter);
    }
    EXPECT_FALSE(self_crossing(nodes));
  }
}

TEST(DeflatedOutline, refuses_shapes_whose_sides_pass_through_each_other) {
  OutlineParameters p = literal;
  p.reduced_area = 0.2;
  EXPECT_THROW(outline_nodes(p, 100), ParameterError);
  p.reduced_area = 1.1;
  EXPECT_THROW(outline_nodes(p, 100), ParameterError);
  p = literal;
  p.length = -1;
  EXPECT_THROW(outline_nodes(p, 100), ParameterError);
}

}  // namespace
}  // namespace hemoscale::micro
