#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "coupling/scene/ensemble_results.hpp"
#include "tests/support/micro/ensemble_observables.hpp"
#include "tests/unit/results/pictures.hpp"
#include "tests/unit/results/python_script.hpp"

namespace hemoscale::coupling {
namespace {

using testing::HasSubstr;

const micro::Box channel{.length = 12e-6, .height = 10e-6, .walls = true};

micro::EnsembleState cells(double time) {
  micro::EnsembleState state =
      test::ellipses({{{4e-6, 3e-6}, 2e-6, 1e-6, 0.3}, {{9e-6, 7e-6}, 2e-6, 1e-6, -0.3}}, 30);
  state.time = time;
  return state;
}

micro::EnsembleObserver observer(const std::string& name) {
  micro::ObserverOptions options;
  options.bins = 10;
  options.distance_bins = 4;
  options.sections = {{"outlet", {11e-6, 0}, {11e-6, 10e-6}}};
  return {{.name = name,
           .rest_area = 6e-12,
           .rest_perimeter = 1e-5,
           .node_drag = 1e-3,
           .law = test::no_contacts()},
          options};
}

class EnsembleResultsTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(testing::TempDir()) /
              testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  double value(const std::string& table, const std::string& column, std::size_t row) const {
    const Table read = read_table(folder_ / table);
    for (std::size_t k = 0; k < read.columns.size(); ++k) {
      if (read.columns[k].name == column) return read.rows.at(row)[k];
    }
    throw std::out_of_range(column);
  }
  std::string text(const std::string& name) const {
    std::ostringstream all;
    all << std::ifstream(folder_ / name).rdbuf();
    return all.str();
  }

  std::filesystem::path folder_;
  const test::PlainFlow flow_ = test::uniform_flow(1e-3);
  const std::vector<std::string> statements_ = ensemble_statements({});
};

TEST_F(EnsembleResultsTest, writes_every_table_of_every_kind) {
  micro::EnsembleObserver red = observer("red cells");
  micro::EnsembleObserver small = observer("platelets");
  EnsembleResults results(folder_, {&red, &small}, channel.height, statements_, std::nullopt);
  for (const double time : {0.0, 0.001}) {
    red.sample(cells(time), channel, flow_, {});
    small.sample(cells(time), channel, flow_, {});
    results.append();
  }
  results.finish();
  const Table series = read_table(folder_ / "series.csv");
  EXPECT_EQ(series.columns.size(), ensemble_columns({&red, &small}).size());
  EXPECT_EQ(series.rows.size(), 2U);
  const double area = 2 * test::polygon_area({{0, 0}, 2e-6, 1e-6, 0}, 30);
  EXPECT_NEAR(value("series.csv", "tube hematocrit", 1), area / channel.area(), 1e-12);
  EXPECT_NEAR(value("series.csv", "platelets: discharge hematocrit", 1), area / channel.area(),
              1e-12);
  EXPECT_NEAR(value("series.csv", "mean distance of the cells from the axis over half height", 0),
              0.4, 1e-12);
  EXPECT_NEAR(value("concentration.csv", "share of the cells at distance 0.375", 1), 1, 1e-12);
  EXPECT_GT(value("concentration-platelets.csv", "area fraction at y = 3.5 um", 1), 0.1);
  EXPECT_EQ(value("concentration.csv", "area fraction at y = 0.5 um", 1), 0);
  EXPECT_NEAR(value("profile.csv", "cell velocity", 3), 1e-3, 1e-12);
  EXPECT_TRUE(std::isnan(value("profile.csv", "platelets: cell velocity", 0)));
  EXPECT_NEAR(value("red-cells.csv", "inclination", 1), -0.3, 1e-9);
  EXPECT_EQ(read_table(folder_ / "platelets.csv").rows.size(), 2U);
  EXPECT_EQ(results.figures().size(), 2 * (series.columns.size() - 1));
}

TEST_F(EnsembleResultsTest, are_drawn) {
  if (!tests::has_module("matplotlib")) GTEST_SKIP() << "python3-matplotlib is not installed";
  micro::EnsembleObserver red = observer("red cells");
  micro::EnsembleObserver small = observer("platelets");
  EnsembleResults results(folder_, {&red, &small}, channel.height, statements_, std::nullopt);
  red.sample(cells(0), channel, flow_, {});
  small.sample(cells(0), channel, flow_, {});
  results.append();
  results.finish();
  ASSERT_EQ(tests::plot(folder_), 0);
  for (const std::string name : {"concentration", "profile", "series"}) {
    EXPECT_TRUE(tests::is_picture(folder_ / ("ensemble-" + name + ".png"))) << name;
  }
}

TEST_F(EnsembleResultsTest, states_what_the_results_are_not) {
  micro::EnsembleObserver red = observer("red cells");
  const EnsembleResults results(folder_, {&red}, channel.height,
                                ensemble_statements({"wall lift", "shear diffusion"}),
                                std::nullopt);
  EXPECT_THAT(text("tables.txt"),
              HasSubstr("prescribed flow: no hydrodynamic interaction, no lift"));
  EXPECT_THAT(text("tables.txt"), HasSubstr("wall lift; shear diffusion"));
  EXPECT_THAT(statements_, testing::Not(testing::Contains(HasSubstr("optional laws"))));
}

TEST_F(EnsembleResultsTest, of_no_cells_are_not_numbers) {
  micro::EnsembleObserver red = observer("red cells");
  EnsembleResults results(folder_, {&red}, channel.height, statements_, std::nullopt);
  micro::EnsembleState none;
  none.nodes = 30;
  red.sample(none, channel, flow_, {});
  results.append();
  EXPECT_EQ(value("series.csv", "cells", 0), 0);
  EXPECT_EQ(value("series.csv", "area fraction", 0), 0);
  EXPECT_TRUE(std::isnan(value("series.csv", "mean deformation", 0)));
  EXPECT_TRUE(std::isnan(value("series.csv", "cell-free layer by the envelope", 0)));
  EXPECT_EQ(value("series.csv", "cells through outlet", 0), 0);
  EXPECT_EQ(value("concentration.csv", "area fraction at y = 3.5 um", 0), 0);
}

TEST_F(EnsembleResultsTest, continue_after_a_restart) {
  micro::EnsembleObserver red = observer("red cells");
  {
    EnsembleResults results(folder_, {&red}, channel.height, statements_, std::nullopt);
    for (const double time : {0.0, 0.001, 0.002}) {
      red.sample(cells(time), channel, flow_, {});
      results.append();
    }
  }
  EnsembleResults results(folder_, {&red}, channel.height, statements_, 0.001);
  red.sample(cells(0.003), channel, flow_, {});
  results.append();
  const Table series = read_table(folder_ / "series.csv");
  ASSERT_EQ(series.rows.size(), 3U);
  EXPECT_EQ(series.rows[1].front(), 0.001);
  EXPECT_EQ(series.rows[2].front(), 0.003);
  EXPECT_EQ(read_table(folder_ / "concentration.csv").rows.size(), 3U);
}

TEST_F(EnsembleResultsTest, leave_out_what_needs_a_straight_channel) {
  micro::ObserverOptions options;
  options.is_straight = false;
  micro::EnsembleObserver red({.name = "red cells",
                               .rest_area = 6e-12,
                               .rest_perimeter = 1e-5,
                               .node_drag = 1e-3,
                               .law = test::no_contacts()},
                              options);
  EnsembleResults results(folder_, {&red}, 0, statements_, std::nullopt);
  red.sample(cells(0), channel, flow_, {});
  results.append();
  results.finish();
  EXPECT_FALSE(std::filesystem::exists(folder_ / "concentration.csv"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "profile.csv"));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "red-cells.csv"));
  EXPECT_THROW(value("series.csv", "tube hematocrit", 0), std::out_of_range);
  EXPECT_EQ(value("series.csv", "cells", 0), 2);
}

}  // namespace
}  // namespace hemoscale::coupling
