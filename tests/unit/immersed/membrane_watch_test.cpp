#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "micro/cells/outline_checks.hpp"
#include "micro/error.hpp"
#include "micro/immersed/membrane_watch.hpp"
#include "tests/support/immersed/rings.hpp"

namespace hemoscale::micro {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using namespace test;

constexpr double um = 1e-6;

/// One ring in a channel of 20 x 10 um.
class Watch : public testing::Test {
 protected:
  Cell ring_at(double x, double y) const {
    return ring_cell({.node_spacing = 0.35 * um, .radius = 3 * um, .centre = {x * um, y * um}}, {});
  }
  std::string fault(const std::vector<Cell>& after) const {
    try {
      watch(after, before, bounds, {}, step);
    } catch (const NumericalError& error) {
      return error.what();
    }
    return "";
  }
  std::string refusal(const std::vector<Cell>& cells) const {
    try {
      require_admissible(cells, domain.box, bounds);
    } catch (const ParameterError& error) {
      return error.what();
    }
    return "";
  }
  FlowDomain<2> domain = channel_nodes(20 * um, 10 * um, false, {.spacing = 0.5 * um});
  MembraneBounds bounds{domain, 0, 1 * um};
  std::vector<Cell> before = {ring_at(10, 5)};
  std::vector<Limit> limits = {
      {.name = "some limit", .value = 2, .limit = 1, .unit = "s", .remedy = "do something"}};
  MembraneStep step{.step = 7, .time = 3e-5, .spacing = 0.5 * um, .limits = &limits};
};

TEST_F(Watch, reports_the_shape_of_a_good_step) {
  std::vector<Cell> after = before;
  for (Vector<2>& x : after[0].positions) {
    x = Vector<2>(10, 5) * um + 1.01 * (x - Vector<2>(10, 5) * um);
  }
  const CellReport report = watch(after, before, bounds, {}, step).front();
  EXPECT_NEAR(report.area_error, 0.0201, 1e-12);
  EXPECT_NEAR(report.length_error, 0.01, 1e-12);
  EXPECT_NEAR(report.largest_strain, 0.01, 1e-12);
  EXPECT_EQ(fault(before), "");
}

TEST_F(Watch, names_step_cell_node_value_limit_and_remedy) {
  std::vector<Cell> after = before;
  after[0].positions[5][0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(fault(after),
              AllOf(HasSubstr("step 7, time 3e-05 s: cell 0, node 5"), HasSubstr("not finite"),
                    HasSubstr("some limit: 2 s exceeds 1"), HasSubstr("do something")));
  after = before;
  after[0].positions[5][0] += 0.26 * um;
  EXPECT_THAT(fault(after), AllOf(HasSubstr("node 5"), HasSubstr("moved by 0.52 spacings")));
  after = before;
  after[0].positions[0][0] += 0.24 * um;
  EXPECT_EQ(fault(after), "");  // strains of 0.2
  after[0].positions[5] += Vector<2>(-0.2, 0.12) * um;
  limits.clear();
  EXPECT_THAT(fault(after), AllOf(HasSubstr("strain"), HasSubstr("at most 0.5"),
                                  HasSubstr("no limit is exceeded")));
}

TEST_F(Watch, finds_a_lost_area_a_crossing_and_a_wall) {
  std::vector<Cell> after = before;
  for (Vector<2>& x : after[0].positions) x[1] = 5 * um + 0.94 * (x[1] - 5 * um);
  EXPECT_THAT(fault(after), AllOf(HasSubstr("area is off by -0.06"), HasSubstr("0.05")));
  // A figure of eight keeps all lengths when nodes of both sides are exchanged.
  after = before;
  std::vector<Vector<2>>& x = after[0].positions;
  std::reverse(x.begin() + 3, x.begin() + 5);
  before = after;
  const MembraneThresholds wide{.strain = 10, .area = 1};
  EXPECT_THROW(watch(after, before, bounds, wide, step), NumericalError);
  before = {ring_at(10, 6.99)};
  after = before;
  for (Vector<2>& node : after[0].positions) node[1] += 0.1 * um;
  EXPECT_THAT(fault(after), HasSubstr("beyond a wall"));
}

TEST_F(Watch, refuses_cells_that_cannot_be_there) {
  EXPECT_EQ(refusal({ring_at(5, 5), ring_at(12, 5)}), "");
  EXPECT_THAT(refusal({ring_at(5, 5), ring_at(10, 5)}), HasSubstr("cell 0 overlaps cell 1"));
  EXPECT_THAT(refusal({ring_at(10, 7.5)}), AllOf(HasSubstr("node"), HasSubstr("beyond a wall")));
  EXPECT_THAT(refusal({ring_at(3.5, 5)}), HasSubstr("from an opening"));
  Cell cell = ring_at(10, 5);
  std::reverse(cell.positions.begin(), cell.positions.end());
  EXPECT_THAT(refusal({cell}), HasSubstr("clockwise"));
  cell = ring_at(10, 5);
  std::swap(cell.positions[3], cell.positions[20]);
  EXPECT_THAT(refusal({cell}), HasSubstr("crosses itself"));
  cell = ring_at(10, 5);
  cell.positions.pop_back();
  EXPECT_THAT(refusal({cell}), HasSubstr("53 nodes, its mesh 54"));
  cell = ring_at(10, 5);
  cell.positions[4] = cell.positions[5];
  EXPECT_THAT(refusal({cell}), HasSubstr("node 4 coincides"));
  EXPECT_THAT(refusal({Cell{}}), HasSubstr("no membrane"));
  const Cell coarse =
      ring_cell({.node_spacing = 3 * um, .radius = 3 * um, .centre = {10 * um, 5 * um}}, {});
  EXPECT_THAT(refusal({coarse}), HasSubstr("6 nodes; at least 8"));
}

TEST_F(Watch, knows_the_images_of_a_joined_channel) {
  const FlowDomain<2> joined = channel_nodes(20 * um, 10 * um, true, {.spacing = 0.5 * um});
  const MembraneBounds walls(joined, 0, 1 * um);
  EXPECT_NO_THROW(require_admissible({ring_at(1, 5), ring_at(12, 5)}, joined.box, walls));
  EXPECT_THROW(require_admissible({ring_at(1, 5), ring_at(37, 5)}, joined.box, walls),
               ParameterError);
}

TEST(AreaProjection, restores_the_area_to_second_order) {
  const Cell cell = ring_cell({.node_spacing = 0.35 * um, .radius = 3 * um}, {});
  const RingMesh& mesh = cell.membrane->mesh();
  for (const double leak : {1e-2, 1e-3}) {
    std::vector<Vector<2>> x = cell.positions;
    for (Vector<2>& node : x) node[0] *= 1 - leak;
    EXPECT_NEAR(project_area(mesh, x), -leak, 1e-12);
    EXPECT_LT(std::abs(enclosed_area(x) / mesh.rest_area - 1), leak * leak);
  }
}

}  // namespace
}  // namespace hemoscale::micro
