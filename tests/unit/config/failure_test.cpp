#include "coupling/program/failure.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "coupling/error.hpp"
#include "macro/error.hpp"
#include "micro/error.hpp"

namespace hemoscale::coupling {
namespace {

template <class Error>
Outcome outcome_of_thrown(const Error& error) {
  return outcome_of(std::make_exception_ptr(error));
}

TEST(CaseErrorText, one_line_per_fault) {
  const CaseError error({{"a.toml", 3, 7, "x.y", "is wrong"},
                         {"a.toml", 3, 0, "x.y", "is wrong"},
                         {"a.toml", 0, 0, "", "is empty"},
                         {"", 0, 0, "x", "is not known"}});
  EXPECT_STREQ(
      error.what(),
      "a.toml:3:7: x.y: is wrong\na.toml:3: x.y: is wrong\na.toml: is empty\nx: is not known");
  EXPECT_EQ(error.faults().size(), 4U);
}

TEST(Failure, exit_codes) {
  EXPECT_EQ(outcome_of_thrown(CaseError({{"a.toml", 1, 2, "k", "m"}})).exit_code, 2);
  EXPECT_EQ(outcome_of_thrown(micro::ParameterError("m")).exit_code, 2);
  EXPECT_EQ(outcome_of_thrown(macro::ParameterError("m")).exit_code, 2);
  EXPECT_EQ(outcome_of_thrown(EnvironmentError("m")).exit_code, 3);
  EXPECT_EQ(outcome_of_thrown(micro::EnvironmentError("m")).exit_code, 3);
  EXPECT_EQ(outcome_of_thrown(macro::EnvironmentError("m")).exit_code, 3);
  EXPECT_EQ(outcome_of_thrown(NumericalError("m")).exit_code, 4);
  EXPECT_EQ(outcome_of_thrown(micro::NumericalError("m")).exit_code, 4);
  EXPECT_EQ(outcome_of_thrown(macro::NumericalError("m")).exit_code, 4);
  EXPECT_EQ(outcome_of_thrown(std::runtime_error("m")).exit_code, 5);
  EXPECT_EQ(outcome_of_thrown(std::bad_alloc()).exit_code, 5);
  EXPECT_EQ(outcome_of_thrown(3).exit_code, 5);
}

TEST(Failure, one_block_that_counts_the_faults) {
  const Outcome two =
      outcome_of_thrown(CaseError({{"a.toml", 1, 2, "k", "m"}, {"a.toml", 3, 4, "l", "n"}}));
  EXPECT_EQ(two.message,
            "hemoscale: the case is not valid\n  a.toml:1:2: k: m\n  a.toml:3:4: l: n\n2 faults\n");
  EXPECT_EQ(outcome_of_thrown(CaseError({{"", 0, 0, "k", "m"}})).message,
            "hemoscale: the request is not valid\n  k: m\n1 fault\n");
  EXPECT_THAT(outcome_of_thrown(EnvironmentError("a\nb")).message,
              testing::EndsWith("\n  a\n  b\n"));
}

}  // namespace
}  // namespace hemoscale::coupling
