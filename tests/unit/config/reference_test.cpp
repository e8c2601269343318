#include "coupling/config/reference.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "coupling/config/parameter_table.hpp"
#include "coupling/error.hpp"

namespace hemoscale::coupling {
namespace {

using testing::HasSubstr;

TEST(Reference, document_on_disk_is_what_the_table_says) {
  const auto file =
      std::filesystem::path(HEMOSCALE_SOURCE_DIR) / "docs" / "reference" / "case-keys.md";
  std::ifstream stream(file);
  ASSERT_TRUE(stream) << file;
  std::ostringstream text;
  text << stream.rdbuf();
  EXPECT_EQ(text.str(), reference_markdown(""))
      << "stale; run: hemoscale reference --markdown > docs/reference/case-keys.md";
}

TEST(Reference, holds_every_key) {
  const std::string all = reference_text("");
  const std::string markdown = reference_markdown("");
  for (const Parameter& parameter : parameter_table()) {
    const std::size_t dot = parameter.key.rfind('.');
    EXPECT_THAT(all, HasSubstr("[" + parameter.key.substr(0, dot) + "]\n"));
    EXPECT_THAT(all, HasSubstr("\n" + parameter.key.substr(dot + 1) + " "));
    EXPECT_THAT(markdown, HasSubstr("| `" + parameter.key.substr(dot + 1) + "` |"));
    EXPECT_THAT(reference_text(parameter.key), HasSubstr(parameter.key + "\n"));
  }
}

TEST(Reference, fits_a_terminal) {
  std::vector<std::string> texts = {reference_text("")};
  for (const Parameter& parameter : parameter_table())
    texts.push_back(reference_text(parameter.key));
  for (const std::string& text : texts) {
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) EXPECT_LE(line.size(), 80U) << line;
  }
}

TEST(Reference, one_key_in_full) {
  const std::string card = reference_text("macro.channel.pressure_gradient");
  for (const char* part : {"quantity in Pa/m", "> 0 Pa/m", "required", "macro.model = channel",
                           "macro.channel.drive =", "\"10 kPa/m\""}) {
    EXPECT_THAT(card, HasSubstr(part));
  }
}

TEST(Reference, a_section_alone) {
  const std::string text = reference_text("micro.drag");
  EXPECT_THAT(text, HasSubstr("[micro.drag]"));
  EXPECT_THAT(text, testing::Not(HasSubstr("[micro.contact]")));
  EXPECT_THAT(reference_text("micro"), HasSubstr("[micro.contact]"));
  EXPECT_THAT(reference_markdown("micro.drag"), testing::StartsWith("## micro.drag"));
}

TEST(Reference, unknown_keys_name_the_nearest) {
  for (const char* key : {"micro.drga", "micro.dra", "drag"}) {
    try {
      reference_text(key);
      ADD_FAILURE() << key;
    } catch (const CaseError& error) {
      EXPECT_THAT(error.what(), HasSubstr("nearest known")) << key;
    }
  }
}

}  // namespace
}  // namespace hemoscale::coupling
