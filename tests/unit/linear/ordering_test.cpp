#include "micro/linear/ordering.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numeric>

#include "micro/error.hpp"
#include "tests/support/linear/model_systems.hpp"

namespace hemoscale::micro {
namespace {

// Every node coupled with itself and the next of a chain.
SparsePattern chain(std::size_t nodes, bool closed) {
  SparsePattern pattern;
  pattern.global_rows = nodes;
  for (std::size_t i = 0; i < nodes; ++i) {
    std::vector<std::size_t> columns = {i};
    if (i > 0) columns.insert(columns.begin(), i - 1);
    if (i + 1 < nodes) columns.push_back(i + 1);
    if (closed && i == 0) columns.push_back(nodes - 1);
    if (closed && i + 1 == nodes) columns.insert(columns.begin(), 0);
    pattern.columns.insert(pattern.columns.end(), columns.begin(), columns.end());
    pattern.first.push_back(static_cast<std::int64_t>(pattern.columns.size()));
  }
  return pattern;
}

TEST(Ordering, natural_order_reports_the_bandwidth) {
  const SparseMatrix a = sparse({{1, 0, 0, 0}, {0, 1, 0, 0}, {0, 0, 1, 7}, {7, 0, 0, 1}});
  const Ordering order = natural_order(*a.pattern);
  EXPECT_THAT(order.place, testing::ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(order.bandwidth.lower, 3);
  EXPECT_EQ(order.bandwidth.upper, 1);
}

TEST(Ordering, a_chain_becomes_tridiagonal_whatever_its_numbers) {
  // Nodes 0..4 at places 3 1 4 0 2 along the chain.
  const std::vector<Vector<2>> positions = {{3, 0}, {1, 0}, {4, 0}, {0, 0}, {2, 0}};
  const SparseMatrix a =
      sparse({{1, 0, 1, 0, 1}, {0, 1, 0, 1, 1}, {1, 0, 1, 0, 0}, {0, 1, 0, 1, 0}, {1, 1, 0, 0, 1}});
  const Ordering order = column_order<2>(*a.pattern, {positions, 1.0, {0, 0}, 0}, 1);
  EXPECT_THAT(order.place, testing::ElementsAre(3, 1, 4, 0, 2));
  EXPECT_EQ(order.bandwidth.lower, 1);
  EXPECT_EQ(order.bandwidth.upper, 1);
}

TEST(Ordering, folds_a_periodic_chain_to_twice_the_bandwidth) {
  std::vector<Vector<2>> positions;
  for (int i = 0; i < 20; ++i) {
    positions.push_back({static_cast<double>(i), 0.0});
  }
  const SparsePattern pattern = chain(20, true);
  EXPECT_EQ(column_order<2>(pattern, {positions, 1.0, {20, 0}, 0}, 1).bandwidth.lower, 2);
  // Without knowing of the period the ends lie apart.
  EXPECT_EQ(column_order<2>(pattern, {positions, 1.0, {0, 0}, 0}, 1).bandwidth.lower, 19);
}

TEST(Ordering, keeps_the_unknowns_of_a_node_together) {
  const std::vector<Vector<2>> positions = {{1, 0}, {0, 0}};
  SparsePattern pattern;
  pattern.global_rows = 6;
  for (std::int32_t i = 0; i < 6; ++i) {
    for (std::int32_t j = 0; j < 6; ++j) {
      pattern.columns.push_back(j);
    }
    pattern.first.push_back(6 * (i + 1));
  }
  const Ordering order = column_order<2>(pattern, {positions, 1.0, {0, 0}, 0}, 3);
  EXPECT_THAT(order.place, testing::ElementsAre(3, 4, 5, 0, 1, 2));
}

// Range 3.1: the furthest partner lies three columns on, in the same row, or in another row of a
// nearer column.
TEST(Ordering, a_channel_is_as_narrow_as_its_columns_allow) {
  const auto system = particle_laplacian<2>({40, 9}, ChannelEnds::closed, 0, 1);
  const Ordering order = column_order(*system.matrix.pattern, system.layout(), 1);
  EXPECT_EQ(order.bandwidth.lower, 27);
  EXPECT_EQ(order.bandwidth.upper, 27);
  // Shaken, it is hardly wider.
  const auto shaken = particle_laplacian<2>({40, 9}, ChannelEnds::closed, 0.2, 1);
  EXPECT_LE(column_order(*shaken.matrix.pattern, shaken.layout(), 1).bandwidth.lower, 31U);
}

TEST(Ordering, takes_the_axis_that_gives_the_narrower_band) {
  const auto upright = particle_laplacian<2>({9, 40}, ChannelEnds::closed, 0, 1);
  EXPECT_EQ(column_order(*upright.matrix.pattern, upright.layout(), 1).bandwidth.lower, 27U);
}

TEST(Ordering, refuses_what_does_not_fit) {
  const std::vector<Vector<2>> positions = {{0, 0}, {1, 0}};
  const SparsePattern pattern = chain(3, false);
  EXPECT_THROW(column_order<2>(pattern, {positions, 1.0, {0, 0}, 0}, 1), ParameterError);
  EXPECT_THROW(column_order<2>(chain(2, false), {positions, 0.0, {0, 0}, 0}, 1), ParameterError);
  EXPECT_THROW(column_order<2>(chain(2, false), {positions, 1.0, {0, 0}, 0}, 0), ParameterError);
}

}  // namespace
}  // namespace hemoscale::micro
