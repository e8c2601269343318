#include "coupling/study/plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "coupling/config/overrides.hpp"
#include "tests/unit/study/study_case.hpp"

namespace hemoscale::coupling {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const std::string head = "[study]\nname = \"a\"\n";
const std::string refine =
    "[refine]\nkey = \"micro.time_step\"\nvalues = [\"4 us\", \"2 us\", \"1 us\"]\n";
const std::string sweeps =
    "[[sweep]]\nkey = \"micro.nodes\"\nvalues = [20, 24]\n"
    "[[sweep]]\nkey = \"micro.membrane.bending_law\"\nvalues = [\"turning-angle\", "
    "\"half-angle-tangent\"]\n";

Plan plan_of(const std::string& text) {
  return plan_chart(StudyCase(text).read());
}

std::vector<std::string> names_of(const Plan& plan) {
  std::vector<std::string> names;
  for (const Curve& curve : plan.curves) names.push_back(curve.name);
  return names;
}

std::vector<std::string> settings_of(const PlannedRun& run) {
  std::vector<std::string> texts;
  for (const Override& setting : run.overrides) texts.push_back(override_text(setting));
  return texts;
}

TEST(Plan, combines_series_sweeps_and_refinement) {
  const Plan plan = plan_of(head + refine + sweeps +
                            "[[series]]\nname = \"a\"\n[[series]]\nname = \"b\"\n"
                            "set = { \"micro.cells\" = 6 }\n");
  EXPECT_THAT(plan.swept_keys, ElementsAre("micro.nodes", "micro.membrane.bending_law"));
  EXPECT_THAT(
      names_of(plan),
      ElementsAre(
          "a, nodes 20, bending_law turning-angle", "a, nodes 20, bending_law half-angle-tangent",
          "a, nodes 24, bending_law turning-angle", "a, nodes 24, bending_law half-angle-tangent",
          "b, nodes 20, bending_law turning-angle", "b, nodes 20, bending_law half-angle-tangent",
          "b, nodes 24, bending_law turning-angle", "b, nodes 24, bending_law half-angle-tangent"));
  EXPECT_EQ(plan.refinement_unit, "s");
  std::set<std::string> identities;
  for (const Curve& curve : plan.curves) {
    ASSERT_EQ(curve.points.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_DOUBLE_EQ(curve.points[i].refinement, 4e-6 / std::pow(2.0, static_cast<double>(i)));
      identities.insert(curve.points[i].run.identity);
    }
  }
  EXPECT_EQ(identities.size(), 24U);
  EXPECT_THAT(
      settings_of(plan.curves.back().points.back().run),
      ElementsAre("micro.cells=6", "micro.nodes=24",
                  "micro.membrane.bending_law=\"half-angle-tangent\"", "micro.time_step=\"1 us\""));
}

TEST(Plan, without_axes_is_one_run) {
  const Plan plan = plan_of(head);
  ASSERT_EQ(plan.curves.size(), 1U);
  ASSERT_EQ(plan.curves[0].points.size(), 1U);
  EXPECT_TRUE(std::isnan(plan.curves[0].points[0].refinement));
  EXPECT_EQ(plan.curves[0].points[0].run.label, "a");
}

TEST(Plan, later_settings_replace_earlier_ones) {
  const Plan plan = plan_of(head + "set = { \"micro.cells\" = 5, \"micro.nodes\" = 30 }\n" +
                            "[[series]]\nname = \"s\"\nset = { \"micro.cells\" = 6 }\n" + sweeps);
  EXPECT_THAT(settings_of(plan.curves[0].points[0].run),
              ElementsAre("micro.cells=6", "micro.nodes=20",
                          "micro.membrane.bending_law=\"turning-angle\""));
}

TEST(Plan, a_series_may_have_its_own_refinement) {
  const Plan plan = plan_of(head + refine +
                            "[[series]]\nname = \"s\"\nvalues = [\"3 us\"]\n"
                            "together = { \"micro.nodes\" = [16] }\n");
  ASSERT_EQ(plan.curves[0].points.size(), 1U);
  EXPECT_THAT(settings_of(plan.curves[0].points[0].run),
              ElementsAre("micro.time_step=\"3 us\"", "micro.nodes=16"));
}

TEST(Plan, leaves_out_what_is_to_be_skipped) {
  const Plan plan = plan_of(
      head +
      "skip = [{ \"micro.nodes\" = 20, \"micro.membrane.bending_law\" = \"half-angle-tangent\" "
      "}]\n" +
      refine + sweeps + "[[series]]\nname = \"s\"\nskip = [{ \"micro.time_step\" = \"1 us\" }]\n");
  EXPECT_THAT(names_of(plan), ElementsAre("s, nodes 20, bending_law turning-angle",
                                          "s, nodes 24, bending_law turning-angle",
                                          "s, nodes 24, bending_law half-angle-tangent"));
  for (const Curve& curve : plan.curves) EXPECT_EQ(curve.points.size(), 2U);
}

TEST(Plan, a_skip_that_matches_nothing_is_a_mistake) {
  const StudyCase files(head + "skip = [{ \"micro.nodes\" = 21 }]\n" + sweeps);
  EXPECT_THAT(complaint([&] { plan_chart(files.read()); }),
              HasSubstr("micro.nodes=21 is no combination"));
}

TEST(Plan, several_cases_are_an_axis) {
  const StudyCase files(head + "cases = [\".\", \"other\"]\n");
  std::filesystem::create_directory(files.folder() / "other");
  std::filesystem::copy(files.folder() / "case.toml", files.folder() / "other");
  const Plan plan = plan_chart(files.read());
  EXPECT_THAT(plan.swept_keys, ElementsAre("case"));
  ASSERT_EQ(plan.curves.size(), 2U);
  EXPECT_EQ(plan.curves[1].swept.at(0), "other");
  EXPECT_EQ(plan.curves[1].points[0].run.case_folder, files.folder() / "other");
}

TEST(Plan, faults_of_all_runs_stand_where_the_study_has_them) {
  const StudyCase files(head +
                        "set = { \"micro.cels\" = 3 }\n"
                        "[[sweep]]\nkey = \"fluid.hematocrit\"\nvalues = [0.1, 3, \"x\"]\n" +
                        refine);
  EXPECT_THAT(fault_places([&] { plan_chart(files.read()); }),
              ElementsAre("3 micro.cels", "6 fluid.hematocrit", "6 fluid.hematocrit"));
}

TEST(Plan, a_run_beyond_a_limit_is_refused_unless_forced) {
  const std::string text = "[[sweep]]\nkey = \"micro.time_step\"\nvalues = [\"1 ms\"]\n";
  EXPECT_THAT(complaint([&] { plan_of(head + text); }), HasSubstr("exceeds the limit"));
  EXPECT_EQ(plan_of(head + "force = true\n" + text).curves.size(), 1U);
}

TEST(Plan, refinement_must_be_a_number) {
  EXPECT_THAT(
      complaint([] {
        plan_of(head +
                "[refine]\nkey = \"micro.membrane.bending_law\"\nvalues = [\"turning-angle\"]\n");
      }),
      HasSubstr("[[sweep]]"));
}

TEST(Plan, identity_stands_for_settings_and_threads_not_for_words) {
  const auto identity = [](const std::string& more) {
    return plan_of(head + more).curves.at(0).points.at(0).run.identity;
  };
  const std::string four = identity("set = { \"micro.time_step\" = \"4 us\" }\n");
  EXPECT_EQ(identity("set = { \"micro.time_step\" = 4e-6 }\n"), four);
  EXPECT_EQ(identity("set = { \"micro.time_step\" = \"4 us\" }\nrepeats = 2\n"), four);
  EXPECT_NE(identity("set = { \"micro.time_step\" = \"3 us\" }\n"), four);
  EXPECT_NE(identity("set = { \"micro.time_step\" = \"4 us\" }\nthreads = 2\n"), four);
}

TEST(MapPlan, probes_are_forced_and_set_the_key) {
  const StudyCase files(head + sweeps +
                        "[map]\nkey = \"micro.time_step\"\nstable = \"1 us\"\nunstable = \"1 s\"\n"
                        "along = { key = \"micro.membrane.stretch_modulus\", "
                        "values = [\"1e-5 N/m\", 2e-5] }\n");
  const Study study = files.read();
  const MapPlan plan = plan_map(study);
  ASSERT_EQ(plan.curves.size(), 4U);
  EXPECT_THAT(plan.curves[0].abscissas, ElementsAre(1e-5, 2e-5));
  EXPECT_THAT(plan.curves[0].along_texts, ElementsAre("1e-5 N/m", "2e-05"));
  const PlannedRun run = probe(study, plan.curves[3], 1, 0.125);
  EXPECT_TRUE(run.force);
  EXPECT_THAT(settings_of(run),
              ElementsAre("micro.nodes=24", "micro.membrane.bending_law=\"half-angle-tangent\"",
                          "micro.membrane.stretch_modulus=2e-05", "micro.time_step=0.125"));
}

TEST(MapPlan, is_checked_at_both_ends) {
  const StudyCase files(head +
                        "[map]\nkey = \"fluid.hematocrit\"\nstable = 0.1\nunstable = 0.2\n"
                        "along = { key = \"micro.nodes\", values = [24, 1] }\n");
  EXPECT_THAT(fault_places([&] { plan_map(files.read()); }), ElementsAre("7 micro.nodes"));
}

}  // namespace
}  // namespace hemoscale::coupling
