#include <gtest/gtest.h>

#include <cstdint>

#include "coupling/study/plan.hpp"
#include "tests/unit/study/study_case.hpp"

// Whatever bytes a study file holds: it is understood and planned, or refused with faults that have
// a message. Nothing else may happen.
namespace hemoscale::coupling {
namespace {

const std::string valid_study =
    "[study]\n"
    "name = \"a\"\n"
    "set = { output.trajectory = false }\n"
    "timeout = \"2 min\"\n"
    "[error]\n"
    "figure = \"f\"\n"
    "against = \"finest\"\n"
    "[refine]\n"
    "key = \"micro.time_step\"\n"
    "values = [\"4 us\", 2e-6]\n"
    "together = { \"micro.nodes\" = [16, 20] }\n"
    "[[series]]\n"
    "name = \"b\"\n"
    "skip = [{ \"micro.cells\" = 2 }]\n"
    "[[sweep]]\n"
    "key = \"micro.cells\"\n"
    "values = [2, 4]\n"
    "[map]\n"
    "key = \"micro.time_step\"\n"
    "stable = \"1 us\"\n"
    "unstable = \"1 ms\"\n"
    "along = { key = \"fluid.hematocrit\", values = [0.1] }\n";

/// @returns whether the study was understood
bool understood(const StudyCase& files, const std::string& text) {
  files.write("study.toml", text);
  try {
    const Study study = files.read();
    plan_chart(study);
    if (study.map) plan_map(study);
    return true;
  } catch (const CaseError& error) {
    EXPECT_FALSE(error.faults().empty()) << text;
    for (const Fault& fault : error.faults()) EXPECT_FALSE(fault.message.empty()) << text;
  }
  return false;
}

TEST(BrokenStudy, the_study_itself_is_valid) {
  const StudyCase files("");
  EXPECT_TRUE(understood(files, valid_study));
}

TEST(BrokenStudy, every_truncation) {
  const StudyCase files("");
  int refused = 0;
  for (std::size_t length = 0; length < valid_study.size(); length += 3) {
    refused += understood(files, valid_study.substr(0, length)) ? 0 : 1;
  }
  EXPECT_GT(refused, 100);
}

TEST(BrokenStudy, values_of_every_wrong_kind) {
  const StudyCase files("");
  const std::vector<std::string> wrong = {"3",    "-1",   "true", "\"x\"", "[]",
                                          "[[]]", "{}",   "nan",  "\"\"",  "{ a = { b = 1 } }",
                                          "[{}]", "1e999"};
  std::size_t refused = 0;
  std::size_t tried = 0;
  for (std::size_t at = valid_study.find(" = "); at != std::string::npos;
       at = valid_study.find(" = ", at + 1)) {
    const std::size_t end = valid_study.find('\n', at);
    for (const std::string& value : wrong) {
      const std::string text = valid_study.substr(0, at + 3) + value + valid_study.substr(end);
      ++tried;
      refused += understood(files, text) ? 0U : 1U;
    }
  }
  EXPECT_GT(tried, 150U);
  EXPECT_GT(refused, tried * 3 / 4);
}

}  // namespace
}  // namespace hemoscale::coupling
