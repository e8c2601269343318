#include "micro/cells/ring_strain.hpp"

#include <gtest/gtest.h>

#include "micro/error.hpp"
#include "tests/support/micro/outlines.hpp"

namespace hemoscale::micro {
namespace {

TEST(RingStrain, is_zero_at_rest) {
  const test::Nodes nodes = test::nodes_on({.a = 3e-6, .b = 1e-6}, 30);
  const RingStrain strain = measure_strain(nodes, make_ring_mesh(nodes, NaturalShape::flat));
  EXPECT_NEAR(strain.length_error, 0, 1e-14);
  EXPECT_NEAR(strain.perimeter_error, 0, 1e-14);
  EXPECT_NEAR(strain.area_error, 0, 1e-14);
}

TEST(RingStrain, of_a_rectangle_pulled_along_one_side) {
  const test::Nodes rest = {{0, 0}, {2, 0}, {2, 1}, {0, 1}};
  const test::Nodes pulled = {{5, 5}, {8, 5}, {8, 5.9}, {5, 5.9}};
  const RingStrain strain = measure_strain(pulled, make_ring_mesh(rest, NaturalShape::flat));
  EXPECT_NEAR(strain.largest_stretch, 1.5, 1e-14);
  EXPECT_NEAR(strain.smallest_stretch, 0.9, 1e-14);
  EXPECT_NEAR(strain.mean_stretch, 7.8 / 6, 1e-14);
  EXPECT_NEAR(strain.length_error, 0.5, 1e-14);
  EXPECT_NEAR(strain.perimeter_error, 1.8 / 6, 1e-14);
  EXPECT_NEAR(strain.area_error, 0.35, 1e-14);
}

TEST(RingStrain, refuses_another_number_of_nodes) {
  const test::Nodes nodes = test::nodes_on({}, 12);
  const RingMesh mesh = make_ring_mesh(nodes, NaturalShape::flat);
  EXPECT_THROW(measure_strain(std::span(nodes).first(11), mesh), ParameterError);
}

}  // namespace
}  // namespace hemoscale::micro
