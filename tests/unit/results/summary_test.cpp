#include "coupling/report/summary.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "coupling/error.hpp"
#include "tests/unit/results/scratch_folder.hpp"

namespace hemoscale::tests {
namespace {

namespace fs = std::filesystem;
using coupling::Summary;
using testing::HasSubstr;

Summary sample_summary() {
  Summary summary;
  summary.title = "channel-feedback";
  summary.outcome = "stopped: \"quoted\"\nin pass 3";
  summary.version = "0.1.0";
  summary.seed = std::numeric_limits<std::uint64_t>::max();
  summary.identity = "0123456789abcdef";
  summary.figures = {{"flow rate per depth", 1.0 / 3, "m^2/s"}, {"viscosity", 4e-3, "Pa s", 1e-5}};
  summary.settings = {{"micro.cells", "16"}, {"seed", "7"}};
  summary.host = {"host", "processor", 2, 1, 4};
  summary.timings["micro"] = {1.5, 2.5, 7};
  summary.ledger = {{"area", 1e-6, 1e-3, 1e-2}, {"length", 5e-3, 1e-3, 1e-2}};
  summary.warnings = {"a warning"};
  summary.statements = {"2-D", "prescribed flow: no lift"};
  return summary;
}

nlohmann::json json_of(const fs::path& path) {
  std::ifstream file(path);
  return nlohmann::json::parse(file);
}

TEST(Summary, is_read_back_as_written) {
  const ScratchFolder folder("summary");
  const fs::path path = folder / "summary.json";
  const Summary written = sample_summary();
  write_summary(path, written);
  const Summary read = coupling::read_summary(path);
  EXPECT_EQ(read.title, written.title);
  EXPECT_EQ(read.outcome, written.outcome);
  EXPECT_EQ(read.version, written.version);
  EXPECT_EQ(read.seed, written.seed);
  EXPECT_EQ(read.identity, written.identity);
  EXPECT_EQ(read.settings, written.settings);
  EXPECT_EQ(read.warnings, written.warnings);
  EXPECT_EQ(read.statements, written.statements);
  ASSERT_EQ(read.figures.size(), 2U);
  EXPECT_EQ(read.figures[0].value, 1.0 / 3);
  EXPECT_EQ(read.figures[0].standard_error, std::nullopt);
  EXPECT_EQ(read.figures[1].standard_error, 1e-5);
  EXPECT_EQ(read.figures[1].unit, "Pa s");
  EXPECT_EQ(read.host.processor, "processor");
  EXPECT_EQ(read.host.ranks, 4);
  EXPECT_EQ(read.timings.at("micro").cpu, 2.5);
  EXPECT_EQ(read.timings.at("micro").calls, 7);
  ASSERT_EQ(read.ledger.size(), 2U);
  EXPECT_EQ(read.ledger[1].deviation, 5e-3);
  EXPECT_FALSE(fs::exists(folder / "summary.json.part"));
}

TEST(Summary, tells_the_state_of_each_conserved_quantity) {
  const ScratchFolder folder("summary-ledger");
  Summary summary = sample_summary();
  summary.ledger.push_back({"momentum", std::nan(""), 1e-3, 1e-2});
  summary.ledger.push_back({"energy", 2e-2, 1e-3, 1e-2});
  write_summary(folder / "s.json", summary);
  const nlohmann::json ledger = json_of(folder / "s.json").at("conservation");
  EXPECT_EQ(ledger.at(0).at("state"), "good");
  EXPECT_EQ(ledger.at(1).at("state"), "warn");
  EXPECT_EQ(ledger.at(2).at("state"), "stop");
  EXPECT_EQ(ledger.at(3).at("state"), "stop");
}

TEST(Summary, holds_values_that_json_does_not_know) {
  const ScratchFolder folder("summary-nan");
  Summary summary = sample_summary();
  summary.figures[0].value = std::numeric_limits<double>::infinity();
  summary.title = "caf\xe9";  // not UTF-8
  write_summary(folder / "s.json", summary);
  EXPECT_TRUE(json_of(folder / "s.json").at("figures").at(0).at("value").is_null());
  EXPECT_TRUE(std::isnan(coupling::read_summary(folder / "s.json").figures[0].value));
  EXPECT_EQ(coupling::read_summary(folder / "s.json").title, "caf\xef\xbf\xbd");
}

TEST(Summary, what_is_not_a_summary_is_refused_with_its_path) {
  const ScratchFolder folder("summary-bad");
  const fs::path path = folder / "s.json";
  write_summary(path, sample_summary());
  const std::string whole = [&] {
    std::ifstream file(path);
    return std::string(std::istreambuf_iterator<char>(file), {});
  }();
  const nlohmann::json good = nlohmann::json::parse(whole);
  std::vector<std::string> texts{"", "{}", "[1, 2]", "null", "not json"};
  for (std::size_t size = 0; size + 2 < whole.size(); size += 97) {
    texts.push_back(whole.substr(0, size));
  }
  for (const auto& [key, value] : good.items()) {
    nlohmann::json without = good;
    without.erase(key);
    texts.push_back(without.dump());
    nlohmann::json with_other = good;
    with_other[key] = value.is_boolean() ? nlohmann::json(1) : nlohmann::json(true);
    texts.push_back(with_other.dump());
  }
  for (const std::string& text : texts) {
    std::ofstream(path) << text;
    try {
      coupling::read_summary(path);
      ADD_FAILURE() << "no error for: " << text;
    } catch (const coupling::EnvironmentError& error) {
      EXPECT_THAT(error.what(), HasSubstr(path.string()));
    }
  }
}

TEST(Summary, a_full_disk_leaves_the_old_file) {
  const ScratchFolder folder("summary-full");
  write_summary(folder / "s.json", sample_summary());
  fs::create_symlink("/dev/full", folder / "s.json.part");
  Summary other = sample_summary();
  other.title = "other";
  try {
    write_summary(folder / "s.json", other);
    FAIL() << "no error";
  } catch (const coupling::EnvironmentError& error) {
    EXPECT_THAT(error.what(), HasSubstr("s.json: cannot write: No space left on device"));
  }
  EXPECT_EQ(coupling::read_summary(folder / "s.json").title, "channel-feedback");
}

TEST(Provenance, names_version_and_machine) {
  EXPECT_THAT(coupling::program_version(), testing::MatchesRegex("[0-9]+\\.[0-9]+\\.[0-9]+.*"));
  const coupling::Host host = coupling::this_host(3, 4);
  EXPECT_FALSE(host.name.empty());
  EXPECT_GE(host.processors, 1);
  EXPECT_EQ(host.threads, 3);
  EXPECT_EQ(host.ranks, 4);
}

}  // namespace
}  // namespace hemoscale::tests
