#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/config/case_text.hpp"

namespace hemoscale::coupling {
namespace {

TEST(ReadToml, keeps_order_kinds_and_places) {
  const ParameterTree tree = tree_of(
      "[zeta]\n"
      "b = 1\n"
      "a = \"x\"\n"
      "[alpha]\n"
      "  list = [1.5, true,\n"
      "          [2]]\n");
  ASSERT_EQ(tree.children.size(), 2U);
  EXPECT_EQ(tree.children[0].first, "zeta");
  EXPECT_EQ(tree.children[1].first, "alpha");

  const ParameterTree& zeta = tree.children[0].second;
  ASSERT_EQ(zeta.children.size(), 2U);
  EXPECT_EQ(zeta.children[0].first, "b");
  EXPECT_EQ(std::get<std::int64_t>(zeta.children[0].second.scalar), 1);
  EXPECT_EQ(zeta.children[0].second.location.line, 2);
  EXPECT_EQ(zeta.children[0].second.location.column, 5);
  EXPECT_EQ(std::get<std::string>(zeta.find("a")->scalar), "x");
  EXPECT_EQ(zeta.find("c"), nullptr);

  const ParameterTree& list = *tree.find("alpha")->find("list");
  EXPECT_EQ(list.kind, ParameterTree::Kind::list);
  ASSERT_EQ(list.elements.size(), 3U);
  EXPECT_EQ(std::get<double>(list.elements[0].scalar), 1.5);
  EXPECT_TRUE(std::get<bool>(list.elements[1].scalar));
  EXPECT_EQ(list.elements[2].kind, ParameterTree::Kind::list);
  EXPECT_EQ(list.elements[2].location.line, 6);
  EXPECT_EQ(list.elements[2].location.column, 11);
}

TEST(ReadToml, names_the_file_as_the_user_did) {
  const CaseFile file("a = 1\n");
  EXPECT_EQ(read_toml(file.path()).children[0].second.location.file, file.path().string());
}

TEST(ReadToml, says_where_the_syntax_breaks) {
  struct Broken {
    const char* text;
    int line;
  };
  for (const auto& [text, line] :
       {Broken{"a = 1\nb = \n", 2}, Broken{"a = 1\na = 2\n", 2}, Broken{"[a\n", 1},
        Broken{"a = 99999999999999999999\n", 1}, Broken{"a = \"x\n", 1}, Broken{"\n\nb = um\n", 3},
        Broken{"a = 1\nb\xff = 2\n", 2}, Broken{"[a]\n[a]\n", 2}}) {
    const std::vector<Fault> faults = faults_of(text);
    ASSERT_EQ(faults.size(), 1U) << text;
    EXPECT_EQ(faults[0].line, line) << text << faults[0].message;
    EXPECT_GT(faults[0].column, 0) << text;
    EXPECT_THAT(faults[0].message, testing::HasSubstr("not valid TOML")) << text;
  }
}

TEST(ReadToml, refuses_what_toml_plus_plus_only_asserts) {
  const std::vector<Fault> faults = faults_of("a = 1\n\n[.a]\n");
  ASSERT_EQ(faults.size(), 1U);
  EXPECT_EQ(faults[0].line, 3);
  EXPECT_THAT(faults[0].message, testing::HasSubstr("not valid TOML"));
}

TEST(ReadToml, refuses_nesting_that_would_overflow_the_stack) {
  std::string key = "a";
  for (int i = 0; i < 300000; ++i) key += ".a";
  for (const std::string& text : {key + " = 1\n", "[" + key + "]\n", "a = { " + key + " = 1 }\n"}) {
    const std::vector<Fault> faults = faults_of(text);
    ASSERT_EQ(faults.size(), 1U);
    EXPECT_EQ(faults[0].line, 1);
  }
  std::string digits = "1";
  for (int i = 0; i < 300000; ++i) digits += ".1";
  EXPECT_EQ(faults_of(digits + " = 1\n").size(), 1U);
  EXPECT_EQ(faults_of("a = " + std::string(300000, '[')).size(), 1U);
}

TEST(ReadToml, accepts_many_numbers) {
  std::string text = smallest_case + "sampling.points = [";
  for (int i = 0; i < 3000; ++i) text += "[0.0, 1.5e-6, 0.5],\n";
  EXPECT_EQ(settings_of(text + "]\n").points("sampling.points").size(), 3000U);
}

TEST(ReadToml, reads_dates_as_text) {
  const ParameterTree tree = tree_of("a = 2020-01-02\nb = 10:11:12\nc = 2020-01-02T10:11:12Z\n");
  EXPECT_EQ(std::get<std::string>(tree.find("a")->scalar), "2020-01-02");
  EXPECT_EQ(std::get<std::string>(tree.find("b")->scalar), "10:11:12");
  EXPECT_EQ(std::get<std::string>(tree.find("c")->scalar), "2020-01-02T10:11:12Z");
}

TEST(ReadToml, tells_a_missing_file_from_a_folder) {
  const CaseFile file("");
  for (const auto& path : {file.folder(), file.folder() / "absent.toml"}) {
    try {
      read_toml(path);
      ADD_FAILURE() << path;
    } catch (const EnvironmentError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr(path.string()));
    }
  }
}

TEST(ReadToml, refuses_a_file_that_is_too_large_to_be_a_case) {
  EXPECT_EQ(faults_of("# " + std::string(5U << 20U, 'x') + "\n").size(), 1U);
}

}  // namespace
}  // namespace hemoscale::coupling
