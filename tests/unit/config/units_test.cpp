#include "coupling/config/units.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <udunits2.h>

#include "coupling/error.hpp"

namespace hemoscale::coupling {
namespace {

std::string reason_against(const std::string& unit, const std::string& si_unit) {
  try {
    UnitSystem().convert(1, unit, si_unit);
  } catch (const UnitError& error) {
    return error.reason;
  }
  return "";
}

TEST(Units, convert_what_the_field_writes) {
  const UnitSystem units;
  EXPECT_EQ(units.convert(80, "um", "m"), 80e-6);  // the nearest double, no rounding on the way
  EXPECT_EQ(units.convert(80, "µm", "m"), 80e-6);
  EXPECT_DOUBLE_EQ(units.convert(10, "mm/s", "m/s"), 0.01);
  EXPECT_DOUBLE_EQ(units.convert(1.2, "mPa s", "Pa s"), 1.2e-3);
  EXPECT_DOUBLE_EQ(units.convert(1.2, "cP", "Pa s"), 1.2e-3);
  EXPECT_DOUBLE_EQ(units.convert(100, "1/s", "1/s"), 100);
  EXPECT_DOUBLE_EQ(units.convert(100, "s-1", "1/s"), 100);
  EXPECT_DOUBLE_EQ(units.convert(100, "s^-1", "1/s"), 100);
  EXPECT_DOUBLE_EQ(units.convert(100, "s**-1", "1/s"), 100);
  EXPECT_DOUBLE_EQ(units.convert(5, "dyn/cm", "N/m"), 5e-3);
  EXPECT_DOUBLE_EQ(units.convert(5, "uN/m", "N/m"), 5e-6);
  EXPECT_DOUBLE_EQ(units.convert(0.2, "aJ", "J"), 2e-19);
  EXPECT_DOUBLE_EQ(units.convert(1.05, "g/cm3", "kg/m^3"), 1050);
  EXPECT_DOUBLE_EQ(units.convert(2, "min", "s"), 120);
  EXPECT_DOUBLE_EQ(units.convert(10, "kPa/m", "Pa/m"), 1e4);
  EXPECT_DOUBLE_EQ(units.convert(45, "%", "1"), 0.45);
}

TEST(Units, refuse_the_wrong_dimension) {
  EXPECT_EQ(reason_against("kg", "m"), "cannot be converted to m");
  EXPECT_EQ(reason_against("um", "1"), "is not dimensionless");
  EXPECT_EQ(reason_against("%", "m"), "cannot be converted to m");
}

TEST(Units, refuse_a_reciprocal_though_the_library_would_convert_it) {
  EXPECT_EQ(reason_against("s", "1/s"), "cannot be converted to 1/s");
  EXPECT_EQ(reason_against("1/s", "s"), "cannot be converted to s");
}

TEST(Units, refuse_what_is_not_proportional) {
  EXPECT_EQ(reason_against("degC", "K"), "has an origin of its own or is a logarithm");
  EXPECT_NE(reason_against("lg(re mW)", "W"), "");
  EXPECT_EQ(reason_against("m @ 3", "m"), "has an origin of its own (@)");
  EXPECT_NE(reason_against("s since 1970-01-01", "s"), "");
}

TEST(Units, refuse_a_second_number) {
  for (const char* unit : {"2 um", "um 2", "1000 m", "1 m", "um/2", "um*2", "(2)um", "m.5"}) {
    EXPECT_EQ(reason_against(unit, "m"), "holds a second number") << unit;
  }
}

TEST(Units, refuse_what_is_not_a_unit) {
  for (const char* unit : {"umm", "mPas", "!", "m^99999999999", "/", "um,", "\n", "m\xff"}) {
    EXPECT_NE(reason_against(unit, "m"), "") << unit;
  }
  EXPECT_EQ(reason_against("furlongs_of_old", "m"), "is not known");
  for (const char* unit : {"um)", "(um", "um)("}) {
    EXPECT_EQ(reason_against(unit, "m"), "has an unpaired bracket") << unit;
  }
}

TEST(Units, are_silent_and_put_the_handler_back) {
  testing::internal::CaptureStderr();
  reason_against("nonsense", "m");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");

  const ut_error_message_handler before = ut_set_error_message_handler(ut_write_to_stderr);
  { const UnitSystem units; }
  EXPECT_EQ(ut_set_error_message_handler(before), &ut_write_to_stderr);
}

TEST(Units, say_which_database_is_missing) {
  setenv("UDUNITS2_XML_PATH", "/no/such/udunits2.xml", 1);
  try {
    const UnitSystem units;
    ADD_FAILURE() << "a missing database was accepted";
  } catch (const EnvironmentError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("/no/such/udunits2.xml"));
    EXPECT_THAT(error.what(), testing::HasSubstr("libudunits2-data"));
  }
  unsetenv("UDUNITS2_XML_PATH");
}

}  // namespace
}  // namespace hemoscale::coupling
