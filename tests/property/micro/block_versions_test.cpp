#include <gtest/gtest.h>

#include <sys/types.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "micro/ensemble/blocks/kernel_arguments.hpp"
#include "micro/error.hpp"
#include "tests/support/micro/block_runs.hpp"

// Versions of the kernels for different instruction sets are chosen once in a process, by the
// environment: this program runs itself with each of them.
namespace hemoscale::micro {
namespace {

constexpr const char* result_file = "HEMOSCALE_TEST_RESULT";

std::vector<double> positions(Precision precision, int threads) {
  test::BlockCase c = test::crowded_channel();
  c.settings.threads = threads;
  BlockEnsemble ensemble = c.make(precision);
  ensemble.advance(100);
  std::vector<double> result;
  for (const EnsembleState& state : ensemble.states()) {
    result.insert(result.end(), state.x.begin(), state.x.end());
    result.insert(result.end(), state.y.begin(), state.y.end());
  }
  return result;
}

std::string run_path() {
  return (std::filesystem::temp_directory_path() /
          ("hemoscale_versions_" + std::to_string(getpid())))
      .string();
}

struct VersionRun {
  int status = 0;
  std::string version;
  std::vector<double> single, twofold;
};

/// Calls BlockVersionsChild below in a process of its own.
VersionRun run_version(const std::string& vectors, int threads) {
  const std::string path = run_path();
  const std::string command =
      "HEMOSCALE_VECTORS=" + vectors + " " + result_file + "=" + path +
      " HEMOSCALE_TEST_THREADS=" + std::to_string(threads) + " " +
      std::filesystem::canonical("/proc/self/exe").string() +
      " --gtest_also_run_disabled_tests --gtest_filter=DISABLED_BlockVersionsChild.* > /dev/null";
  VersionRun run;
  run.status = std::system(command.c_str());
  std::ifstream file(path, std::ios::binary);
  std::size_t size = 0;
  file >> run.version >> size;
  file.ignore(1);
  for (auto* values : {&run.single, &run.twofold}) {
    values->resize(size);
    file.read(reinterpret_cast<char*>(values->data()),
              static_cast<std::streamsize>(size * sizeof(double)));
  }
  std::filesystem::remove(path);
  return run;
}

TEST(DISABLED_BlockVersionsChild, writes_its_positions) {
  const char* const path = std::getenv(result_file);
  ASSERT_NE(path, nullptr) << "is started by the other tests alone";
  const int threads = std::atoi(std::getenv("HEMOSCALE_TEST_THREADS"));
  const auto single = positions(Precision::single, threads);
  const auto twofold = positions(Precision::twofold, threads);
  std::ofstream file(path, std::ios::binary);
  file << blocks::kernels<float>().name << ' ' << single.size() << ' ';
  for (const auto* values : {&single, &twofold}) {
    file.write(reinterpret_cast<const char*>(values->data()),
               static_cast<std::streamsize>(values->size() * sizeof(double)));
  }
}

double largest_difference(const std::vector<double>& a, const std::vector<double>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

std::vector<std::string> versions_here() {
  std::vector<std::string> names = {"plain"};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("x86-64-v3") != 0) names.emplace_back("v3");
  if (__builtin_cpu_supports("x86-64-v4") != 0) names.emplace_back("v4");
#endif
  return names;
}

TEST(BlockVersions, agree_to_round_off_and_each_has_the_same_bits_for_any_threads) {
  const VersionRun plain = run_version("plain", 1);
  ASSERT_EQ(plain.status, 0);
  ASSERT_FALSE(plain.single.empty());
  for (const std::string& name : versions_here()) {
    const VersionRun one = run_version(name, 1);
    EXPECT_EQ(one.status, 0);
    EXPECT_EQ(one.version, name);
    const double single = largest_difference(one.single, plain.single);
    const double twofold = largest_difference(one.twofold, plain.twofold);
    EXPECT_LE(single, 5e-12) << name;   // [m]
    EXPECT_LE(twofold, 1e-18) << name;  // [m]
    const VersionRun three = run_version(name, 3);
    EXPECT_EQ(one.single, three.single) << name;
    EXPECT_EQ(one.twofold, three.twofold) << name;
  }
}

TEST(BlockVersions, one_that_does_not_exist_is_refused) {
  const std::string command =
      "HEMOSCALE_VECTORS=v9 " + std::string(result_file) + "=/dev/null HEMOSCALE_TEST_THREADS=1 " +
      std::filesystem::canonical("/proc/self/exe").string() +
      " --gtest_also_run_disabled_tests --gtest_filter=DISABLED_BlockVersionsChild.* > " +
      run_path();
  EXPECT_NE(std::system(command.c_str()), 0);
  std::ifstream file(run_path());
  std::stringstream text;
  text << file.rdbuf();
  std::filesystem::remove(run_path());
  EXPECT_NE(text.str().find("HEMOSCALE_VECTORS is v9"), std::string::npos) << text.str();
  EXPECT_NE(text.str().find("choose plain, v3 or v4"), std::string::npos);
}

}  // namespace
}  // namespace hemoscale::micro
