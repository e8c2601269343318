// The viscosity model `hemoscale` in stock solvers: right law, right units, same answer on any
// number of ranks, and loud when it cannot work.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "macro/analytic/channel_model.hpp"
#include "macro/openfoam/loader.hpp"
#include "tests/openfoam/adapter/case_folder.hpp"

namespace hemoscale::macro {
namespace {

using test::CaseFolder;
using test::Scale;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

const char* const casson_coefficients =
    "law { initial casson; casson { yield_stress 0.05; viscosity 4e-3; lowest_shear_rate 1; } }";

void expect_casson_channel(Scale scale) {
  CaseFolder folder;
  test::make_channel(folder, scale, 80);
  folder.replace("constant/transportProperties",
                 "law   { initial newtonian; newtonian { viscosity $plasma; } }",
                 casson_coefficients);
  folder.append("system/controlDict", "endTime 300; writeInterval 300;");
  const test::Outcome run = folder.run("blockMesh && simpleFoam");
  ASSERT_EQ(run.status, 0) << run.output;

  const ViscosityLaw law(Casson{0.05, 4e-3, 1});
  const auto exact = ChannelModel<2>({1e-4, 0.4, MeanVelocity{3.3333333333e-3}}).solve(law);
  CaseReading reading;
  if (scale == Scale::micrometre) {
    reading.units.length = 1e-6;
    reading.units.time = 1e-3;
  }
  const auto flow = OpenFoamLibrary().open_case(folder.path(), reading);
  double error = 0;
  double highest = 0;
  for (int k = 0; k < 101; ++k) {
    const double y = 1e-6 * k;
    const auto state = flow->at({5e-5, y, 0.5e-6}, 0);
    ASSERT_TRUE(state.has_value()) << y;
    error = std::max(error, std::abs(state->velocity(0) - exact->velocity(y)));
    highest = std::max(highest, exact->velocity(y));
  }
  std::printf("deviation from the quadrature %.2e of the highest velocity\n", error / highest);
  EXPECT_LE(error / highest, 5e-3);
}

TEST(ViscosityModel, channel_of_a_casson_fluid_agrees_with_the_quadrature_in_micrometres) {
  HEMOSCALE_NEEDS_OPENFOAM();
  expect_casson_channel(Scale::micrometre);
}

TEST(ViscosityModel, channel_of_a_casson_fluid_agrees_with_the_quadrature_in_metres) {
  HEMOSCALE_NEEDS_OPENFOAM();
  expect_casson_channel(Scale::metre);
}

/// OpenFOAM's tutorial with our viscosity model and a given law, tolerances tightened.
void make_offset_cylinder(CaseFolder& folder) {
  const std::filesystem::path copy = folder.path() / "case";
  const test::Outcome run = folder.run(HEMOSCALE_SOURCE_DIR
                                       "/cases/support/openfoam-tutorial.sh "
                                       "incompressible/nonNewtonianIcoFoam/offsetCylinder " +
                                       copy.string());
  ASSERT_EQ(run.status, 0) << run.output;
  folder.copy_from(copy);
  std::filesystem::remove_all(copy);
  folder.append("system/controlDict",
                "libs (\"$HEMOSCALE_OPENFOAM_LIBRARY\"); endTime 0.01; writeControl timeStep; "
                "writeInterval 1; writePrecision 14;\n");
  folder.append("system/fvSolution",
                "solvers { p { solver PCG; preconditioner DIC; tolerance 1e-12; relTol 0; } "
                "pFinal { solver PCG; preconditioner DIC; tolerance 1e-12; } "
                "U { tolerance 1e-12; } } PISO { nCorrectors 2; }\n");
  folder.append("constant/transportProperties",
                "transportModel hemoscale; hemoscaleCoeffs { law { initial carreau-yasuda; } "
                "fluid { density 1050; hematocrit 0.4; } "
                "macro { openfoam { length_unit 0.25e-3; time_unit 25e-3; } } }\n");
  folder.write("system/decomposeParDict",
               "FoamFile { version 2.0; format ascii; class dictionary; object d; }\n"
               "numberOfSubdomains 2; method simple; simpleCoeffs { n (2 1 1); delta 0.001; }\n");
  ASSERT_EQ(folder.run("blockMesh").status, 0);
}

double largest_difference(const std::vector<std::vector<double>>& a,
                          const std::vector<std::vector<double>>& b) {
  double largest = a.size() == b.size() ? 0 : HUGE_VAL;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    for (std::size_t k = 0; k < a[i].size(); ++k) {
      largest = std::max(largest, std::abs(a[i][k] - b[i][k]));
    }
  }
  return largest;
}

TEST(OffsetCylinder, two_ranks_agree_with_one_and_the_viscosity_is_that_of_the_law) {
  HEMOSCALE_NEEDS_OPENFOAM();
  CaseFolder folder;
  make_offset_cylinder(folder);
  const test::Outcome serial =
      folder.run("nonNewtonianIcoFoam && postProcess -func 'grad(U)' -time 0.0075");
  ASSERT_EQ(serial.status, 0) << serial.output;
  const auto velocity = test::read_field(folder.path() / "0.01/U");
  const auto viscosity = test::read_field(folder.path() / "0.01/nu");
  ASSERT_EQ(viscosity.size(), 1800u);

  const test::Outcome parallel =
      folder.run("mv 0.01 serial && decomposePar && " + CaseFolder::mpirun(2) +
                 " nonNewtonianIcoFoam -parallel && reconstructPar -time 0.01");
  ASSERT_EQ(parallel.status, 0) << parallel.output;
  const double velocity_difference =
      largest_difference(velocity, test::read_field(folder.path() / "0.01/U"));
  const double viscosity_difference =
      largest_difference(viscosity, test::read_field(folder.path() / "0.01/nu"));
  std::printf("1 and 2 ranks: |dU| %.1e, |dnu| %.1e\n", velocity_difference, viscosity_difference);
  EXPECT_LE(velocity_difference, 1e-8);
  EXPECT_LE(viscosity_difference, 1e-6);

  // The solver asks for the viscosity at the start of a step, with the velocity of the step before.
  const CarreauYasuda law = cho_kensey_1991();
  const double unit = 1050 * 0.25e-3 * 0.25e-3 / 25e-3;  // [Pa s] of 1
  const auto gradient = test::read_field(folder.path() / "0.0075/grad(U)");
  ASSERT_EQ(gradient.size(), viscosity.size());
  double deviation = 0;
  double lowest = HUGE_VAL;
  double highest = 0;
  for (std::size_t i = 0; i < gradient.size(); ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < 3; ++j) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double d = 0.5 * (gradient[i][3 * j + k] + gradient[i][3 * k + j]);
        sum += 2 * d * d;
      }
    }
    const double found = viscosity[i][0] * unit;
    const double expected = macro::viscosity(law, std::sqrt(sum) / 25e-3, 0.4);
    deviation = std::max(deviation, std::abs(found / expected - 1));
    lowest = std::min(lowest, found);
    highest = std::max(highest, found);
  }
  std::printf("viscosity %.4g to %.4g Pa s, deviation from the law %.1e\n", lowest, highest,
              deviation);
  EXPECT_LE(deviation, 1e-9);
  EXPECT_GT(highest / lowest, 3);
}

TEST(OffsetCylinder, stock_run_has_another_viscosity) {
  HEMOSCALE_NEEDS_OPENFOAM();
  CaseFolder ours;
  CaseFolder stock;
  make_offset_cylinder(ours);
  make_offset_cylinder(stock);
  stock.append("constant/transportProperties", "transportModel CrossPowerLaw;");
  ASSERT_EQ(ours.run("nonNewtonianIcoFoam").status, 0);
  ASSERT_EQ(stock.run("nonNewtonianIcoFoam").status, 0);
  EXPECT_GT(largest_difference(test::read_field(ours.path() / "0.01/nu"),
                               test::read_field(stock.path() / "0.01/nu")),
            1);
  EXPECT_GT(largest_difference(test::read_field(ours.path() / "0.01/U"),
                               test::read_field(stock.path() / "0.01/U")),
            0.1);
}

TEST(ViscosityModel, refuses_entries_it_does_not_know_or_that_are_wrong) {
  HEMOSCALE_NEEDS_OPENFOAM();
  CaseFolder folder;
  test::make_channel(folder, Scale::micrometre, 20);
  ASSERT_EQ(folder.run("blockMesh").status, 0);
  const std::string good = folder.read("constant/transportProperties");
  const auto output_with = [&](const std::string& before, const std::string& after) {
    folder.write("constant/transportProperties", good);
    folder.replace("constant/transportProperties", before, after);
    const test::Outcome run = folder.run("simpleFoam");
    EXPECT_EQ(run.status, 1);
    return run.output;
  };
  EXPECT_THAT(output_with("{ viscosity $plasma; }", "{ viskosity 1e-3; }"),
              AllOf(HasSubstr("unknown entry 'viskosity'"), HasSubstr("known here: viscosity"),
                    HasSubstr("line ")));
  EXPECT_THAT(output_with("initial newtonian;", "initial newton;"),
              HasSubstr("initial is 'newton'; it must be newtonian, carreau-yasuda"));
  EXPECT_THAT(output_with("density $density;", "density -1;"),
              HasSubstr("density is -1.000000; it must be positive"));
  EXPECT_THAT(output_with("law   {", "lav {"), HasSubstr("unknown entry 'lav'"));
  EXPECT_THAT(output_with("hemoscaleCoeffs", "coefficients"), HasSubstr("hemoscaleCoeffs"));
  EXPECT_THAT(output_with("hematocrit $hematocrit;", ""), HasSubstr("hematocrit"));
}

TEST(ViscosityModel, library_that_does_not_load_ends_the_solver) {
  HEMOSCALE_NEEDS_OPENFOAM();
  CaseFolder folder;
  test::make_channel(folder, Scale::micrometre, 20);
  ASSERT_EQ(folder.run("blockMesh").status, 0);
  const test::Outcome run =
      folder.run("simpleFoam", {{"HEMOSCALE_OPENFOAM_LIBRARY", "/nowhere/libhemoscale.so"}});
  EXPECT_EQ(run.status, 1);
  EXPECT_THAT(run.output, AllOf(HasSubstr("Could not load"),
                                HasSubstr("Unknown viscosityModel type hemoscale")));
}

}  // namespace
}  // namespace hemoscale::macro
