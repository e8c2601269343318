#include "micro/cells/ring_shape.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "micro/cells/curve_distance.hpp"
#include "micro/cells/ring_concavity.hpp"
#include "micro/cells/ring_mesh.hpp"
#include "micro/cells/ring_motion.hpp"
#include "micro/cells/ring_strain.hpp"
#include "tests/support/micro/outlines.hpp"

// The figures of the reference tables come out of the reference coordinates: both mean the same.
namespace hemoscale::micro {
namespace {

const std::string cases = std::string(HEMOSCALE_SOURCE_DIR) + "/cases/";

struct Parachute {
  std::size_t row;
  std::string shape;
  double dimple;  // [um] of the curve; see README.md of the reference
};

class ReferenceParachute : public testing::TestWithParam<Parachute> {};

TEST_P(ReferenceParachute, has_the_figures_of_the_table) {
  const std::string folder = cases + "capillary-red-cell/reference/";
  auto table = test::read_columns(folder + "parachute.csv");
  auto columns = test::read_columns(folder + "shapes/" + GetParam().shape + ".csv");
  const auto expected = [&](const char* name) { return table.at(name).at(GetParam().row); };
  const test::Nodes nodes =
      test::nodes_of(columns.at("x_minus_xc_um"), columns.at("y_minus_axis_um"), 1);
  const RingCurve curve(nodes);
  const RingShape shape = measure_shape(curve);
  EXPECT_NEAR(shape.length, expected("length_um"), 2e-4);
  EXPECT_NEAR(shape.width, expected("width_um"), 2e-4);
  EXPECT_LT(shape.centroid.norm(), 1e-4);
  const double rest_perimeter = 2 * std::numbers::pi * 2.95;
  EXPECT_NEAR(4 * std::numbers::pi * shape.area / std::pow(rest_perimeter, 2), expected("alpha"),
              1e-5);
  const test::Nodes lower = {{-20, -5}, {20, -5}};
  EXPECT_NEAR(gap(curve, lower), expected("min_gap_um"), 2e-4);
  EXPECT_LT(asymmetry(curve), 1e-4);

  const std::vector<Concavity> dents = concavities(curve);
  EXPECT_NEAR(dimple_depth(dents, {-1, 0}), GetParam().dimple, 5e-4);
  EXPECT_NEAR(dimple_depth(dents, {-1, 0}), expected("rear_dimple_depth_um"), 3.5e-3);
  EXPECT_EQ(dimple_depth(dents, {1, 0}), 0);

  // The nodes are spaced unevenly, s0 apart; the table has the stretch at points, the segments its
  // means.
  RingMesh mesh = make_ring_mesh(nodes, NaturalShape::flat);
  const std::vector<double>& s0 = columns.at("s0_um");
  for (std::size_t i = 0; i < s0.size(); ++i) {
    mesh.rest_length[i] = (i + 1 < s0.size() ? s0[i + 1] : rest_perimeter) - s0[i];
  }
  const RingStrain strain = measure_strain(nodes, mesh);
  EXPECT_NEAR(strain.largest_stretch, expected("lam_max"), 5e-4);
  EXPECT_NEAR(strain.smallest_stretch, expected("lam_min"), 7e-3);
}

INSTANTIATE_TEST_SUITE_P(All, ReferenceParachute,
                         testing::Values(Parachute{0, "para_a0.7_U1_Es10_Eb0.2_p2_N129", 1.6971},
                                         Parachute{1, "para_a0.7_U1_Es50_Eb2_p2_N129", 1.0474},
                                         Parachute{2, "para_a0.7_U10_Es50_Eb0.2_p2_N193", 2.1913},
                                         Parachute{3, "para_a0.65_U1_Es10_Eb2_p2_N129", 1.2948},
                                         Parachute{4, "para_a0.481_U1_Es50_Eb0.2_p2_N129", 2.0764}),
                         [](const auto& tested) {
                           return "row_" + std::to_string(tested.param.row);
                         });

struct Sheared {
  std::size_t row;
  std::string shape;
};

class ReferenceShear : public testing::TestWithParam<Sheared> {};

TEST_P(ReferenceShear, has_the_figures_of_the_table) {
  const std::string folder = cases + "shear-red-cell/reference/";
  auto table = test::read_columns(folder + "shear.csv");
  auto columns = test::read_columns(folder + "shapes/" + GetParam().shape + ".csv");
  const auto expected = [&](const char* name) { return table.at(name).at(GetParam().row); };
  const RingCurve curve(test::nodes_of(columns.at("x_over_RA"), columns.at("y_over_RA"), 1));
  const RingCurve velocities(
      test::nodes_of(columns.at("u_over_G_RA"), columns.at("v_over_G_RA"), 1));
  const RingShape shape = measure_shape(curve);
  EXPECT_NEAR(shape.reduced_area, expected("alpha"), 1e-4);
  EXPECT_NEAR(shape.area, std::numbers::pi, 1e-4);
  EXPECT_NEAR(shape.inclination * 180 / std::numbers::pi, expected("theta_deg"), 0.005);
  EXPECT_NEAR(shape.deformation, expected("D_inertia"), 2e-4);
  EXPECT_NEAR(shape.axial_length, expected("length_over_RA"), 5e-4);
  EXPECT_NEAR(shape.axial_width, expected("width_over_RA"), 5e-4);
  const RingMotion motion = measure_motion(curve, velocities);
  EXPECT_NEAR(-motion.treading_rate, expected("omega_TT_over_G"), 1e-4);
  EXPECT_NEAR(motion.inclination_rate, 0, 1e-4);
  EXPECT_LT(motion.velocity.norm(), 1e-6);
}

INSTANTIATE_TEST_SUITE_P(All, ReferenceShear,
                         testing::Values(Sheared{0, "shear_a0.65_Ca10_N48"},
                                         Sheared{1, "shear_a0.7_Ca1_N48"}),
                         [](const auto& tested) {
                           return "row_" + std::to_string(tested.param.row);
                         });

// Every third node of the finest reference is a ring of 64 or so, like those of simulations: what
// is seen of it is the same to 0.05 um, and far closer.
TEST(ReferenceParachuteThinned, is_the_same_shape) {
  auto columns = test::read_columns(
      cases + "capillary-red-cell/reference/shapes/para_a0.7_U10_Es50_Eb0.2_p2_N193.csv");
  const test::Nodes all =
      test::nodes_of(columns.at("x_minus_xc_um"), columns.at("y_minus_axis_um"), 1);
  test::Nodes thinned;
  for (std::size_t i = 0; i < 192; i += 3) thinned.push_back(all[i]);
  EXPECT_LT(largest_distance(RingCurve(all), RingCurve(thinned), Alignment::none), 0.01);
}

TEST(RingShapeOrder, is_four_in_the_spacing_of_the_nodes) {
  const auto at = [](int n) {
    test::Nodes nodes = test::crescent(0.5, -0.6, n);
    for (Vector<2>& node : nodes) node = test::turned(node, -0.5);
    return measure_shape(RingCurve(nodes));
  };
  const RingShape exact = at(2000);
  const RingShape coarse = at(40);
  const RingShape fine = at(160);
  const auto order = [&](auto figure) {
    return test::observed_order(figure(coarse) - figure(exact), figure(fine) - figure(exact), 4);
  };
  EXPECT_GT(order([](const RingShape& s) { return s.area; }), 3.8);
  EXPECT_GT(order([](const RingShape& s) { return s.perimeter; }), 3.8);
  EXPECT_GT(order([](const RingShape& s) { return s.length; }), 3.6);
  EXPECT_GT(order([](const RingShape& s) { return s.deformation; }), 3.8);
}

TEST(DimpleOrder, is_four_in_the_spacing_of_the_nodes) {
  const double exact = 0.8 + 0.25 / 3.2 - 0.5;  // see ring_concavity_test.cpp
  // The error of one ring depends on where its nodes lie: the largest of several.
  const auto error = [&](int n) {
    double largest = 0;
    for (int k = 0; k < 20; ++k) {
      const double start = 2 * std::numbers::pi * k / (20 * n);
      const RingCurve curve(test::crescent(0.5, -0.8, n, start));
      largest = std::max(largest, std::abs(dimple_depth(concavities(curve), {-1, 0}) - exact));
    }
    return largest;
  };
  EXPECT_GT(test::observed_order(error(40), error(160), 4), 3.7);
}

}  // namespace
}  // namespace hemoscale::micro
