#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <string>

#include "coupling/report/identity.hpp"
#include "coupling/report/timings.hpp"
#include "micro/snapshot/checksum.hpp"

namespace hemoscale::tests {
namespace {

// Test vectors of RFC 9923 (FNV), section 64-bit FNV-1a.
TEST(Checksum, gives_the_published_values) {
  EXPECT_EQ(micro::checksum(""), 0xcbf29ce484222325U);
  EXPECT_EQ(micro::checksum("a"), 0xaf63dc4c8601ec8cU);
  EXPECT_EQ(micro::checksum("foobar"), 0x85944171f73967e8U);
  EXPECT_EQ(micro::to_hexadecimal(0x00f0000000000abcU), "00f0000000000abc");
}

TEST(Identity, leaves_out_what_may_change) {
  const std::map<std::string, std::string> settings{{"seed", "7"},
                                                    {"output.interval", "2"},
                                                    {"outputs", "3"},
                                                    {"coupling.passes", "10"},
                                                    {"coupling.passes_more", "1"}};
  const auto kept = coupling::state_settings(settings, {"output.", "coupling.passes"});
  const std::map<std::string, std::string> expected{
      {"seed", "7"}, {"outputs", "3"}, {"coupling.passes_more", "1"}};
  EXPECT_EQ(kept, expected);
}

TEST(Identity, differs_with_any_change) {
  const std::set<std::string> hashes{
      coupling::identity_hash({}),
      coupling::identity_hash({{"a", "1"}}),
      coupling::identity_hash({{"a", "2"}}),
      coupling::identity_hash({{"b", "1"}}),
      coupling::identity_hash({{"a1", ""}}),
      coupling::identity_hash({{"a", "1"}, {"b", ""}}),
      coupling::identity_hash({{"a", "11:b0:"}}),
  };
  EXPECT_EQ(hashes.size(), 7U);
  EXPECT_EQ(coupling::identity_hash({{"a", "1"}}), coupling::identity_hash({{"a", "1"}}));
}

TEST(Timings, add_up_by_part) {
  coupling::Timings timings;
  timings.add("micro", {10, 20, 2});
  double sum = 0;
  for (int k = 0; k < 3; ++k) {
    const auto outer = timings.measure("macro");
    const auto inner = timings.measure("fit");
    for (int n = 0; n < 1000000; ++n) sum += std::sqrt(n);
  }
  EXPECT_GT(sum, 0);
  EXPECT_EQ(timings.parts().at("micro").cpu, 20);
  const coupling::PartTiming& macro = timings.parts().at("macro");
  const coupling::PartTiming& fit = timings.parts().at("fit");
  EXPECT_EQ(macro.calls, 3);
  EXPECT_GT(fit.wall, 0);
  EXPECT_GE(macro.wall, fit.wall);
  EXPECT_GT(macro.cpu, 0);
}

}  // namespace
}  // namespace hemoscale::tests
