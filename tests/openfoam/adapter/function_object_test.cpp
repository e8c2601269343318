// The function object `hemoscale` in stock solvers: the loop closes, and everything that would
// make it meaningless ends the run. The micro model is synthetic: a known law in place of cells.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/openfoam/adapter/case_folder.hpp"

namespace hemoscale::test {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

namespace fs = std::filesystem;

/// Keys of a case as sub-dictionaries of the function object.
struct Dictionary {
  std::string points = "(50 0.5 0.5) (50 5 0.5) (50 20 0.5) (50 40 0.5)";
  std::string scheme = "explicit";
  std::string more;
};

std::string points_in_micrometres(const std::string& points) {
  std::string text;
  for (const char c : points) {
    if (c == '(') {
      text += "(\"";
    } else if (c == ' ' && !text.empty() && text.back() != ')') {
      text += " um\" \"";
    } else if (c == ')') {
      text += " um\")";
    } else {
      text += c;
    }
  }
  return text;
}

std::string function_object(const Dictionary& d) {
  return "functions\n{\n    hemoscale\n    {\n        type hemoscale;\n"
         "        libs (\"$HEMOSCALE_OPENFOAM_LIBRARY\");\n"
         "        case { name test; }\n"
         "        fluid { hematocrit 0.4; density 1050; plasma_viscosity 1.2 mPa s; }\n"
         "        macro { openfoam { length_unit 1 um; time_unit \"1 ms\"; } }\n"
         "        law { newtonian { viscosity 1.2e-3; } }\n"
         "        sampling { points (" +
         points_in_micrometres(d.points) +
         "); }\n"
         "        coupling { scheme " +
         d.scheme +
         "; interval 20; }\n"
         "        micro { model synthetic; synthetic { law casson; noise 0; } }\n" +
         d.more + "    }\n}\n";
}

/// The template channel, meshed, with the function object in its controlDict; 100 iterations.
void make_coupled(CaseFolder& folder, const Dictionary& dictionary) {
  make_channel(folder, Scale::micrometre, 20);
  folder.append("system/controlDict",
                "endTime 100; writeInterval 100;\n" + function_object(dictionary));
  const Outcome run = folder.run("blockMesh");
  ASSERT_EQ(run.status, 0) << run.output;
}

double highest_of(const fs::path& field) {
  double highest = 0;
  for (const std::vector<double>& value : read_field(field)) {
    highest = std::max(highest, value[0]);
  }
  return highest;
}

TEST(FunctionObject, closes_the_loop_on_one_and_on_two_ranks) {
  HEMOSCALE_NEEDS_OPENFOAM();
  CaseFolder folder;
  make_coupled(folder, {});
  const Outcome serial = folder.run("simpleFoam");
  ASSERT_EQ(serial.status, 0) << serial.output;
  EXPECT_THAT(serial.output, HasSubstr("hemoscale: pass 1"));
  ASSERT_TRUE(fs::exists(folder.path() / "results" / "summary.json"));
  // Casson's law with the default parameters: far from the axis it is near 3.5 mPa s, close to it
  // many times that; the initial law was 1.2 mPa s everywhere, 1143 um^2/ms.
  const auto nu = read_field(folder.path() / "100/nu");
  EXPECT_GT(highest_of(folder.path() / "100/nu"), 3.5e-3 / 1050 * 1e9 * 1.3);
  for (const std::vector<double>& value : nu) EXPECT_GT(value[0], 3.5e-3 / 1050 * 1e9);

  const auto velocity = read_field(folder.path() / "100/U");
  const Outcome parallel =
      folder.run("mv 100 serial && mv results results-serial && decomposePar && " +
                 CaseFolder::mpirun(2) + " simpleFoam -parallel && reconstructPar -time 100");
  ASSERT_EQ(parallel.status, 0) << parallel.output;
  ASSERT_TRUE(fs::exists(folder.path() / "results" / "summary.json"));
  const auto in_parts = read_field(folder.path() / "100/U");
  ASSERT_EQ(in_parts.size(), velocity.size());
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    EXPECT_NEAR(in_parts[i][0], velocity[i][0], 1e-6) << i;
  }
}

TEST(FunctionObject, one_way_measures_and_leaves_the_flow_alone) {
  HEMOSCALE_NEEDS_OPENFOAM();
  CaseFolder folder;
  Dictionary dictionary;
  dictionary.scheme = "one-way";
  make_coupled(folder, dictionary);
  const Outcome run = folder.run("simpleFoam");
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_TRUE(fs::exists(folder.path() / "results" / "summary.json"));
  EXPECT_NEAR(highest_of(folder.path() / "100/nu"), 1.2e-3 / 1050 * 1e9, 1e-6);
}

TEST(FunctionObject, refuses_a_solver_that_never_asks_for_the_viscosity) {
  HEMOSCALE_NEEDS_OPENFOAM();
  CaseFolder folder;
  make_coupled(folder, {});
  folder.append("system/controlDict", "application icoFoam; deltaT 1e-4; endTime 0.004;");
  folder.append("system/fvSchemes",
                "ddtSchemes { default Euler; } divSchemes { div(phi,U) Gauss linear; }");
  folder.append("system/fvSolution",
                "solvers { pFinal { $p; } } PISO { nCorrectors 2; pRefCell 0; pRefValue 0; }");
  folder.append("constant/transportProperties", "nu 1143;");
  const Outcome run = folder.run("icoFoam");
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.output,
              AllOf(HasSubstr("no feedback possible"), HasSubstr("icoFoam"), HasSubstr("one-way")));
  EXPECT_FALSE(fs::exists(folder.path() / "results" / "summary.json"));
}

TEST(FunctionObject, refuses_a_viscosity_model_that_is_not_ours) {
  HEMOSCALE_NEEDS_OPENFOAM();
  CaseFolder folder;
  make_coupled(folder, {});
  folder.append("constant/transportProperties", "transportModel Newtonian; nu 1143;");
  const Outcome run = folder.run("simpleFoam");
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.output,
              AllOf(HasSubstr("no feedback possible"), HasSubstr("transportModel hemoscale")));
}

TEST(FunctionObject, refuses_the_implicit_scheme_with_the_reason) {
  HEMOSCALE_NEEDS_OPENFOAM();
  CaseFolder folder;
  Dictionary dictionary;
  dictionary.scheme = "implicit";
  make_coupled(folder, dictionary);
  const Outcome run = folder.run("simpleFoam");
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.output, AllOf(HasSubstr("coupling.scheme is implicit"), HasSubstr("repeated")));
}

TEST(FunctionObject, refuses_points_outside_the_mesh) {
  HEMOSCALE_NEEDS_OPENFOAM();
  CaseFolder folder;
  Dictionary dictionary;
  dictionary.points = "(50 5 0.5) (50 101 0.5)";
  make_coupled(folder, dictionary);
  const Outcome run = folder.run("simpleFoam");
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.output, AllOf(HasSubstr("sampling.points: outside the mesh"),
                                HasSubstr("0.000101"), Not(HasSubstr("5e-06  5e-07"))));
}

TEST(FunctionObject, names_file_line_and_nearest_key_of_an_unknown_one) {
  HEMOSCALE_NEEDS_OPENFOAM();
  CaseFolder folder;
  Dictionary dictionary;
  dictionary.more = "        output { trajektory no; }\n";
  make_coupled(folder, dictionary);
  const std::string text = folder.read("system/controlDict");
  const auto line =
      1 + std::count(text.begin(),
                     text.begin() + static_cast<std::ptrdiff_t>(text.find("trajektory")), '\n');
  const Outcome run = folder.run("simpleFoam");
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.output, AllOf(HasSubstr("system/controlDict:" + std::to_string(line)),
                                HasSubstr("output.trajektory"), HasSubstr("output.trajectory")));
}

TEST(FunctionObject, refuses_units_that_differ_from_those_of_the_viscosity_model) {
  HEMOSCALE_NEEDS_OPENFOAM();
  CaseFolder folder;
  make_coupled(folder, {});
  folder.replace("system/controlDict", "length_unit 1 um;", "length_unit 2 um;");
  const Outcome run = folder.run("simpleFoam");
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.output, HasSubstr("macro.openfoam.length_unit is 1e-06 in hemoscaleCoeffs"));
}

TEST(FunctionObject, refuses_keys_beside_a_case_file) {
  HEMOSCALE_NEEDS_OPENFOAM();
  CaseFolder folder;
  make_coupled(folder, {});
  folder.replace("system/controlDict", "case { name test; }", "case \"../case.toml\";");
  const Outcome run = folder.run("simpleFoam");
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.output, AllOf(HasSubstr("fluid"), HasSubstr("stands beside 'case'")));
}

TEST(FunctionObject, refuses_a_run_that_ends_before_anything_was_coupled) {
  HEMOSCALE_NEEDS_OPENFOAM();
  CaseFolder folder;
  make_coupled(folder, {});
  folder.append("system/controlDict", "endTime 10;");
  const Outcome run = folder.run("simpleFoam");
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.output, HasSubstr("nothing was coupled"));
}

TEST(FunctionObject, refuses_a_flow_that_diverged) {
  HEMOSCALE_NEEDS_OPENFOAM();
  CaseFolder folder;
  make_coupled(folder, {});
  // overshoots a little more with every iteration
  folder.replace("constant/fvOptions", "relaxation      0.005;", "relaxation      3;");
  folder.replace("system/fvSolution", "consistent      yes;", "consistent      no;");
  const Outcome run = folder.run("simpleFoam");
  EXPECT_NE(run.status, 0);
  EXPECT_FALSE(fs::exists(folder.path() / "results" / "summary.json"));
  EXPECT_THAT(run.output, HasSubstr("the solver diverged"));
}

TEST(FunctionObject, library_that_does_not_load_does_not_pass_for_success) {
  HEMOSCALE_NEEDS_OPENFOAM();
  // With the stock viscosity model OpenFOAM runs on without the function object, with status 0: the
  // only mark of success is what the plug-in writes.
  CaseFolder folder;
  make_coupled(folder, {});
  folder.append("constant/transportProperties", "transportModel Newtonian; nu 1143;");
  const Outcome run =
      folder.run("simpleFoam", {{"HEMOSCALE_OPENFOAM_LIBRARY", "/nowhere/libhemoscale.so"}});
  EXPECT_EQ(run.status, 0);
  EXPECT_THAT(run.output, HasSubstr("Could not load"));
  EXPECT_FALSE(fs::exists(folder.path() / "results" / "summary.json"));

  const Outcome script =
      folder.run(HEMOSCALE_SOURCE_DIR
                 "/cases/offset-cylinder-blood/Allrun --no-stock --variant quick --end "
                 "0.05 --results script",
                 {{"HEMOSCALE_OPENFOAM_LIBRARY", "/nowhere/libhemoscale.so"}});
  EXPECT_NE(script.status, 0);
}

TEST(FunctionObject, failure_of_one_rank_ends_all) {
  HEMOSCALE_NEEDS_OPENFOAM();
  CaseFolder folder;
  Dictionary dictionary;
  dictionary.more = "        variant \"${TEST_VARIANT:-}\";\n";
  make_coupled(folder, dictionary);
  ASSERT_EQ(folder.run("decomposePar").status, 0);
  const Outcome run = folder.run(CaseFolder::mpirun(1) + " simpleFoam -parallel : -np 1 " +
                                 "env TEST_VARIANT=absent simpleFoam -parallel");
  EXPECT_NE(run.status, 0);
  EXPECT_NE(run.status, 124) << "hung";
  EXPECT_THAT(run.output, HasSubstr("there is no variant"));
  EXPECT_FALSE(fs::exists(folder.path() / "results" / "summary.json"));
}

TEST(OffsetCylinderBlood, script_runs_reduced_and_keeps_its_promises) {
  HEMOSCALE_NEEDS_OPENFOAM();
  CaseFolder folder;
  const Outcome run =
      folder.run(HEMOSCALE_SOURCE_DIR
                 "/cases/offset-cylinder-blood/Allrun --variant quick --end 0.1 --results .");
  ASSERT_EQ(run.status, 0) << run.output;
  EXPECT_TRUE(fs::exists(folder.path() / "coupled" / "summary.json"));
  EXPECT_GT(fs::file_size(folder.path() / "offset-cylinder-blood.png"), 10000u);
  EXPECT_THAT(folder.read("figures.json"), HasSubstr("highest viscosity of the stock run"));
}

}  // namespace
}  // namespace hemoscale::test
