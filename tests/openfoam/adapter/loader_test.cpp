// Loading the OpenFOAM library into a program that does not link OpenFOAM, and what can fail there.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <functional>

#include "macro/error.hpp"
#include "macro/openfoam/loader.hpp"
#include "tests/openfoam/adapter/case_folder.hpp"

namespace hemoscale::macro {
namespace {

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

TEST(Loader, finds_the_library_of_this_build) {
  HEMOSCALE_NEEDS_OPENFOAM();
  ::unsetenv("HEMOSCALE_OPENFOAM_LIBRARY");
  const OpenFoamLibrary library;
  EXPECT_TRUE(std::filesystem::equivalent(library.file(), test::library_file()));
  EXPECT_GE(library.version(), 1912);
}

TEST(Loader, says_that_a_named_file_is_absent) {
  EXPECT_THAT(failure_of([] { OpenFoamLibrary("/nowhere/lib.so"); }),
              AllOf(HasSubstr("/nowhere/lib.so"), HasSubstr("no such file")));
  ::setenv("HEMOSCALE_OPENFOAM_LIBRARY", "/nowhere/other.so", 1);
  EXPECT_THAT(failure_of([] { OpenFoamLibrary(); }),
              AllOf(HasSubstr("/nowhere/other.so"), HasSubstr("HEMOSCALE_OPENFOAM_LIBRARY")));
}

TEST(Loader, says_that_a_file_cannot_be_loaded) {
  HEMOSCALE_NEEDS_OPENFOAM();
  test::CaseFolder folder;
  folder.write("libhemoscale_openfoam.so", "not a library");
  EXPECT_THAT(failure_of([&] { OpenFoamLibrary(folder.path() / "libhemoscale_openfoam.so"); }),
              AllOf(HasSubstr("cannot be loaded"), HasSubstr("is OpenFOAM installed")));
}

TEST(Loader, says_that_a_library_is_another_one) {
  HEMOSCALE_NEEDS_OPENFOAM();
  const std::filesystem::path other = test::library_file().parent_path() / "libhemoscale_macro.so";
  if (!std::filesystem::exists(other)) GTEST_SKIP() << "static libraries: no other one at hand";
  EXPECT_THAT(failure_of([&] { OpenFoamLibrary library(other); }),
              HasSubstr("not the OpenFOAM library of this version of HemoScale"));
}

TEST(Loader, says_that_openfoam_is_not_where_the_environment_points) {
  HEMOSCALE_NEEDS_OPENFOAM();
  ::unsetenv("HEMOSCALE_OPENFOAM_LIBRARY");
  ::setenv("WM_PROJECT_DIR", "/nowhere", 1);
  // without the check OpenFOAM would end this process
  EXPECT_THAT(failure_of([] { OpenFoamLibrary(); }),
              AllOf(HasSubstr("WM_PROJECT_DIR is /nowhere"), HasSubstr("etc/controlDict")));
}

}  // namespace
}  // namespace hemoscale::macro
