#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

#include "micro/cells/angle_period.hpp"
#include "micro/immersed/cell_stress.hpp"
#include "tests/support/immersed/parachutes.hpp"

// An inextensible cell in unbounded shear, against converged spectral solutions made for this
// project: cases/shear-red-cell/reference, and further values with viscosity contrast.
namespace hemoscale::micro {
namespace {

using namespace test;
using std::numbers::pi;

constexpr double rate = 100;
constexpr double base_radius = reference_perimeter / (2 * pi);

struct ShearCase {
  double reduced_area = 0.7;
  double capillary = 1;  // mu G R_A^3 / kappa, R_A = sqrt(A / pi)
  double ratio = 1;
  int nodes = 59;
};

ImplicitMembranes sheared(const ShearCase& c) {
  const double radius = base_radius * std::sqrt(c.reduced_area);
  const CellPlan plan{
      .reduced_area = c.reduced_area,
      .nodes = c.nodes,
      .bending_modulus = water.viscosity() * rate * std::pow(radius, 3) / c.capillary,
      .viscosity_ratio = c.ratio,
      .angle = 0.3};
  return {
      shear(rate), {deflated_cell(plan)}, {.longest_step = 0.2 / rate, .step_tolerance = 0.003}};
}

struct Rheology {
  double inclination;  // [deg]
  double treading;     // over the shear rate
  double viscosity, difference;
};

Rheology after(ImplicitMembranes& membranes, double strain) {
  membranes.advance_by(strain / rate);
  const Seen seen = look_at(membranes);
  const Tensor<2> stress = cell_stress(membranes.sources()[0], water.viscosity());
  const double scale = water.viscosity() * rate * seen.shape.area;
  EXPECT_LT(std::abs(seen.strain.area_error), 1e-9);
  EXPECT_LT(seen.strain.length_error, 1e-9);
  return {seen.shape.inclination * 180 / pi, -seen.motion.treading_rate / rate,
          stress(0, 1) / scale, (stress(0, 0) - stress(1, 1)) / scale};
}

TEST(ShearedCell, treads_as_the_references_do) {
  const auto table = read_columns(std::filesystem::path(HEMOSCALE_SOURCE_DIR) / "cases" /
                                  "shear-red-cell" / "reference" / "shear.csv");
  for (std::size_t row = 0; row < table.at("alpha").size(); ++row) {
    ImplicitMembranes membranes =
        sheared({.reduced_area = table.at("alpha")[row], .capillary = table.at("Ca_b")[row]});
    const Rheology r = after(membranes, 60);
    EXPECT_NEAR(r.inclination, table.at("theta_deg")[row], 0.1);
    EXPECT_NEAR(r.treading, table.at("omega_TT_over_G")[row], 0.005 * r.treading);
    EXPECT_NEAR(r.viscosity, table.at("eta_intrinsic")[row], 0.005 * r.viscosity);
    EXPECT_NEAR(r.difference, table.at("N1_over_muG_phi")[row], 0.005 * r.difference);
    EXPECT_NEAR(look_at(membranes).shape.deformation, table.at("D_inertia")[row], 1e-3);
  }
}

TEST(ShearedCell, converges_with_its_nodes) {
  std::vector<Rheology> found;
  for (const int nodes : {24, 48, 96}) {
    ImplicitMembranes membranes = sheared({.nodes = nodes});
    found.push_back(after(membranes, 40));
  }
  EXPECT_NEAR(halving_order(found[0].treading, found[1].treading, found[2].treading), 2, 0.3);
}

TEST(ShearedCell, of_higher_viscosity_lies_flatter_and_thickens_less) {
  struct Known {
    double ratio, inclination, viscosity;
  };
  for (const Known& known : {Known{2, 15.2, 1.308}, Known{3, 8.5, 1.184}}) {
    ImplicitMembranes membranes = sheared({.ratio = known.ratio});
    const Rheology r = after(membranes, 60);
    EXPECT_NEAR(r.inclination, known.inclination, 0.15) << known.ratio;
    EXPECT_NEAR(r.viscosity, known.viscosity, 0.005 * known.viscosity) << known.ratio;
    EXPECT_NEAR(look_at(membranes).motion.inclination_rate, 0, 1e-3 * rate) << known.ratio;
  }
}

/// Strain until the long axis has passed below the flow direction; none within the given strain.
bool tumbles(const ShearCase& c, double strain) {
  ImplicitMembranes membranes = sheared(c);
  for (double done = 0; done < strain; done += 1) {
    membranes.advance_by(1 / rate);
    if (look_at(membranes).shape.inclination < -0.02) return true;
  }
  return false;
}

TEST(ShearedCell, tumbles_beyond_the_known_viscosity_ratio) {
  EXPECT_FALSE(tumbles({.reduced_area = 0.7, .ratio = 3.6, .nodes = 40}, 60));
  EXPECT_TRUE(tumbles({.reduced_area = 0.7, .ratio = 3.8, .nodes = 40}, 60));
  EXPECT_FALSE(tumbles({.reduced_area = 0.8, .ratio = 4.2, .nodes = 40}, 60));
  EXPECT_TRUE(tumbles({.reduced_area = 0.8, .ratio = 4.4, .nodes = 40}, 60));
}

// Period of the ellipse of the same aspect, 2 pi / G (r + 1/r) (Jeffery 1922).
TEST(ShearedCell, of_very_high_viscosity_tumbles_as_a_rigid_body) {
  ImplicitMembranes membranes = sheared({.ratio = 50, .nodes = 40});
  const RingShape rest = look_at(membranes).shape;
  const double aspect = rest.axial_length / rest.axial_width;
  std::vector<double> time, angles;
  for (int k = 0; k < 250; ++k) {
    membranes.advance_by(0.2 / rate);
    time.push_back(membranes.time());
    angles.push_back(look_at(membranes).shape.inclination);
  }
  const auto period = turning_period(time, unwrapped(angles, pi), pi / 2);
  ASSERT_TRUE(period);
  EXPECT_NEAR(period->mean * rate / (2 * pi * (aspect + 1 / aspect)), 1, 0.1);
  EXPECT_LT(look_at(membranes).shape.deformation, 0.55);
}

}  // namespace
}  // namespace hemoscale::micro
