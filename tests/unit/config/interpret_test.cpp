#include "coupling/config/interpret.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/config/case_text.hpp"

namespace hemoscale::coupling {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// The only fault of a case; a failure if there is not exactly one.
Fault fault_of(const std::string& text, const std::string& variant = "") {
  const std::vector<Fault> faults = faults_of(text, variant);
  EXPECT_EQ(faults.size(), 1U) << CaseError(faults).what();
  return faults.empty() ? Fault{} : faults.front();
}

TEST(Interpret, fills_in_defaults_in_si) {
  const Settings settings = settings_of(smallest_case);
  EXPECT_EQ(settings.text("case.name"), "a");
  EXPECT_EQ(settings.quantity("macro.channel.height"), 80e-6);
  EXPECT_TRUE(settings.was_given("macro.channel.height"));
  EXPECT_EQ(settings.location("macro.channel.height").line, 3);
  EXPECT_EQ(settings.quantity("fluid.plasma_viscosity"), 1.2e-3);
  EXPECT_FALSE(settings.was_given("fluid.plasma_viscosity"));
  EXPECT_EQ(settings.location("fluid.plasma_viscosity").line, 0);
  EXPECT_EQ(settings.integer("micro.cells"), 24);
  EXPECT_TRUE(settings.boolean("coupling.shear_thinning"));
  EXPECT_EQ(settings.quantity("micro.drag.coefficient"), 12);
  EXPECT_FALSE(settings.has("micro.time_step"));
  EXPECT_FALSE(settings.has("law.casson.viscosity"));
  EXPECT_TRUE(settings.has("law.newtonian.viscosity"));
}

TEST(Interpret, reports_all_faults_in_file_order) {
  const std::string text =
      "[case]\n"                       // 1
      "name = \"a b\"\n"               // 2 not a name
      "sede = 1\n"                     // 3 unknown
      "[fluid]\n"                      // 4
      "hematocrit = 0.9\n"             // 5 out of range
      "density = \"1050 m\"\n"         // 6 wrong unit
      "[macro.channel]\n"              // 7 mean_velocity missing
      "height = true\n"                // 8 wrong type
      "[macro.openfoam]\n"             // 9
      "ranks = 2\n"                    // 10 does not apply
      "[coupling]\n"                   // 11
      "scheme = \"explicitt\"\n"       // 12 unknown choice
      "relaxation_factor = nan\n"      // 13 not finite
      "[micro]\n"                      // 14
      "contact.cutoff = \"0.1 um\"\n"  // 15 below the rest distance
      "[micro.membrnae]\n"             // 16 unknown section
      "x = 1\n";
  const std::vector<Fault> faults = faults_of(text);
  EXPECT_THAT(places_of(faults),
              ElementsAre("2:8 case.name", "3:8 case.sede", "5:14 fluid.hematocrit",
                          "6:11 fluid.density", "7:8 macro.channel.mean_velocity",
                          "8:10 macro.channel.height", "10:9 macro.openfoam.ranks",
                          "12:10 coupling.scheme", "13:21 coupling.relaxation_factor",
                          "15:18 micro.contact.cutoff", "16:8 micro.membrnae"));
  const std::string what = CaseError(faults).what();
  EXPECT_EQ(std::count(what.begin(), what.end(), '\n'), 10);
  EXPECT_THAT(what, HasSubstr("case.toml:5:14: fluid.hematocrit: 0.9 is out of range; allowed is 0 "
                              "to 0.75\n"));
}

TEST(Interpret, names_the_nearest_key) {
  EXPECT_THAT(fault_of(smallest_case + "coupling.tolerence = 0.1\n").message,
              HasSubstr("nearest known key is coupling.tolerance"));
  EXPECT_THAT(fault_of(smallest_case + "fluid.mean_velocity = 1\n").message,
              HasSubstr("exists as macro.channel.mean_velocity and micro.mean_velocity"));
  EXPECT_THAT(fault_of(smallest_case + "case.sede = 1\n").key, "case.sede");
}

TEST(Interpret, a_misspelled_required_key_is_one_fault) {
  const std::string text =
      "case.name = \"a\"\nfluid.hematocrti = 0.4\nmacro.channel.height = 1e-4\n"
      "macro.channel.mean_velocity = 1\n";
  EXPECT_EQ(fault_of(text).key, "fluid.hematocrti");
  // An unknown key far from the missing one does not hide it.
  EXPECT_EQ(faults_of("case.nothing_at_all = 1\n").size(), 5U);
}

TEST(Interpret, an_empty_case_misses_what_is_required) {
  const std::vector<Fault> faults = faults_of("");
  EXPECT_THAT(places_of(faults),
              ElementsAre("0:0 case.name", "0:0 fluid.hematocrit", "0:0 macro.channel.height",
                          "0:0 macro.channel.mean_velocity"));
  EXPECT_THAT(faults[2].message, HasSubstr("needed when macro.model = channel"));
  EXPECT_THAT(faults[2].message, HasSubstr("Write height = \"10 um\" in [macro.channel]"));
}

TEST(Interpret, a_default_may_hold_for_one_choice_only) {
  const Fault fault = fault_of(smallest_case + "micro.drag.convention = \"node\"\n");
  EXPECT_EQ(fault.key, "micro.drag.coefficient");
  EXPECT_THAT(fault.message, HasSubstr("default only when micro.drag.convention = cell"));
  EXPECT_EQ(settings_of(smallest_case + "micro.drag = {convention = \"node\", coefficient = 0.3}\n")
                .quantity("micro.drag.coefficient"),
            0.3);
}

TEST(Interpret, sections_and_values_are_not_confused) {
  EXPECT_THAT(fault_of(smallest_case + "micro.membrane = 1\n").message, HasSubstr("is a section"));
  EXPECT_THAT(fault_of(smallest_case + "[fluid.density]\nx = 1\n").message,
              HasSubstr("a section is not what belongs here"));
  EXPECT_THAT(fault_of(smallest_case + "[[micro]]\ncells = 2\n").message,
              HasSubstr("is a section"));
  EXPECT_THAT(fault_of(smallest_case + "\"micro.cells\" = 2\n").message,
              HasSubstr("without quotes"));
  EXPECT_THAT(fault_of(smallest_case + "\"\" = 2\n").message, HasSubstr("not a known key"));
  EXPECT_THAT(fault_of("variant = 1\n" + smallest_case).message, HasSubstr("[variant.NAME]"));
  EXPECT_THAT(fault_of("variant.a = 1\n" + smallest_case).message, HasSubstr("[variant.a]"));
}

TEST(Interpret, keys_given_twice) {
  ParameterTree tree = tree_of(smallest_case);
  tree.children.push_back(tree.children.front());
  try {
    interpret(tree, "");
    ADD_FAILURE();
  } catch (const CaseError& error) {
    ASSERT_EQ(error.faults().size(), 1U);
    EXPECT_THAT(error.faults()[0].message, HasSubstr("given twice"));
  }
}

TEST(Interpret, words_of_an_openfoam_dictionary) {
  const Settings settings = settings_of(
      "case.name = \"a\"\nfluid.hematocrit = \"0.4\"\nmicro.cells = \"30\"\n"
      "macro = {model = \"openfoam\", openfoam = {case = \".\"}}\n"
      "coupling = {shear_thinning = \"off\", interval = \"1e2\", tolerance = \"1e-3\"}\n"
      "sampling.points = [[\"1e-6\", \"2\", \"3 mm\"]]\n");
  EXPECT_EQ(settings.quantity("fluid.hematocrit"), 0.4);
  EXPECT_EQ(settings.integer("micro.cells"), 30);
  EXPECT_FALSE(settings.boolean("coupling.shear_thinning"));
  EXPECT_EQ(settings.integer("coupling.interval"), 100);
  EXPECT_EQ(settings.points("sampling.points")[0], Eigen::Vector3d(1e-6, 2, 3e-3));
}

TEST(Interpret, pairs_of_keys_are_ordered) {
  const std::string cutoff = "micro.contact.cutoff = ";
  EXPECT_THAT(faults_of(smallest_case + cutoff + "0.51e-6\n"), IsEmpty());
  EXPECT_THAT(fault_of(smallest_case + cutoff + "0.5e-6\n").message,
              HasSubstr("must exceed micro.contact.rest_distance"));
  // The fault stands where the user wrote something.
  EXPECT_EQ(fault_of(smallest_case + "micro.contact.rest_distance = 1e-6\n").line, 6);
  const std::string longest = "micro.run.maximum_strain = ";
  EXPECT_THAT(faults_of(smallest_case + longest + "20\n"), IsEmpty());
  EXPECT_THAT(fault_of(smallest_case + longest + "19.9\n").message, HasSubstr("at least"));
}

TEST(Applies, a_key_of_another_choice_is_a_fault) {
  const Fault fault = fault_of(smallest_case + "law.casson.viscosity = 1e-3\n");
  EXPECT_EQ(fault.line, 6);
  EXPECT_THAT(fault.message, HasSubstr("because law.initial = newtonian; it applies when "
                                       "law.initial = casson"));
  EXPECT_EQ(fault_of(smallest_case + "macro.channel.pressure_gradient = 1\n").key,
            "macro.channel.pressure_gradient");
}

TEST(Applies, conditions_are_inherited) {
  // macro.model does not apply in a micro scene, so nothing that depends on it does.
  const std::string text =
      "case.name = \"a\"\nfluid.hematocrit = 0.4\nscene.kind = \"micro\"\n"
      "micro = {shear_rate = 100, duration = 1, output_interval = 0.1}\n";
  EXPECT_FALSE(settings_of(text).has("macro.model"));
  EXPECT_FALSE(settings_of(text).has("macro.channel.height"));
  EXPECT_THAT(fault_of(text + "macro.channel.drive = \"mean-velocity\"\n").message,
              HasSubstr("because scene.kind = micro"));
}

TEST(Applies, a_key_that_is_given_can_switch_another_off) {
  const std::string points = "sampling.points = [[0, 1e-6, 0]]\n";
  EXPECT_FALSE(settings_of(smallest_case + points).has("sampling.across"));
  EXPECT_THAT(fault_of(smallest_case + points + "sampling.across = 3\n").message,
              HasSubstr("because sampling.points is given; it applies when"));
}

TEST(Applies, nothing_is_said_of_keys_that_hang_on_a_faulty_choice) {
  const std::string text =
      "case.name = \"a\"\nfluid.hematocrit = 0.4\nmacro.model = \"chanel\"\n"
      "macro.openfoam.ranks = 2\n";
  EXPECT_EQ(fault_of(text).key, "macro.model");
}

const std::string with_variants = smallest_case +
                                  "[variant.foam.macro]\n"      // 6
                                  "model = \"openfoam\"\n"      // 7
                                  "openfoam.case = \"foam\"\n"  // 8
                                  "[variant.fine]\n"            // 9
                                  "micro.nodes = 80\n";         // 10

TEST(Variant, replaces_keys_of_the_case) {
  EXPECT_EQ(settings_of(with_variants).integer("micro.nodes"), 40);
  EXPECT_EQ(settings_of(with_variants, "fine").integer("micro.nodes"), 80);
  EXPECT_EQ(settings_of(with_variants, "fine").quantity("macro.channel.height"), 80e-6);
  EXPECT_EQ(settings_of(with_variants, "fine").location("micro.nodes").line, 10);
  EXPECT_THAT(variant_names(tree_of(with_variants)), ElementsAre("foam", "fine"));
  EXPECT_THAT(variant_names(tree_of(smallest_case)), IsEmpty());
}

TEST(Variant, keys_of_the_case_rest_when_the_variant_switches_the_model) {
  const Settings settings = settings_of(with_variants, "foam");
  EXPECT_EQ(settings.text("macro.openfoam.case"), "foam");
  EXPECT_FALSE(settings.has("macro.channel.height"));
  EXPECT_FALSE(settings.was_given("macro.channel.height"));
}

TEST(Variant, its_own_keys_must_apply) {
  const std::string text = with_variants + "[variant.bad.macro]\nopenfoam.ranks = 2\n";
  EXPECT_THAT(faults_of(text), IsEmpty());  // not chosen
  const Fault fault = fault_of(text, "bad");
  EXPECT_EQ(fault.key, "variant.bad.macro.openfoam.ranks");
  EXPECT_EQ(fault.line, 12);
}

TEST(Variant, a_key_of_the_case_may_wait_for_a_variant) {
  const std::string text = smallest_case +
                           "macro.openfoam.case = \"foam\"\n"
                           "[variant.foam]\n"
                           "macro.model = \"openfoam\"\n"
                           "[variant.fine]\n"
                           "micro.nodes = 80\n";
  EXPECT_EQ(settings_of(text, "foam").text("macro.openfoam.case"), "foam");
  EXPECT_EQ(fault_of(text).key, "macro.openfoam.case");
  EXPECT_EQ(fault_of(text, "fine").key, "macro.openfoam.case");
}

TEST(Variant, misses_what_its_choice_requires) {
  const std::string text = smallest_case + "[variant.foam.macro]\nmodel = \"openfoam\"\n";
  const Fault fault = fault_of(text, "foam");
  EXPECT_EQ(fault.key, "macro.openfoam.case");
  EXPECT_EQ(fault.line, 3);  // the section [macro] of the case
}

TEST(Variant, all_are_checked_key_by_key) {
  const std::string text = with_variants + "[variant.other]\nmicro.nodes = 1\nmicro.noeds = 9\n";
  EXPECT_THAT(places_of(faults_of(text)),
              ElementsAre("12:15 variant.other.micro.nodes", "13:15 variant.other.micro.noeds"));
  EXPECT_EQ(faults_of(text, "fine").size(), 2U);
}

TEST(Variant, a_faulty_value_of_the_case_is_reported_though_a_variant_replaces_it) {
  const std::string text = with_variants + "[micro]\nnodes = 1\n";
  EXPECT_EQ(fault_of(text, "fine").key, "micro.nodes");
}

TEST(Variant, the_case_may_name_its_own) {
  EXPECT_EQ(settings_of("case.variant = \"fine\"\n" + with_variants).integer("micro.nodes"), 80);
  EXPECT_TRUE(
      settings_of("case.variant = \"fine\"\n" + with_variants, "foam").has("macro.openfoam.case"));
  const Fault fault = fault_of("case.variant = \"fien\"\n" + with_variants);
  EXPECT_EQ(fault.line, 1);
  EXPECT_THAT(fault.message, HasSubstr("the case has foam, fine"));
  EXPECT_EQ(fault_of(with_variants + "case.variant = \"foam\"\n").key, "variant.fine.case.variant");
}

TEST(Variant, unknown_names_list_the_known) {
  EXPECT_THAT(fault_of(with_variants, "nope").message,
              HasSubstr("no variant \"nope\"; the case has foam, fine"));
  EXPECT_THAT(fault_of(smallest_case, "nope").message, HasSubstr("the case has no variants"));
}

TEST(Interpret, works_with_any_table) {
  const std::vector<Parameter> table = {
      {.key = "a.lengths", .kind = ParameterKind::quantity_list, .unit = "m", .required = true}};
  const Settings settings = interpret(tree_of("a.lengths = [\"1 um\", 2]\n"), "", table);
  EXPECT_EQ(settings.quantities("a.lengths"), (std::vector<double>{1e-6, 2}));
}

}  // namespace
}  // namespace hemoscale::coupling
