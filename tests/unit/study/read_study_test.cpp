#include "coupling/study/read_study.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "coupling/config/overrides.hpp"
#include "tests/unit/study/study_case.hpp"

namespace hemoscale::coupling {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::vector<std::string> faults_of(const std::string& text) {
  const StudyCase files(text);
  return fault_places([&] { files.read(); });
}

std::string complaint_of(const std::string& text) {
  const StudyCase files(text);
  return complaint([&] { files.read(); });
}

TEST(ReadStudy, smallest_study_has_one_series_and_the_case_beside_it) {
  const StudyCase files("[study]\nname = \"a\"\n");
  const Study study = files.read();
  EXPECT_EQ(study.name, "a");
  EXPECT_THAT(study.cases, ElementsAre(files.folder()));
  EXPECT_EQ(study.series.size(), 1U);
  EXPECT_EQ(study.repeats, 1);
  EXPECT_EQ(study.threads, 1);
  EXPECT_TRUE(std::isinf(study.longest));
  EXPECT_FALSE(study.error || study.refine || study.map);
}

TEST(ReadStudy, reads_every_key) {
  const StudyCase files(
      "[study]\n"
      "name = \"full\"\n"
      "cases = [\".\", \"../b\"]\n"
      "variant = \"stiff\"\n"
      "repeats = 3\n"
      "threads = 2\n"
      "timeout = \"2 min\"\n"
      "force = true\n"
      "set = { micro.cells = 4, \"output.trajectory\" = false }\n"
      "skip = [{ \"micro.nodes\" = 40 }]\n"
      "[error]\n"
      "figure = \"f\"\n"
      "against = \"finest\"\n"
      "series = \"two\"\n"
      "[[series]]\n"
      "name = \"one\"\n"
      "values = [\"1 us\"]\n"
      "together = { \"micro.nodes\" = [20] }\n"
      "[[series]]\n"
      "name = \"two\"\n"
      "[refine]\n"
      "key = \"micro.time_step\"\n"
      "values = [\"4 us\", \"2 us\"]\n"
      "together = { \"micro.nodes\" = [20, 40] }\n"
      "[[sweep]]\n"
      "key = \"fluid.hematocrit\"\n"
      "values = [0.1]\n"
      "[map]\n"
      "key = \"micro.membrane.stretch_modulus\"\n"
      "stable = \"1 uN/m\"\n"
      "unstable = 1e-3\n"
      "tolerance = \"5 %\"\n"
      "predicted = \"limit\"\n"
      "along = { key = \"micro.nodes\", values = [20, 40] }\n");
  const Study study = files.read();
  EXPECT_THAT(study.cases, ElementsAre(files.folder() / ".", files.folder() / "../b"));
  EXPECT_EQ(study.variant, "stiff");
  EXPECT_EQ(study.repeats, 3);
  EXPECT_EQ(study.threads, 2);
  EXPECT_EQ(study.longest, 120);
  EXPECT_TRUE(study.force);
  ASSERT_EQ(study.set.size(), 2U);
  EXPECT_EQ(override_text(study.set[0]), "micro.cells=4");
  EXPECT_EQ(override_text(study.set[1]), "output.trajectory=false");
  ASSERT_EQ(study.skip.size(), 1U);
  EXPECT_EQ(override_text(study.skip[0].matches.at(0)), "micro.nodes=40");
  EXPECT_EQ(study.error->against, ErrorMeasure::Against::finest);
  EXPECT_EQ(study.error->series, "two");
  ASSERT_EQ(study.series.size(), 2U);
  ASSERT_EQ(study.series[0].refine->steps.size(), 1U);
  EXPECT_EQ(override_text(study.series[0].refine->steps[0].at(1)), "micro.nodes=20");
  ASSERT_EQ(study.refine->steps.size(), 2U);
  EXPECT_EQ(override_text(study.refine->steps[1].at(0)), "micro.time_step=\"2 us\"");
  EXPECT_EQ(override_text(study.refine->steps[1].at(1)), "micro.nodes=40");
  EXPECT_EQ(study.sweeps.at(0).key, "fluid.hematocrit");
  EXPECT_DOUBLE_EQ(study.map->stable, 1e-6);
  EXPECT_DOUBLE_EQ(study.map->unstable, 1e-3);
  EXPECT_DOUBLE_EQ(study.map->tolerance, 0.05);
  EXPECT_EQ(study.map->unit, "N/m");
  EXPECT_EQ(study.map->along->steps.size(), 2U);
}

TEST(ReadStudy, tells_all_faults_with_their_places) {
  EXPECT_THAT(faults_of("[study]\n"
                        "nam = \"a\"\n"
                        "repeats = 0\n"
                        "timeout = \"1 m\"\n"
                        "set = 3\n"
                        "[error]\n"
                        "against = 0\n"
                        "[refine]\n"
                        "key = \"micro.time_step\"\n"
                        "values = []\n"
                        "[maps]\n"),
              ElementsAre("1 study.name", "2 study.nam", "3 study.repeats", "4 study.timeout",
                          "5 study.set", "6 error.figure", "7 error.against", "10 refine.values",
                          "11 maps"));
}

TEST(ReadStudy, names_the_nearest_known_key) {
  EXPECT_THAT(complaint_of("[study]\nname = \"a\"\nrepeat = 2\n"), HasSubstr("nearest is repeats"));
  EXPECT_THAT(complaint_of("[studdy]\nname = \"a\"\n"), HasSubstr("nearest is study"));
}

TEST(ReadStudy, refuses_what_contradicts_itself) {
  const std::string head = "[study]\nname = \"a\"\n";
  EXPECT_THAT(complaint_of(head + "case = \".\"\ncases = [\".\"]\n"), HasSubstr("keep one"));
  EXPECT_THAT(complaint_of(head + "[error]\nfigure = \"f\"\nagainst = \"finest\"\n"),
              HasSubstr("needs [refine]"));
  EXPECT_THAT(complaint_of(head + "[error]\nfigure = \"f\"\nseries = \"b\"\n"),
              HasSubstr("no series of the name"));
  EXPECT_THAT(complaint_of(head + "[[series]]\nname = \"b\"\n[[series]]\nname = \"b\"\n"),
              HasSubstr("earlier series"));
  EXPECT_THAT(complaint_of(head + "[[series]]\nname = \"b\"\nvalues = [1]\n"),
              HasSubstr("[refine]"));
  EXPECT_THAT(complaint_of(head + "[refine]\nkey = \"micro.nodes\"\nvalues = [1, 2]\n"
                                  "together = { \"micro.cells\" = [1] }\n"),
              HasSubstr("as many values"));
  EXPECT_THAT(complaint_of(head + "[refine]\nkey = \"micro.nodes\"\nvalues = [1]\n"
                                  "[[sweep]]\nkey = \"micro.nodes\"\nvalues = [2]\n"),
              HasSubstr("axis already"));
  EXPECT_THAT(complaint_of(head + "[map]\nkey = \"micro.nodes\"\nstable = 1\nunstable = 2\n"),
              HasSubstr("not a quantity"));
  EXPECT_THAT(complaint_of(head + "[map]\nkey = \"micro.tme_step\"\nstable = 1\nunstable = 2\n"),
              HasSubstr("not a key"));
  EXPECT_THAT(complaint_of(head + "[map]\nkey = \"micro.time_step\"\nstable = 1\nunstable = 1\n"),
              HasSubstr("equals"));
  EXPECT_THAT(complaint_of(head + "[map]\nkey = \"micro.time_step\"\nstable = 0\nunstable = 1\n"),
              HasSubstr("out of range"));
}

TEST(ReadStudy, name_becomes_a_folder_and_must_be_plain) {
  EXPECT_THAT(faults_of("[study]\nname = \"../a\"\n"), ElementsAre("2 study.name"));
}

TEST(ReadStudy, tells_what_it_looked_for) {
  const StudyCase files("");
  std::filesystem::remove(files.folder() / "study.toml");
  EXPECT_THAT(complaint([&] { files.read(); }), HasSubstr("study.toml"));
  EXPECT_THAT(complaint([&] { read_study(files.folder() / "absent"); }), HasSubstr("no such"));
}

}  // namespace
}  // namespace hemoscale::coupling
