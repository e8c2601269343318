#include "coupling/config/settings.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/unit/config/case_text.hpp"

namespace hemoscale::coupling {
namespace {

TEST(Settings, as_text_reads_back_as_the_same_number) {
  Settings settings;
  settings.assign("case.name", std::string("a"), {}, true);
  settings.assign("case.seed", std::int64_t{-7}, {}, true);
  settings.assign("fluid.hematocrit", 0.1 + 0.2, {}, true);
  settings.assign("micro.force", false, {}, false);
  settings.assign("sampling.points", Settings::Points{{1, 2e-6, 0}, {3, 4, 5}}, {}, true);
  settings.assign("some.list", std::vector<double>{1, 0.5}, {}, true);
  const auto text = settings.as_text();
  EXPECT_EQ(text.at("case.name"), "a");
  EXPECT_EQ(text.at("case.seed"), "-7");
  EXPECT_EQ(std::stod(text.at("fluid.hematocrit")), 0.1 + 0.2);
  EXPECT_EQ(text.at("micro.force"), "false");
  EXPECT_EQ(text.at("sampling.points"), "[[1, 2e-06, 0], [3, 4, 5]]");
  EXPECT_EQ(text.at("some.list"), "[1, 0.5]");
}

TEST(Settings, same_case_same_text) {
  EXPECT_EQ(settings_of(smallest_case).as_text(), settings_of(smallest_case).as_text());
}

/// Bugs of a caller: an assertion where they are on, std::logic_error elsewhere.
template <class Call>
void expect_bug(const Call& call) {
#ifdef NDEBUG
  EXPECT_THROW(call(), std::logic_error);
#else
  EXPECT_DEATH(call(), "Assertion");
#endif
}

TEST(SettingsDeathTest, misuse_is_a_bug) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  const Settings settings = settings_of(smallest_case);
  expect_bug([&] { settings.quantity("no.such.key"); });
  expect_bug([&] { settings.has("no.such.key"); });
  expect_bug([&] { settings.quantity("micro.time_step"); });  // has no value
  expect_bug([&] { settings.integer("fluid.hematocrit"); });  // is a number
}

}  // namespace
}  // namespace hemoscale::coupling
