#include <gtest/gtest.h>

#include <limits>

#include "micro/ensemble/observables/cell_shape.hpp"
#include "micro/ensemble/observables/orientation.hpp"
#include "micro/error.hpp"
#include "tests/support/micro/ensemble_observables.hpp"

namespace hemoscale::micro {
namespace {

using test::Ellipse;
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(CellShape, of_a_turned_ellipse_is_exact_for_its_polygon) {
  const Ellipse ellipse{{5e-4, 3e-5}, 4e-6, 1e-6, 0.4};
  const CellShape shape = measure_cell(test::ellipses({ellipse}, 40), 0);
  EXPECT_NEAR(shape.area / test::polygon_area(ellipse, 40), 1, 1e-12);
  EXPECT_NEAR(shape.centre.x(), 5e-4, 1e-17);
  EXPECT_NEAR(shape.centre.y(), 3e-5, 1e-18);
  EXPECT_NEAR(shape.inclination, 0.4, 1e-10);
  EXPECT_NEAR(shape.deformation, (4.0 - 1) / (4 + 1), 1e-10);
}

TEST(CellShape, of_a_rectangle) {
  const CellShape shape = measure_cell(test::rectangles({{1, 2}}, 6, 2), 0);
  EXPECT_DOUBLE_EQ(shape.area, 12);
  EXPECT_DOUBLE_EQ(shape.perimeter, 16);
  EXPECT_DOUBLE_EQ(shape.gyration(0, 0), 36.0 / 12);
  EXPECT_DOUBLE_EQ(shape.gyration(1, 1), 4.0 / 12);
  EXPECT_NEAR(shape.gyration(0, 1), 0, 1e-14);
  EXPECT_NEAR(shape.deformation, 0.5, 1e-14);
}

// Nodes crowded on one side: their mean is not the centroid of the area.
TEST(CellShape, tells_the_centroid_from_the_mean_of_the_nodes) {
  EnsembleState state;
  state.cells = 1;
  state.nodes = 5;
  state.x = {0, 4, 4, 2, 0};
  state.y = {0, 0, 2, 2, 2};
  const CellShape shape = measure_cell(state, 0);
  EXPECT_DOUBLE_EQ(shape.centre.y(), 1);
  EXPECT_DOUBLE_EQ(shape.node_mean.y(), 1.2);
  EXPECT_NEAR(shape.gyration(0, 0), 16.0 / 12, 1e-14);
  EXPECT_NEAR(shape.gyration(1, 1), 4.0 / 12, 1e-14);
}

TEST(CellShape, of_a_ring_turned_inside_out_is_refused) {
  EnsembleState state = test::rectangles({{0, 0}}, 1, 1);
  std::swap(state.x[1], state.x[3]);
  std::swap(state.y[1], state.y[3]);
  EXPECT_THROW(measure_cell(state, 0), NumericalError);
}

TEST(Orientation, of_equal_cells_is_their_inclination) {
  const auto shapes = measure_cells(
      test::ellipses({{{0, 1}, 2, 1, 0.3}, {{9, 4}, 3, 1, 0.3}, {{2, 7}, 2, 1.5, 0.3}}, 24));
  const Orientation found = orientation(shapes, infinity);
  EXPECT_NEAR(found.order, 1, 1e-12);
  EXPECT_NEAR(found.angle, 0.3, 1e-10);
  EXPECT_NEAR(found.along_flow, std::cos(0.6), 1e-10);
}

TEST(Orientation, of_crossed_cells_has_no_order) {
  const double right_angle = 0.5 * std::numbers::pi;
  const auto shapes =
      measure_cells(test::ellipses({{{0, 1}, 2, 1, 0.2}, {{9, 4}, 3, 1, 0.2 + right_angle}}, 24));
  EXPECT_NEAR(orientation(shapes, infinity).order, 0, 1e-10);
}

// Cells lean with the shear on both sides of the axis.
TEST(Orientation, mirrors_the_upper_half_of_a_channel) {
  const auto shapes =
      measure_cells(test::ellipses({{{0, 2}, 2, 1, 0.3}, {{9, 8}, 2, 1, -0.3}}, 24));
  EXPECT_NEAR(orientation(shapes, 5).order, 1, 1e-10);
  EXPECT_NEAR(orientation(shapes, 5).angle, 0.3, 1e-10);
  EXPECT_NEAR(orientation(shapes, infinity).order, std::cos(0.6), 1e-10);
}

}  // namespace
}  // namespace hemoscale::micro
