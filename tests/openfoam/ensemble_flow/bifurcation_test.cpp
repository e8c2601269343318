// The bifurcation of cases/vessel-ensemble: walls and openings from the mesh, the flow of
// simpleFoam on a grid.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>

#include "coupling/scene/ensemble_flow.hpp"
#include "macro/error.hpp"
#include "macro/openfoam/loader.hpp"

#include "tests/openfoam/adapter/case_folder.hpp"
#include "tests/unit/config/case_text.hpp"

namespace hemoscale::coupling {
namespace {

using testing::HasSubstr;

const std::filesystem::path bifurcation =
    std::filesystem::path(HEMOSCALE_SOURCE_DIR) / "cases/vessel-ensemble/bifurcation";

std::string case_text(const std::string& more) {
  return "case.name = \"a\"\nscene.kind = \"micro\"\nfluid.hematocrit = 0.4\n[micro]\n"
         "domain = \"geometry\"\nduration = \"1 s\"\noutput_interval = \"1 s\"\n[micro.flow]\n"
         "kind = \"openfoam\"\ncase = \".\"\nlength_unit = \"1 um\"\ntime_unit = \"1 ms\"\n" +
         more;
}

const std::string patches = "inlet = \"inlet\"\noutlets = \"upper, lower\"\n";

double statement(const EnsembleFlow& flow, const std::string& text) {
  for (const auto& [name, value] : flow.statements) {
    if (name.find(text) != std::string::npos) return value;
  }
  ADD_FAILURE() << "no statement about " << text;
  return std::nan("");
}

/// The case, meshed and solved once for each size of cells [um].
const test::CaseFolder& solved(const std::string& size) {
  static std::map<std::string, std::unique_ptr<test::CaseFolder>> folders;
  std::unique_ptr<test::CaseFolder>& folder = folders[size];
  if (!folder) {
    folder = std::make_unique<test::CaseFolder>();
    folder->copy_from(bifurcation);
    const test::Outcome run =
        folder->run("/usr/bin/python3 geometry.py " + size + " && blockMesh && simpleFoam");
    EXPECT_EQ(run.status, 0) << run.output;
    EXPECT_THAT(run.output, HasSubstr("SIMPLE solution converged"));
  }
  return *folder;
}

const std::string coarse_mesh = "2.5";
const std::string mesh_of_the_case = "1.25";

EnsembleFlow built(const std::string& more, const std::string& size = coarse_mesh) {
  const std::filesystem::path folder = solved(size).path();
  return build_ensemble_flow(settings_of(case_text(more)), folder, folder);
}

/// What is kept in the repository is what geometry.py writes.
TEST(Bifurcation, has_the_mesh_that_its_script_writes) {
  HEMOSCALE_NEEDS_OPENFOAM();
  test::CaseFolder folder;
  folder.copy_from(bifurcation);
  const std::string kept = folder.read("system/blockMeshDict");
  folder.write("system/blockMeshDict", "");
  ASSERT_EQ(folder.run("/usr/bin/python3 geometry.py").status, 0);
  EXPECT_EQ(folder.read("system/blockMeshDict"), kept);
}

TEST(Bifurcation, has_walls_and_openings_of_its_mesh) {
  HEMOSCALE_NEEDS_OPENFOAM();
  macro::CaseReading reading;
  reading.units = {1e-6, 1e-3, 1050};
  const macro::MeshOutline outline =
      macro::OpenFoamLibrary().read_outline(solved(coarse_mesh).path(), reading);
  ASSERT_EQ(outline.walls.size(), 3U);  // outer walls and the divider
  ASSERT_EQ(outline.openings.size(), 3U);
  EXPECT_EQ(outline.back, 0);
  EXPECT_DOUBLE_EQ(outline.front, 1e-6);
  for (const auto& opening : outline.openings) {
    ASSERT_EQ(opening.polylines.size(), 1U) << opening.patch;
    ASSERT_EQ(opening.polylines[0].size(), 2U) << opening.patch;
    const double width = (opening.polylines[0][1] - opening.polylines[0][0]).norm();
    const double expected = opening.patch == "inlet"   ? 75e-6
                            : opening.patch == "upper" ? 50e-6
                                                       : 35e-6;
    EXPECT_NEAR(width, expected, 1e-14) << opening.patch;
  }
  // The inlet is travelled downwards: the fluid is on the left.
  EXPECT_NEAR((outline.openings[0].polylines[0][0] - macro::Vector<2>(0, 75e-6)).norm(), 0, 1e-15);
  // Straight stretches are one segment; curved ones have one for each cell.
  for (const auto& wall : outline.walls) {
    EXPECT_GE(wall.size(), 6U);
    EXPECT_LE(wall.size(), 40U);
  }
}

TEST(Bifurcation, conserves_flux_on_the_grid_and_states_its_errors) {
  HEMOSCALE_NEEDS_OPENFOAM();
  const EnsembleFlow vessel = built(patches + "grid_spacing = \"2 um\"\n", mesh_of_the_case);
  for (const auto& [name, value] : vessel.statements)
    std::printf("%s: %.4g\n", name.c_str(), value);
  ASSERT_EQ(vessel.openings.size(), 3U);
  EXPECT_EQ(vessel.openings[0].name, "inlet");
  const double parent = statement(vessel, "flux through inlet");
  const double upper = -statement(vessel, "flux through upper");
  const double lower = -statement(vessel, "flux through lower");
  EXPECT_NEAR(parent, 2e-3 * 75e-6, 1e-3 * 2e-3 * 75e-6);
  EXPECT_NEAR((upper + lower) / parent, 1, 1e-3);
  // Unequal: about as the cubes of the widths.
  EXPECT_NEAR(upper / parent, 0.74, 0.05);
  EXPECT_LE(statement(vessel, "rms interpolation error"), 1e-3);
  EXPECT_LE(statement(vessel, "largest interpolation error"), 3e-2);
  EXPECT_LE(statement(vessel, "rms divergence"), 5e-3);
  // The nose of the divider is no larger than a cell: one expansion for all of it is coarse there.
  EXPECT_LE(statement(vessel, "rms error of one expansion"), 2e-2);
  EXPECT_LE(statement(vessel, "largest error of one expansion"), 0.4);

  // Developed profiles in the parent and beyond its inlet.
  for (const double x : {-5e-6, 0.0, 20e-6}) {
    for (double s = 0.02; s < 1; s += 0.04) {
      const micro::LocalFlow here = vessel.flow->at({x, s * 75e-6}, 0);
      EXPECT_NEAR(here.velocity[0], 6 * 2e-3 * s * (1 - s), 5e-3 * 3e-3) << x << " " << s;
    }
  }
  // At rest on every wall, which is where the mesh has it.
  for (const auto& wall : vessel.walls->walls()) {
    for (std::size_t k = 1; k + 2 < wall.size(); ++k) {
      const micro::Vector<2> middle = 0.5 * (wall[k] + wall[k + 1]);
      EXPECT_LE(vessel.flow->at(middle, 0).velocity.norm(), 3e-2 * 3e-3) << middle.transpose();
    }
  }
  // Cells that leave pass between the continued walls.
  double least = 0;
  for (const auto& wall : vessel.walls->walls()) {
    for (const micro::Vector<2>& x : wall) least = std::min(least, x[0]);
  }
  EXPECT_NEAR(least, -vessel.overhang, 1e-15);
  const micro::Opening& outlet = vessel.openings[1];
  const micro::Vector<2> left = micro::point_at(outlet, 0.5 * outlet.length(), -5e-6);
  EXPECT_TRUE(micro::has_left(outlet, left, vessel.overhang));
  EXPECT_GT(vessel.walls->at(left).distance, 0);
  const micro::Vector<2> at_outlet =
      vessel.flow->at(micro::point_at(outlet, 0.5 * outlet.length(), 0), 0).velocity;
  EXPECT_NEAR((vessel.flow->at(left, 0).velocity - at_outlet).norm(), 0, 1e-2 * at_outlet.norm());
}

/// Largest change of the velocity between points 0.05 um apart, on a line on which blocks of the
/// mesh meet.
double largest_jump(macro::Interpolation interpolation) {
  macro::CaseReading reading;
  reading.units = {1e-6, 1e-3, 1050};
  reading.pressure_field = "";
  reading.interpolation = interpolation;
  const auto field = macro::OpenFoamLibrary().open_case(solved(coarse_mesh).path(), reading);
  std::vector<macro::Vector<3>> points;
  for (double x = 205; x < 235; x += 0.05) points.push_back({x * 1e-6, 45e-6, 0.5e-6});
  double largest = 0;
  const auto states = field->sample(points, 0);
  for (std::size_t k = 0; k + 1 < states.size(); ++k) {
    if (!states[k] || !states[k + 1]) return std::nan("");
    largest = std::max(largest, (states[k + 1]->velocity - states[k]->velocity).norm());
  }
  return largest;
}

TEST(Bifurcation, least_squares_smooth_what_gauss_gradients_make_jump) {
  HEMOSCALE_NEEDS_OPENFOAM();
  const double gauss = largest_jump(macro::Interpolation::taylor);
  const double least_squares = largest_jump(macro::Interpolation::least_squares);
  std::printf("largest jump: Gauss %.3e m/s, least squares %.3e m/s\n", gauss, least_squares);
  EXPECT_LE(least_squares, 0.8 * gauss);
}

TEST(Bifurcation, a_finer_grid_has_a_smaller_error) {
  HEMOSCALE_NEEDS_OPENFOAM();
  const double coarse =
      statement(built(patches + "grid_spacing = \"3 um\"\n"), "rms interpolation");
  const double fine =
      statement(built(patches + "grid_spacing = \"1.5 um\"\n"), "rms interpolation");
  std::printf("rms interpolation error: %.3e at 3 um, %.3e at 1.5 um\n", coarse, fine);
  EXPECT_LE(fine, coarse / 1.5);
}

TEST(Bifurcation, is_solved_once_where_a_solver_is_named) {
  HEMOSCALE_NEEDS_OPENFOAM();
  test::CaseFolder results;
  test::CaseFolder folder;
  folder.copy_from(bifurcation);
  // Few iterations are enough here.
  folder.replace("system/controlDict", "endTime         2000;", "endTime 60;");
  folder.replace("system/controlDict", "writeInterval   2000;", "writeInterval 60;");
  const Settings solving =
      settings_of(case_text(patches + "grid_spacing = \"3 um\"\nsolver = \"simpleFoam\"\n"));
  build_ensemble_flow(solving, folder.path(), results.path());
  EXPECT_TRUE(std::filesystem::exists(results.path() / "flow/60/U"));
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "60"));
  // Would be seen if it ran again.
  std::filesystem::remove(results.path() / "log.flow-solver");
  build_ensemble_flow(solving, folder.path(), results.path());
  EXPECT_FALSE(std::filesystem::exists(results.path() / "log.flow-solver"));
}

std::string refusal(const std::string& more) {
  try {
    built(more);
  } catch (const CaseError& error) {
    return error.what();
  } catch (const macro::EnvironmentError& error) {
    return error.what();
  }
  return "none";
}

TEST(Bifurcation, with_wrong_names_is_refused) {
  HEMOSCALE_NEEDS_OPENFOAM();
  EXPECT_THAT(refusal("inlet = \"entrance\"\noutlets = \"upper, lower\"\n"),
              HasSubstr("no opening \"entrance\"; it has inlet, upper, lower"));
  EXPECT_THAT(refusal("inlet = \"inlet\"\noutlets = \"upper\"\n"), HasSubstr("name them all"));
  EXPECT_THAT(refusal(patches + "grid_spacing = \"1 nm\"\n"), HasSubstr("enlarge the spacing"));
  EXPECT_THAT(refusal(patches + "time = \"7\"\n"), HasSubstr("no time '7'"));
  EXPECT_THAT(refusal(patches + "velocity_field = \"V\"\n"), HasSubstr("no field 'V'"));
}

TEST(Bifurcation, whose_flow_enters_elsewhere_is_refused) {
  HEMOSCALE_NEEDS_OPENFOAM();
  EXPECT_THROW(built("inlet = \"upper\"\noutlets = \"inlet, lower\"\n"), NumericalError);
}

TEST(Outline, of_a_mesh_that_is_not_plane_is_refused) {
  HEMOSCALE_NEEDS_OPENFOAM();
  test::CaseFolder folder;
  test::make_channel(folder, test::Scale::micrometre, 8);
  folder.replace("system/blockMeshDict", "frontAndBack { type empty;",
                 "frontAndBack { type patch;");
  ASSERT_EQ(folder.run("blockMesh").status, 0);
  macro::CaseReading reading;
  EXPECT_THROW(macro::OpenFoamLibrary().read_outline(folder.path(), reading),
               macro::ParameterError);
  reading.decomposed = true;
  EXPECT_THROW(macro::OpenFoamLibrary().read_outline(folder.path(), reading),
               macro::ParameterError);
}

}  // namespace
}  // namespace hemoscale::coupling
