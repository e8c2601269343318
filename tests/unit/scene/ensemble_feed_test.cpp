// A vessel through which cells pass: faults of its case, and how its cells are counted.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "coupling/scene/build_micro.hpp"
#include "coupling/scene/case_checks.hpp"
#include "coupling/scene/feed_results.hpp"
#include "micro/cells/outline.hpp"
#include "micro/error.hpp"

#include "tests/unit/config/case_text.hpp"

namespace hemoscale::coupling {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A valid case, with a text in it replaced.
std::string case_with(const std::string& before = "", const std::string& after = "") {
  std::string text =
      "case.name = \"a\"\nscene.kind = \"micro\"\nfluid.hematocrit = 0.2\n[micro]\n"
      "domain = \"geometry\"\nduration = \"1 s\"\noutput_interval = \"1 s\"\n"
      "[micro.flow]\nkind = \"openfoam\"\ncase = \".\"\ninlet = \"in\"\noutlets = \"out\"\n";
  if (before.empty()) return text;
  const std::size_t place = text.find(before);
  if (place == std::string::npos) throw std::invalid_argument("there is no " + before);
  return text.replace(place, before.size(), after);
}

/// "key: message" of all faults, those of reading or those of checking.
std::string faults(const std::string& text) {
  std::vector<Fault> found = faults_of(text);
  if (found.empty()) found = find_faults(settings_of(text), false);
  std::string lines;
  for (const Fault& fault : found) lines += fault.key + ": " + fault.message + "\n";
  return lines;
}

TEST(FeedCase, that_is_complete_has_no_fault) {
  EXPECT_EQ(faults(case_with()), "");
  EXPECT_EQ(build_ensemble_parameters(settings_of(case_with()), 1, false).cells, 1);
}

TEST(FeedCase, does_not_know_what_only_closed_domains_have) {
  const auto with = [](const std::string& key) {
    return faults(case_with("duration", key + "\nduration"));
  };
  EXPECT_THAT(with("cells = 5"), HasSubstr("micro.cells: does not apply"));
  EXPECT_THAT(with("aspect_ratio = 2"), HasSubstr("micro.aspect_ratio: does not apply"));
  EXPECT_THAT(with("packing.kind = \"lattice\""), HasSubstr("micro.packing.kind: does not apply"));
  EXPECT_THAT(with("mean_velocity = \"1 mm/s\""), HasSubstr("micro.mean_velocity: does not apply"));
}

TEST(FeedCase, needs_a_flow_with_openings) {
  const std::string flow =
      "[micro.flow]\nkind = \"openfoam\"\ncase = \".\"\ninlet = \"in\"\n"
      "outlets = \"out\"\n";
  EXPECT_THAT(faults(case_with(flow, "")),
              HasSubstr("micro.flow.kind: \"poiseuille\" has no inlet"));
  EXPECT_THAT(faults(case_with("inlet = \"in\"\n", "")), HasSubstr("micro.flow.inlet"));
  EXPECT_THAT(faults(case_with("outlets = \"out\"\n", "")), HasSubstr("micro.flow.outlets"));
  EXPECT_THAT(
      faults(case_with("\"geometry\"",
                       "\"channel\"\nchannel.height = \"20 um\"\nmean_velocity = \"1 mm/s\"")),
      HasSubstr("micro.flow.kind: \"openfoam\" brings walls"));
}

TEST(FeedCase, refuses_values_that_do_not_fit) {
  const auto with = [](const std::string& line) { return faults(case_with() + line + "\n"); };
  EXPECT_THAT(with("overhang = \"3 um\""), HasSubstr("micro.flow.overhang: 3e-06 m is less than"));
  EXPECT_THAT(with("settling_time = \"1 s\""),
              HasSubstr("micro.flow.settling_time: 1 s leaves nothing of micro.duration"));
  EXPECT_THAT(with("settling_time = \"-1 s\""), HasSubstr("micro.flow.settling_time"));
  EXPECT_THAT(with("cell_free_layer = \"-1 um\""), HasSubstr("micro.flow.cell_free_layer"));
  EXPECT_THAT(faults(case_with("duration", "integrator = \"explicit-reference\"\nduration")),
              HasSubstr("micro.integrator: \"explicit-reference\" knows no walls"));
}

/// Red cells and platelets, outlets with 0.8 and 0.2 of the flow.
FeedScene two_outlets() {
  FeedScene scene;
  for (const double length : {8e-6, 2e-6}) {
    micro::OutlineParameters outline;
    outline.length = length;
    micro::blocks::KindSettings kind;
    kind.mesh =
        micro::make_ring_mesh(micro::outline_nodes(outline, 40), micro::NaturalShape::outline);
    scene.blocks.settings.kinds.push_back(kind);
  }
  scene.flow_shares = {0.8, 0.2};
  scene.inflow = 1e-7;
  return scene;
}

TEST(FeedDivision, counts_from_the_beginning_of_the_tally) {
  const FeedScene scene = two_outlets();
  FeedTally tally;
  EXPECT_TRUE(
      std::isnan(divide(scene, tally, {{9, 0, {5, 4}}, {0, 0, {0, 0}}}, 0, 1).cell_share[0]));
  tally.begin(2, {{60, 0, {20, 10}}, {6, 0, {1, 0}}});
  const std::vector<micro::FeedCounts> counts = {{200, 3, {110, 20}}, {20, 0, {4, 1}}};
  const FeedDivision red = divide(scene, tally, counts, 0, 2.5);
  EXPECT_THAT(red.counted, ElementsAre(90, 10));
  EXPECT_THAT(red.cell_share, ElementsAre(0.9, 0.1));
  EXPECT_DOUBLE_EQ(red.standard_error[0], 0.03);
  EXPECT_DOUBLE_EQ(red.partition[0], 0.9 / 0.8);
  EXPECT_DOUBLE_EQ(red.partition[1], 0.1 / 0.2);
  // In half a second 1e-8 m^2 of blood left through the lower outlet.
  const double area = scene.blocks.settings.kinds[0].mesh.rest_area;
  EXPECT_NEAR(red.discharge[1], 10 * area / 1e-8, 1e-12);
  const FeedDivision platelets = divide(scene, tally, counts, 1, 2.5);
  EXPECT_THAT(platelets.counted, ElementsAre(3, 1));
}

TEST(FeedTally, is_the_same_after_a_restart) {
  FeedTally tally;
  tally.begin(0.25, {{60, 0, {20, 10}}, {6, 0, {1, 0}}});
  FeedTally other;
  other.restore(tally.snapshot(), 2, 2);
  EXPECT_TRUE(other.has_begun);
  EXPECT_EQ(other.since, 0.25);
  EXPECT_EQ(other.before, tally.before);
  EXPECT_THROW(other.restore(tally.snapshot(), 1, 2), micro::ParameterError);
  EXPECT_THROW(other.restore({}, 2, 2), micro::ParameterError);
  other.restore(FeedTally().snapshot(), 2, 2);
  EXPECT_FALSE(other.has_begun);
}

TEST(FeedScene, knows_what_lies_beyond_an_opening) {
  FeedScene scene;
  scene.blocks.flow.openings = {{"in", {0, 1e-5}, {0, 0}}, {"out", {5e-5, 0}, {5e-5, 1e-5}}};
  scene.plan.overhang = 1e-5;
  EXPECT_TRUE(scene.is_inside({1e-6, 5e-6}));
  EXPECT_FALSE(scene.is_inside({-1e-6, 5e-6}));
  EXPECT_FALSE(scene.is_inside({5.1e-5, 5e-6}));
}

}  // namespace
}  // namespace hemoscale::coupling
