#include "coupling/config/nearest_key.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace hemoscale::coupling {
namespace {

TEST(EditDistance, hand_values) {
  EXPECT_EQ(edit_distance("", ""), 0U);
  EXPECT_EQ(edit_distance("abc", ""), 3U);
  EXPECT_EQ(edit_distance("", "abc"), 3U);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
  EXPECT_EQ(edit_distance("height", "heigth"), 1U);  // neighbours swapped
  EXPECT_EQ(edit_distance("ca", "abc"), 3U);         // no letter is touched twice
  EXPECT_EQ(edit_distance("same", "same"), 0U);
}

TEST(EditDistance, is_symmetric) {
  for (const char* a : {"", "a", "micro.cells", "mciro.clels"}) {
    for (const char* b : {"b", "micro.nodes", "abc"}) {
      EXPECT_EQ(edit_distance(a, b), edit_distance(b, a));
    }
  }
}

TEST(NearestWord, first_of_the_nearest) {
  EXPECT_EQ(nearest_word("dgo", {"cat", "dog", "dot"}), "dog");
  EXPECT_EQ(nearest_word("x", {"a", "b"}), "a");
  EXPECT_EQ(nearest_word("x", {}), "");
}

TEST(Suggest, spelling_and_other_sections) {
  const auto& table = parameter_table();
  EXPECT_EQ(suggest("coupling.tolerence", table).key, "coupling.tolerance");
  EXPECT_TRUE(suggest("coupling.tolerence", table).close);
  EXPECT_TRUE(suggest("coupling.tolerence", table).elsewhere.empty());

  const Suggestion section = suggest("micro.membrnae", table);
  EXPECT_EQ(section.key, "micro.membrane");
  EXPECT_TRUE(section.is_section);

  EXPECT_THAT(suggest("fluid.mean_velocity", table).elsewhere,
              testing::ElementsAre("macro.channel.mean_velocity", "micro.mean_velocity"));
  EXPECT_THAT(suggest("channel.height", table).elsewhere,
              testing::ElementsAre("macro.channel.height", "micro.channel.height"));
  EXPECT_THAT(suggestion_text(suggest("fluid.mean_velocity", table)),
              testing::HasSubstr("macro.channel.mean_velocity and micro.mean_velocity"));
  EXPECT_FALSE(suggest("something.else.entirely", table).close);
}

TEST(Suggest, endless_keys_cost_little) {
  EXPECT_FALSE(suggest(std::string(1000000, 'x'), parameter_table()).key.empty());
}

}  // namespace
}  // namespace hemoscale::coupling
