#include "coupling/config/overrides.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/study/study_case.hpp"

namespace hemoscale::coupling {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Settings with(const std::vector<std::string>& texts, const std::string& variant = "") {
  const StudyCase files("");
  return interpret(read_toml(files.folder() / "case.toml"), variant, parse_overrides(texts));
}

std::string kind_of(const std::string& text) {
  const ParameterTree value = parse_override("k=" + text).value;
  if (value.kind == ParameterTree::Kind::list) return "list";
  if (value.kind == ParameterTree::Kind::table) return "table";
  return std::vector<std::string>{"boolean", "integer", "real", "text"}[value.scalar.index()];
}

TEST(Overrides, value_is_toml_where_it_is_toml_and_text_otherwise) {
  EXPECT_EQ(kind_of("3"), "integer");
  EXPECT_EQ(kind_of("1e-3"), "real");
  EXPECT_EQ(kind_of("true"), "boolean");
  EXPECT_EQ(kind_of("\"10 um\""), "text");
  EXPECT_EQ(kind_of("[1, 2]"), "list");
  for (const std::string bare : {"10 um", "cell", "1/s", "1\nother = 2", "\"half", "-", ""}) {
    const ParameterTree value = parse_override("k=" + bare).value;
    ASSERT_EQ(kind_of(bare), "text") << bare;
    EXPECT_EQ(std::get<std::string>(value.scalar), bare);
  }
}

TEST(Overrides, text_survives_the_way_to_a_child_process) {
  for (const std::string text : {"3", "-1.5e-300", "1.0", "true", "\"a \\\"quoted\\\" \\\\ word\"",
                                 "[1, [2.5, \"x\"]]", "\"line\\nend\\u0007\"", "inf"}) {
    const Override first = parse_override("a.b=" + text);
    const Override second = parse_override(override_text(first));
    EXPECT_EQ(second.key, "a.b");
    EXPECT_EQ(toml_text(second.value), toml_text(first.value)) << text;
    EXPECT_EQ(second.value.scalar, first.value.scalar) << text;
  }
}

TEST(Overrides, replace_case_and_variant_and_count_as_given) {
  const Settings settings =
      with({"micro.cells=6", "micro.membrane.stretch_modulus=3e-5 N/m"}, "stiff");
  EXPECT_EQ(settings.integer("micro.cells"), 6);
  EXPECT_DOUBLE_EQ(settings.quantity("micro.membrane.stretch_modulus"), 3e-5);
  EXPECT_TRUE(settings.was_given("micro.membrane.stretch_modulus"));
  EXPECT_EQ(settings.location("micro.cells").file, "--set micro.cells");
  EXPECT_EQ(with({}, "stiff").quantity("micro.membrane.stretch_modulus"), 2e-5);
}

TEST(Overrides, switch_models_as_a_variant_would) {
  // The shear rate of the case rests; what the channel needs is asked for.
  EXPECT_THAT(complaint([] { with({"micro.domain=channel"}); }), HasSubstr("micro.channel.height"));
  const Settings channel =
      with({"micro.domain=channel", "micro.channel.height=40 um", "micro.mean_velocity=1 mm/s"});
  EXPECT_FALSE(channel.has("micro.shear_rate"));
  EXPECT_EQ(channel.quantity("micro.channel.height"), 40e-6);
}

TEST(Overrides, faults_name_the_option_and_all_are_told) {
  const std::string text = complaint([] {
    with({"micro.cells=0", "micro.nods=3", "micro.shear_rate=1 m"});
  });
  EXPECT_THAT(text, HasSubstr("--set micro.cells: "));
  EXPECT_THAT(text, HasSubstr("nearest known key is micro.nodes"));
  EXPECT_THAT(text, HasSubstr("--set micro.shear_rate: "));
}

TEST(Overrides, key_that_does_not_apply_is_refused) {
  EXPECT_THAT(complaint([] { with({"micro.channel.height=40 um"}); }), HasSubstr("does not apply"));
}

TEST(Overrides, what_no_case_could_hold_is_refused) {
  EXPECT_THAT(complaint([] { parse_overrides({"micro.cells", "=3"}); }), HasSubstr("KEY=VALUE"));
  EXPECT_THAT(complaint([] { with({"case.variant=stiff"}); }), HasSubstr("--variant"));
  EXPECT_THAT(complaint([] { with({"variant.stiff.micro.cells=3"}); }), HasSubstr("variant"));
  EXPECT_THAT(complaint([] { with({"micro.cells=3", "micro.cells=4"}); }), HasSubstr("twice"));
  EXPECT_THAT(complaint([] { with({"micro=3"}); }), HasSubstr("is a section"));
  EXPECT_THAT(complaint([] { with({"micro.cells.x=3"}); }), HasSubstr("micro.cells"));
  std::string deep = "a";
  for (int i = 0; i < 30000; ++i) deep += ".a";
  deep += "=3";
  EXPECT_THAT(complaint([&] { with({deep}); }), HasSubstr("longer"));
}

}  // namespace
}  // namespace hemoscale::coupling
