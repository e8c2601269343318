#include "coupling/report/series.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "coupling/error.hpp"
#include "tests/unit/results/scratch_folder.hpp"

namespace hemoscale::tests {
namespace {

namespace fs = std::filesystem;
using coupling::SeriesWriter;
using testing::HasSubstr;

const std::vector<coupling::Column> columns{{"time", "s"}, {"change", "-"}};

std::string content_of(const fs::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

void append(SeriesWriter& writer, double first, double second) {
  writer.append(std::array<double, 2>{first, second});
}

template <typename Call>
std::string message_of(Call&& call) {
  try {
    call();
  } catch (const coupling::EnvironmentError& error) {
    return error.what();
  }
  return "no error";
}

TEST(Series, every_row_is_in_the_file_at_once) {
  const ScratchFolder folder("series-rows");
  const fs::path path = folder / "sub" / "series.csv";
  SeriesWriter writer = SeriesWriter::create(path, columns);
  EXPECT_EQ(content_of(path), "time [s],change [-]\n");
  append(writer, 0.1, 1.0 / 3);
  EXPECT_EQ(content_of(path), "time [s],change [-]\n0.1,0.3333333333333333\n");
  SeriesWriter moved = std::move(writer);
  append(moved, 0.2, -0.0);
  EXPECT_EQ(content_of(path), "time [s],change [-]\n0.1,0.3333333333333333\n0.2,-0\n");
}

TEST(Series, numbers_come_back_with_the_same_bits) {
  const ScratchFolder folder("series-bits");
  const fs::path path = folder / "series.csv";
  const double infinity = std::numeric_limits<double>::infinity();
  const std::vector<std::vector<double>> rows{{1e-300, 5e-324},
                                              {0.1 + 0.2, 1e22},
                                              {infinity, -infinity},
                                              {std::nextafter(1.0, 2.0), 123456789012345678.0}};
  write_table(path, columns, rows);
  const coupling::Table table = coupling::read_table(path);
  EXPECT_EQ(table.rows, rows);
  ASSERT_EQ(table.columns.size(), 2U);
  EXPECT_EQ(table.columns[0].name, "time");
  EXPECT_EQ(table.columns[1].unit, "-");
  write_table(path, columns, {{std::nan(""), 1}});
  EXPECT_TRUE(std::isnan(coupling::read_table(path).rows[0][0]));
}

TEST(Series, a_restart_keeps_rows_up_to_its_time) {
  const ScratchFolder folder("series-restart");
  const fs::path path = folder / "series.csv";
  const std::string kept = "time [s],change [-]\n0.1,1\n0.2,2\n";
  for (const std::string rest : {"", "0.3,3\n", "0.3,3\n0.4,4\n", "0.3,3", "0.", "0.3,3\n0.4"}) {
    SCOPED_TRACE(rest);
    std::ofstream(path) << kept << rest;
    SeriesWriter writer = SeriesWriter::resume(path, columns, 0.2);
    append(writer, 0.3, 33);
    EXPECT_EQ(content_of(path), kept + "0.3,33\n");
  }
  fs::remove(path);
  SeriesWriter::resume(path, columns, 0.2);
  EXPECT_EQ(content_of(path), "time [s],change [-]\n");
}

TEST(Series, files_of_another_kind_are_refused_and_left_alone) {
  const ScratchFolder folder("series-refused");
  const fs::path path = folder / "series.csv";
  for (const std::string text :
       {"", "time [s]\n0.1\n", "time [s],change [-]", "time [s],change [-]\n0.1\n0.2,2\n",
        "time [s],change [-]\nx,1\n", "time [s],change [-]\n0.1,1 \n"}) {
    SCOPED_TRACE(text);
    std::ofstream(path) << text;
    EXPECT_THAT(message_of([&] { SeriesWriter::resume(path, columns, 1); }),
                HasSubstr(path.string() + ":"));
    EXPECT_EQ(content_of(path), text);
  }
  std::ofstream(path) << "time [s],change [-]\n0.1,1\n0.2,abc\n";
  EXPECT_THAT(message_of([&] { coupling::read_table(path); }),
              HasSubstr("series.csv:3: 'abc' is not a number"));
  EXPECT_THAT(message_of([&] { coupling::read_table(folder / "absent.csv"); }),
              HasSubstr("No such file or directory"));
  EXPECT_THROW(SeriesWriter::create(path, {{"a,b", "s"}}), std::invalid_argument);
  EXPECT_THROW(SeriesWriter::create(path, {}), std::invalid_argument);
  EXPECT_THROW(write_table(path, columns, {{1, 2, 3}}), std::invalid_argument);
}

TEST(Series, a_full_disk_is_named) {
  EXPECT_THAT(message_of([] { SeriesWriter::create("/dev/full", columns); }),
              HasSubstr("/dev/full: cannot write: No space left on device"));
  const ScratchFolder folder("series-full");
  fs::create_symlink("/dev/full", folder / "law.csv.part");
  std::ofstream(folder / "law.csv") << "old\n";
  EXPECT_THAT(message_of([&] {
                write_table(folder / "law.csv", columns, {{1, 2}});
              }),
              HasSubstr("law.csv: cannot write: No space left on device"));
  EXPECT_EQ(content_of(folder / "law.csv"), "old\n");
}

TEST(Series, a_row_that_does_not_fit_leaves_no_trace) {
  const ScratchFolder folder("series-limit");
  const fs::path path = folder / "series.csv";
  const pid_t child = ::fork();
  if (child == 0) {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{32, 32};  // [byte] the header, one row, and half of the second row
    int status = 2;
    if (::setrlimit(RLIMIT_FSIZE, &limit) == 0) {
      SeriesWriter writer = SeriesWriter::create(path, columns);
      append(writer, 0.125, 1);
      const std::string text = message_of([&] { append(writer, 0.25, 0.123456); });
      status = text.find("series.csv: cannot write: File too large") != std::string::npos ? 0 : 1;
    }
    ::_exit(status);
  }
  int status = -1;
  ::waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  EXPECT_EQ(content_of(path), "time [s],change [-]\n0.125,1\n");
}

}  // namespace
}  // namespace hemoscale::tests
