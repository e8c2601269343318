// Opening cases without a solver: times, decomposed cases, and everything that can be wrong.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "macro/error.hpp"
#include "macro/openfoam/loader.hpp"
#include "tests/openfoam/adapter/case_folder.hpp"

namespace hemoscale::macro {
namespace {

using test::CaseFolder;
using ::testing::AllOf;
using ::testing::HasSubstr;

std::string failure_of(const std::function<void()>& code) {
  try {
    code();
  } catch (const EnvironmentError& error) {
    return error.what();
  }
  return "no EnvironmentError";
}

/// The template channel in micrometres, meshed; its time 0 has U and p.
void make_meshed(CaseFolder& folder) {
  test::make_channel(folder, test::Scale::micrometre, 20);
  const test::Outcome run = folder.run("blockMesh");
  ASSERT_EQ(run.status, 0) << run.output;
}

TEST(CaseReader, chooses_the_latest_time_or_the_given_one) {
  HEMOSCALE_NEEDS_OPENFOAM();
  CaseFolder folder;
  make_meshed(folder);
  std::filesystem::copy(folder.path() / "0", folder.path() / "2.5",
                        std::filesystem::copy_options::recursive);
  folder.replace("2.5/U", "internalField   uniform ($meanVelocity 0 0);",
                 "internalField uniform (7 0 0);");
  const OpenFoamLibrary library;
  const Vector<3> x(50, 50, 0.5);
  CaseReading reading;
  EXPECT_DOUBLE_EQ(library.open_case(folder.path(), reading)->at(x, 0)->velocity(0), 7);
  reading.time = "0";
  EXPECT_DOUBLE_EQ(library.open_case(folder.path(), reading)->at(x, 0)->velocity(0), 3.3333333333);
  reading.time = "2.50";
  EXPECT_DOUBLE_EQ(library.open_case(folder.path(), reading)->at(x, 0)->velocity(0), 7);
  reading.time = "3";
  EXPECT_THAT(failure_of([&] { library.open_case(folder.path(), reading); }),
              AllOf(HasSubstr("no time '3'"), HasSubstr("0 2.5")));
}

TEST(CaseReader, several_cases_can_be_open_at_once) {
  HEMOSCALE_NEEDS_OPENFOAM();
  CaseFolder one;
  CaseFolder other;
  make_meshed(one);
  make_meshed(other);
  other.replace("system/channel", "3.3333333333;", "5;");
  const OpenFoamLibrary library;
  const auto first = library.open_case(one.path(), {});
  const auto second = library.open_case(other.path().string() + "/", {});
  const Vector<3> x(50, 50, 0.5);
  EXPECT_DOUBLE_EQ(first->at(x, 0)->velocity(0), 3.3333333333);
  EXPECT_DOUBLE_EQ(second->at(x, 0)->velocity(0), 5);
}

TEST(CaseReader, says_what_is_wrong_with_a_folder) {
  HEMOSCALE_NEEDS_OPENFOAM();
  CaseFolder folder;
  const OpenFoamLibrary library;
  const auto failure = [&](const std::filesystem::path& path, const CaseReading& reading = {}) {
    return failure_of([&] { library.open_case(path, reading); });
  };
  EXPECT_THAT(failure(folder.path() / "absent"), HasSubstr("no such folder"));
  EXPECT_THAT(failure(folder.path()), HasSubstr("no system/controlDict"));
  test::make_channel(folder, test::Scale::micrometre, 20);
  EXPECT_THAT(failure(folder.path()), AllOf(HasSubstr("no mesh"), HasSubstr("blockMesh")));
  ASSERT_EQ(folder.run("blockMesh").status, 0);

  CaseReading velocity;
  velocity.velocity_field = "Urel";
  EXPECT_THAT(failure(folder.path(), velocity), HasSubstr("no field 'Urel' at time 0"));
  velocity.velocity_field = "p";
  EXPECT_THAT(failure(folder.path(), velocity),
              HasSubstr("is a volScalarField, not a volVectorField"));

  std::filesystem::remove(folder.path() / "0" / "U");
  EXPECT_THAT(failure(folder.path()), HasSubstr("no field 'U' at time 0"));
  folder.write("0/U",
               "FoamFile { version 2.0; format ascii; class volVectorField; object U; }\n"
               "dimensions [0 1 -1 0 0 0 0]; internalField uniform (1 0");
  EXPECT_THAT(failure(folder.path()), HasSubstr("OpenFOAM cannot read the case"));

  std::filesystem::remove_all(folder.path() / "0");
  EXPECT_THAT(failure(folder.path()), HasSubstr("no time folder"));
  CaseReading decomposed;
  decomposed.decomposed = true;
  EXPECT_THAT(failure(folder.path(), decomposed), HasSubstr("not decomposed"));
  CaseReading units;
  units.units.length = 0;
  EXPECT_THROW(library.open_case(folder.path(), units), ParameterError);
}

TEST(CaseReader, leaves_the_host_its_signal_handlers_and_its_arithmetic) {
  HEMOSCALE_NEEDS_OPENFOAM();
  CaseFolder folder;
  make_meshed(folder);
  const auto flow = OpenFoamLibrary().open_case(folder.path(), {});
  volatile double zero = 0;
  EXPECT_TRUE(zero / zero != zero / zero);  // a trap would end the test here
}

TEST(CaseReader, ranks_of_a_decomposed_case_agree_with_the_whole_one) {
  HEMOSCALE_NEEDS_OPENFOAM();
  CaseFolder folder;
  test::make_channel(folder, test::Scale::micrometre, 20);
  folder.append("system/controlDict", "endTime 20; writeInterval 20;");
  ASSERT_EQ(folder.run("blockMesh").status, 0);
  const test::Outcome run = folder.run("simpleFoam && decomposePar -latestTime");
  ASSERT_EQ(run.status, 0) << run.output;
  const test::Outcome sampled =
      folder.run(CaseFolder::mpirun(2) + " " HEMOSCALE_SAMPLER " " + folder.path().string());
  EXPECT_EQ(sampled.status, 0) << sampled.output;
  EXPECT_THAT(sampled.output, HasSubstr("agree"));
  const test::Outcome wrong =
      folder.run(CaseFolder::mpirun(3) + " " HEMOSCALE_SAMPLER " " + folder.path().string());
  EXPECT_NE(wrong.status, 0);
  EXPECT_THAT(wrong.output, HasSubstr("not decomposed for 3 ranks"));
}

}  // namespace
}  // namespace hemoscale::macro
