#include <gtest/gtest.h>

#include <cstdint>

#include "coupling/config/interpret.hpp"
#include "tests/unit/config/case_text.hpp"

// Whatever bytes a case file holds: it is understood, or refused with faults that have a place and
// a message. Nothing else may happen.
namespace hemoscale::coupling {
namespace {

/// Counter-based numbers [Steele et al. 2014], so that a failure is repeated by its number alone.
std::uint64_t random_number(std::uint64_t counter) {
  std::uint64_t z = (counter + 1) * 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31U);
}

class Stream {
 public:
  explicit Stream(std::uint64_t seed) : counter_(seed << 20U) {}
  std::size_t below(std::size_t bound) { return random_number(counter_++) % bound; }

 private:
  std::uint64_t counter_;
};

const std::string valid_case =
    "# a comment\n"
    "[case]\n"
    "name = \"channel-feedback\"\n"
    "seed = 42\n"
    "[fluid]\n"
    "plasma_viscosity = \"1.2 mPa s\"\n"
    "hematocrit = 0.4\n"
    "[macro]\n"
    "model = \"channel\"\n"
    "channel = { height = \"80 um\", mean_velocity = \"10 mm/s\" }\n"
    "[sampling]\n"
    "points = [[0, \"1 um\", 0], [1e-6, 2e-6, \"3um\"]]\n"
    "[coupling]\n"
    "shear_thinning = true\n"
    "relaxation_factor = 0.7\n"
    "[micro.drag]\n"
    "convention = \"cell\"\n"
    "[variant.openfoam.macro]\n"
    "model = \"openfoam\"\n"
    "openfoam.case = \"foam\"\n"
    "openfoam.length_unit = \"1 um\"\n";

/// @returns whether the case was understood
bool understood(const CaseFile& file, const std::string& variant, const std::string& text) {
  try {
    interpret(read_toml(file.path()), variant);
    return true;
  } catch (const CaseError& error) {
    EXPECT_FALSE(error.faults().empty()) << text;
    for (const Fault& fault : error.faults()) {
      EXPECT_FALSE(fault.message.empty()) << text;
      EXPECT_EQ(fault.file, file.path().string()) << text;
    }
  }
  return false;
}

bool both_understood(const std::string& text) {
  const CaseFile file(text);
  const bool alone = understood(file, "", text);
  const bool with_variant = understood(file, "openfoam", text);
  return alone && with_variant;
}

TEST(BrokenCase, the_case_itself_is_valid) {
  EXPECT_TRUE(both_understood(valid_case));
}

TEST(BrokenCase, every_truncation) {
  for (std::size_t length = 0; length < valid_case.size(); ++length) {
    both_understood(valid_case.substr(0, length));
  }
}

TEST(BrokenCase, every_line_left_out) {
  for (std::size_t begin = 0; begin < valid_case.size();) {
    const std::size_t end = valid_case.find('\n', begin) + 1;
    both_understood(valid_case.substr(0, begin) + valid_case.substr(end));
    begin = end;
  }
}

TEST(BrokenCase, random_bytes_changed) {
  std::string bytes("\0\xff\n\"'[]{}=.,#\\-+e1 \x1b", 20);
  bytes += "µnaif";
  int broken = 0;
  for (std::uint64_t seed = 0; seed < 1200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Stream stream(seed);
    std::string text = valid_case;
    const std::size_t changes = 1 + stream.below(6);
    for (std::size_t i = 0; i < changes; ++i) {
      const std::size_t place = stream.below(text.size());
      switch (stream.below(4)) {
        case 0:
          text[place] = bytes[stream.below(bytes.size())];
          break;
        case 1:
          text.insert(place, 1, bytes[stream.below(bytes.size())]);
          break;
        case 2:
          text.erase(place, 1 + stream.below(8));
          break;
        default:
          text.insert(place, text.substr(stream.below(text.size()), stream.below(40)));
      }
    }
    if (!both_understood(text)) ++broken;
  }
  EXPECT_GT(broken, 800);  // the changes do reach what is checked
}

TEST(BrokenCase, random_values_for_every_key) {
  const std::vector<std::string> values = {"0",
                                           "-1",
                                           "1e308",
                                           "-0.0",
                                           "inf",
                                           "nan",
                                           "true",
                                           "\"\"",
                                           "\"x\"",
                                           "[]",
                                           "[[]]",
                                           "{}",
                                           "\"1 um\"",
                                           "\"1 s\"",
                                           "\"-5 mPa s\"",
                                           "\"1e-400 m\"",
                                           "[1, 2]",
                                           "{a=1}",
                                           "\"yes\"",
                                           "2020-01-01",
                                           "9223372036854775807",
                                           "\"1 1/s\"",
                                           "\"\\u0000\""};
  for (std::uint64_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Stream stream(seed);
    std::string text = "case.name = \"a\"\n";
    const auto& table = parameter_table();
    for (const Parameter& parameter : table) {
      if (parameter.key != "case.name" && stream.below(4) == 0) {
        text += parameter.key + " = " + values[stream.below(values.size())] + "\n";
      }
    }
    const CaseFile file(text);
    understood(file, "", text);
  }
}

TEST(BrokenCase, random_bytes_alone) {
  for (std::uint64_t seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Stream stream(seed);
    std::string text;
    const std::size_t length = stream.below(300);
    for (std::size_t i = 0; i < length; ++i) text += static_cast<char>(stream.below(256));
    EXPECT_FALSE(both_understood(text));
  }
}

}  // namespace
}  // namespace hemoscale::coupling
