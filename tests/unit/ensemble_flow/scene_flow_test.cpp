// From the keys micro.flow to the flow that carries an ensemble.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>

#include "coupling/scene/ensemble_flow.hpp"
#include "macro/analytic/womersley.hpp"
#include "macro/error.hpp"

#include "tests/unit/config/case_text.hpp"

namespace hemoscale::coupling {
namespace {

using testing::HasSubstr;

constexpr double height = 75e-6;        // [m]
constexpr double mean_velocity = 2e-3;  // [m/s]

std::string channel_case(const std::string& more) {
  return "case.name = \"a\"\nscene.kind = \"micro\"\nfluid.hematocrit = 0.4\n[micro]\n"
         "domain = \"channel\"\nchannel.height = \"75 um\"\nmean_velocity = \"2 mm/s\"\n"
         "duration = \"1 s\"\noutput_interval = \"1 s\"\n" +
         more;
}

EnsembleFlow built(const std::string& text) {
  return build_ensemble_flow(settings_of(text), ".", ".");
}

double statement(const EnsembleFlow& flow, const std::string& text) {
  for (const auto& [name, value] : flow.statements) {
    if (name.find(text) != std::string::npos) return value;
  }
  ADD_FAILURE() << "no statement about " << text;
  return std::nan("");
}

std::string faults(const std::string& text) {
  try {
    built(text);
  } catch (const CaseError& error) {
    return error.what();
  }
  return "none";
}

TEST(EnsembleFlow, is_a_parabola_unless_said_otherwise) {
  const EnsembleFlow channel = built(channel_case(""));
  EXPECT_TRUE(channel.flow->is_steady());
  for (double s = 0; s <= 1; s += 0.05) {
    EXPECT_NEAR(channel.flow->at({0, s * height}, 0).velocity[0], 6 * mean_velocity * s * (1 - s),
                1e-13 * mean_velocity);
  }
  EXPECT_LE(statement(channel, "one expansion"), 1e-12);
  EXPECT_FALSE(channel.walls.has_value());
  EXPECT_TRUE(channel.openings.empty());
}

TEST(EnsembleFlow, pulsates_as_womersley_with_the_stated_error) {
  for (const double frequency : {1.0, 5000.0}) {
    const EnsembleFlow channel = built(channel_case(
        "flow.kind = \"womersley\"\nflow.amplitude = 0.8\nflow.instants = 64\nflow.frequency = " +
        std::to_string(frequency) + "\n"));
    macro::WomersleyChannelProfile exact;
    exact.height = height;
    exact.viscosity = 1.2e-3;
    exact.density = 1050;
    exact.steady_gradient = 12 * exact.viscosity * mean_velocity / (height * height);
    exact.oscillating_gradient = 0.8 * exact.steady_gradient;
    exact.angular_frequency = 2 * std::acos(-1) * frequency;
    double error = 0;
    for (double phase = -1; phase < 2; phase += 0.0171) {
      for (double s = 0; s <= 1; s += 0.0223) {
        const double u = macro::evaluate(exact, s * height, phase / frequency).velocity;
        const double here = channel.flow->at({0, s * height}, phase / frequency).velocity[0];
        error = std::max(error, std::abs(here - u));
      }
    }
    error /= channel.flow->largest_speed();
    const double stated = statement(channel, "tabulated velocity");
    EXPECT_LE(error, 1.05 * stated) << frequency;
    EXPECT_GE(error, 0.5 * stated) << frequency;
    EXPECT_LE(stated, 1e-3) << frequency;
    EXPECT_NEAR(statement(channel, "Womersley number"), macro::womersley_number(exact), 1e-9);
    EXPECT_FALSE(channel.flow->is_steady());
  }
}

TEST(EnsembleFlow, that_does_not_fit_its_domain_is_refused) {
  EXPECT_THAT(
      faults(channel_case("flow.kind = \"openfoam\"\nflow.case = \"x\"\nflow.inlet = \"i\"\n"
                          "flow.outlets = \"o\"\n")),
      HasSubstr("does not fit micro.domain = \"channel\""));
  const std::string geometry =
      "case.name = \"a\"\nscene.kind = \"micro\"\nfluid.hematocrit = 0.4\n[micro]\n"
      "domain = \"geometry\"\nduration = \"1 s\"\noutput_interval = \"1 s\"\n";
  EXPECT_THAT(faults(geometry), HasSubstr("does not fit micro.domain = \"geometry\""));
  EXPECT_THAT(faults(geometry + "flow.kind = \"openfoam\"\nflow.case = \"x\"\nflow.inlet = \"i\"\n"
                                "flow.outlets = \"o\"\nflow.overhang = \"1 um\"\n"),
              HasSubstr("less than half a cell"));
}

TEST(EnsembleFlow, without_openfoam_says_what_is_missing) {
  const char* name = "HEMOSCALE_OPENFOAM_LIBRARY";
  const char* before = std::getenv(name);
  const std::string kept = before != nullptr ? before : "";
  setenv(name, "/nowhere/libhemoscale_openfoam.so", 1);
  const std::string geometry =
      "case.name = \"a\"\nscene.kind = \"micro\"\nfluid.hematocrit = 0.4\n[micro]\n"
      "domain = \"geometry\"\nduration = \"1 s\"\noutput_interval = \"1 s\"\n"
      "flow.kind = \"openfoam\"\nflow.case = \"x\"\nflow.inlet = \"i\"\nflow.outlets = \"o\"\n";
  try {
    built(geometry);
    ADD_FAILURE() << "built";
  } catch (const macro::EnvironmentError& error) {
    EXPECT_THAT(error.what(), HasSubstr("/nowhere/libhemoscale_openfoam.so: no such file"));
  }
  if (kept.empty()) {
    unsetenv(name);
  } else {
    setenv(name, kept.c_str(), 1);
  }
}

TEST(EnsembleFlow, has_keys_that_apply_to_its_kind_alone) {
  EXPECT_THAT(places_of(faults_of(channel_case("flow.frequency = \"1 1/s\"\n"))),
              testing::ElementsAre("10:18 micro.flow.frequency"));
  EXPECT_THAT(faults(channel_case("flow.kind = \"womersley\"\n")),
              HasSubstr("micro.flow.frequency"));
  EXPECT_THAT(faults(channel_case("flow.kind = \"openfoam\"\n")),
              testing::AllOf(HasSubstr("micro.flow.case"), HasSubstr("micro.flow.inlet"),
                             HasSubstr("micro.flow.outlets")));
}

}  // namespace
}  // namespace hemoscale::coupling
