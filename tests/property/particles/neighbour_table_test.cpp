#include "micro/particles/neighbour_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <omp.h>

#include <limits>

#include "micro/error.hpp"
#include "micro/particles/rearrange.hpp"
#include "micro/random/philox.hpp"

namespace hemoscale::micro {
namespace {

using testing::HasSubstr;

template <int dim>
std::vector<Vector<dim>> random_points(std::size_t count, const PeriodicBox<dim>& box,
                                       std::uint64_t seed, double overshoot = 0) {
  std::vector<Vector<dim>> points(count);
  for (std::size_t i = 0; i < count; ++i) {
    for (int axis = 0; axis < dim; ++axis) {
      const double s =
          uniform({.seed = seed, .stream = static_cast<std::uint64_t>(axis), .counter = i});
      points[i][axis] = box.lower[axis] +
                        (box.upper[axis] - box.lower[axis]) * (s * (1 + 2 * overshoot) - overshoot);
    }
  }
  return points;
}

/// All pairs, images tried one by one.
template <int dim>
std::vector<std::vector<std::int32_t>> brute_force(const std::vector<Vector<dim>>& points,
                                                   const PeriodicBox<dim>& box, double range) {
  std::vector<std::vector<std::int32_t>> rows(points.size());
  const Vector<dim> extent = box.extent();
  const auto reach = [&](int axis) { return box.periodic[static_cast<std::size_t>(axis)] ? 3 : 0; };
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = 0; j < points.size(); ++j) {
      if (i == j) continue;
      bool near = false;
      for (int a = -reach(0); a <= reach(0); ++a) {
        for (int b = -reach(1); b <= reach(1); ++b) {
          const int depth = dim == 3 ? reach(dim - 1) : 0;
          for (int c = -depth; c <= depth; ++c) {
            Vector<dim> d = points[j] - points[i];
            d[0] += a * extent[0] + b * box.slide;
            d[1] += b * extent[1];
            if constexpr (dim == 3) d[2] += c * extent[2];
            near = near || d.norm() < range;
          }
        }
      }
      if (near) rows[i].push_back(static_cast<std::int32_t>(j));
    }
  }
  return rows;
}

template <int dim>
void expect_all_pairs(const PeriodicBox<dim>& box, double range, double overshoot = 0) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const auto points = random_points<dim>(300, box, seed, overshoot);
    const auto expected = brute_force<dim>(points, box, range);
    NeighbourTable table;
    table.build<dim>(points, box, range * 0.8, range * 0.2);
    ASSERT_EQ(table.size(), points.size());
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto row = table.of(i);
      ASSERT_EQ(std::vector<std::int32_t>(row.begin(), row.end()), expected[i])
          << "particle " << i << ", seed " << seed;
    }
  }
}

TEST(NeighbourTable, holds_all_pairs_of_open_sets) {
  expect_all_pairs<2>({.lower = {0, 0}, .upper = {3, 2}}, 0.4);
  expect_all_pairs<3>({.lower = {0, 0, 0}, .upper = {2, 1, 1}}, 0.5);
}

TEST(NeighbourTable, holds_all_pairs_across_periodic_faces_and_wraps_strays) {
  expect_all_pairs<2>({.lower = {-1, 0}, .upper = {2, 2}, .periodic = {true, false}}, 0.4, 0.0);
  expect_all_pairs<2>({.lower = {-1, 0}, .upper = {2, 2}, .periodic = {true, true}}, 0.4, 0.3);
  expect_all_pairs<3>({.lower = {0, 0, 0}, .upper = {1.5, 1.2, 1}, .periodic = {true, true, true}},
                      0.45);
}

TEST(NeighbourTable, holds_all_pairs_of_a_sheared_box) {
  for (const double slide : {-0.7, 0.01, 1.3, 2.9}) {
    expect_all_pairs<2>(
        {.lower = {0, 0}, .upper = {3, 2}, .periodic = {true, true}, .slide = slide}, 0.4);
  }
}

TEST(NeighbourTable, is_the_same_for_any_number_of_threads) {
  const PeriodicBox<2> box{.lower = {0, 0}, .upper = {3, 2}, .periodic = {true, false}};
  const auto points = random_points<2>(9000, box, 7);
  const int threads = omp_get_max_threads();
  std::vector<NeighbourTable> tables(3);
  for (int t = 1; t <= 3; ++t) {
    omp_set_num_threads(t);
    tables[static_cast<std::size_t>(t - 1)].build<2>(points, box, 0.06);
  }
  omp_set_num_threads(threads);
  EXPECT_GT(tables[0].pairs(), 9000U);
  EXPECT_EQ(tables[0].neighbours(), tables[1].neighbours());
  EXPECT_EQ(tables[0].neighbours(), tables[2].neighbours());
}

TEST(NeighbourTable, is_complete_until_a_particle_has_moved_half_of_the_skin) {
  const PeriodicBox<2> box{.lower = {0, 0}, .upper = {3, 2}, .periodic = {true, false}};
  const auto before = random_points<2>(50, box, 4);
  NeighbourTable table;
  table.build<2>(before, box, 0.3, 0.2);
  auto after = before;
  after[17][0] += 0.0999;
  EXPECT_TRUE(table.is_complete<2>(before, after, box));
  after[17][0] += 0.0002;
  EXPECT_FALSE(table.is_complete<2>(before, after, box));
  after[17][0] = before[17][0] + 3;  // an image of the same place
  EXPECT_TRUE(table.is_complete<2>(before, after, box));
  after[17][0] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(table.is_complete<2>(before, after, box));
}

TEST(NeighbourTable, names_a_particle_without_a_finite_position) {
  std::vector<Vector<2>> points = {{0, 0}, {1, 1}, {std::numeric_limits<double>::infinity(), 0}};
  NeighbourTable table;
  try {
    table.build<2>(points, {}, 0.5);
    FAIL() << "no error";
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), HasSubstr("particle 2"));
  }
}

TEST(NeighbourTable, refuses_a_periodic_extent_below_twice_the_range) {
  const PeriodicBox<2> box{.lower = {0, 0}, .upper = {1, 1}, .periodic = {false, true}};
  NeighbourTable table;
  EXPECT_NO_THROW(table.build<2>({{0.1, 0.1}}, box, 0.4, 0.1));
  EXPECT_THROW(table.build<2>({{0.1, 0.1}}, box, 0.4, 0.11), ParameterError);
}

TEST(Rearrange, moves_every_array_and_removes_what_is_left_out) {
  ParticleSet<2> particles;
  for (int i = 0; i < 4; ++i) {
    particles.append({i, 2 * i}, 10 + i, i == 2 ? ParticleKind::wall : ParticleKind::fluid, i,
                     {0, i}, i);
    particles.velocities.back() = {3 * i, 0};
    particles.pressures.back() = 7 * i;
  }
  rearrange(particles, {2, 0, 3});
  ASSERT_EQ(particles.size(), 3U);
  EXPECT_EQ(particles.identities, (std::vector<std::int64_t>{12, 10, 13}));
  EXPECT_EQ(particles.kinds.front(), ParticleKind::wall);
  EXPECT_EQ(particles.patches, (std::vector<std::int32_t>{2, 0, 3}));
  EXPECT_EQ(particles.positions[2], Vector<2>(3, 6));
  EXPECT_EQ(particles.velocities[0], Vector<2>(6, 0));
  EXPECT_EQ(particles.pressures, (std::vector<double>{14, 0, 21}));
  EXPECT_EQ(particles.normals[2], Vector<2>(0, 3));
  EXPECT_EQ(particles.measures, (std::vector<double>{2, 0, 3}));
}

TEST(SpatialOrder, runs_row_by_row_and_is_a_permutation) {
  const std::vector<Vector<2>> points = {
      {2.5, 1.5}, {0.5, 0.5}, {0.5, 1.5}, {2.5, 0.5}, {0.6, 0.4}};
  EXPECT_EQ(spatial_order<2>(points, 1), (std::vector<std::int32_t>{1, 4, 3, 2, 0}));
}

}  // namespace
}  // namespace hemoscale::micro
