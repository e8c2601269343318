#include "micro/linear/sparse_matrix.hpp"

#include <gtest/gtest.h>

#include "tests/support/linear/model_systems.hpp"

namespace hemoscale::micro {
namespace {

TEST(SparseMatrix, finds_entries_by_row_and_column) {
  const SparseMatrix a = sparse({{1, 0, 2}, {0, 3, 0}, {4, 0, 5}});
  EXPECT_EQ(a.values[a.pattern->entry(0, 2)], 2);
  EXPECT_EQ(a.values[a.pattern->entry(2, 0)], 4);
  EXPECT_EQ(a.values[a.pattern->entry(2, 2)], 5);
  EXPECT_TRUE(a.pattern->is_whole());
}

TEST(SparseMatrix, a_new_one_on_a_pattern_is_zero_and_shares_it) {
  const SparseMatrix a = sparse({{1, 2}, {0, 3}});
  const SparseMatrix b(a.pattern);
  EXPECT_EQ(b.values, std::vector<double>({0, 0, 0}));
  EXPECT_EQ(a.pattern, b.pattern);
}

TEST(SparseMatrix, multiplies) {
  const SparseMatrix a = sparse({{1, 0, 2}, {0, 3, 0}, {4, 0, 5}});
  const std::vector<double> x = {1, 10, 100};
  std::vector<double> y(3);
  multiply(a, x, y);
  EXPECT_EQ(y, std::vector<double>({201, 30, 504}));
}

TEST(SparseMatrix, multiplies_the_rows_that_a_rank_holds) {
  auto pattern = std::make_shared<SparsePattern>();
  pattern->row_begin = 1;
  pattern->global_rows = 3;
  pattern->columns = {0, 1, 2};
  pattern->first = {0, 3};
  SparseMatrix a(pattern);
  a.values = {1, 2, 3};
  EXPECT_FALSE(pattern->is_whole());
  std::vector<double> y(1);
  multiply(a, std::vector<double>({1, 10, 100}), y);
  EXPECT_EQ(y[0], 321);
}

TEST(SparseMatrix, dot_sums_every_product_of_any_length) {
  for (const std::size_t n : {0UL, 1UL, 7UL, 8UL, 9UL, 4096UL, 4097UL, 20011UL}) {
    std::vector<double> a(n);
    std::vector<double> b(n, 2.0);
    double expected = 0;
    for (std::size_t i = 0; i < n; ++i) {
      a[i] = static_cast<double>(i % 100);  // sums of integers are exact
      expected += 2 * a[i];
    }
    EXPECT_EQ(dot(a, b), expected) << n;
  }
}

}  // namespace
}  // namespace hemoscale::micro
