// Where cells enter: the distribution of 40 000 arrivals against the stated density, by chi
// squared.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "micro/ensemble/flow/inflow_queue.hpp"
#include "micro/ensemble/flow/parallel_flow.hpp"

namespace hemoscale::micro {
namespace {

constexpr double height = 75e-6;  // [m]
constexpr int bins = 25;
constexpr int arrivals = 40000;

double parabola(double s) {
  return s * (1 - s);
}

struct Drawn {
  std::vector<double> places = std::vector<double>(bins, 0);  // counts across the opening
  std::vector<double> angles = std::vector<double>(bins, 0);
};

Drawn draw(const Feed& feed, std::uint64_t seed) {
  VelocityProfile table{.height = height, .velocities = {}};
  for (int k = 0; k <= 16; ++k) table.velocities.push_back(parabola(k / 16.0));
  InflowQueue queue({"inlet", {0, height}, {0, 0}}, feed, std::make_shared<ParallelFlow>(table),
                    seed, 0);
  queue.advance(0, 1e6);
  Drawn drawn;
  for (int k = 0; k < arrivals; ++k) {
    const Arrival arrival = queue.take(1e-12, 0);
    const double s = 1 - arrival.place[1] / height;
    drawn.places[static_cast<std::size_t>(s * bins)] += 1;
    drawn.angles[static_cast<std::size_t>(arrival.angle / (2 * std::acos(-1)) * bins)] += 1;
  }
  return drawn;
}

/// (chi squared - degrees of freedom) over its standard deviation, about normal.
double surprise(const std::vector<double>& counts, const std::vector<double>& masses) {
  double total = 0;
  for (const double mass : masses) total += mass;
  double chi_squared = 0;
  double degrees = -1;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const double expected = arrivals * masses[k] / total;
    if (expected < 1e-9) {
      EXPECT_EQ(counts[k], 0) << k;
      continue;
    }
    chi_squared += (counts[k] - expected) * (counts[k] - expected) / expected;
    degrees += 1;
  }
  return (chi_squared - degrees) / std::sqrt(2 * degrees);
}

/// Mass of the density in each bin, by many points.
std::vector<double> masses(const Feed& feed) {
  std::vector<double> result(bins, 0);
  const int points = 200000;
  for (int k = 0; k < points; ++k) {
    const double s = (k + 0.5) / points;
    if (s * height < feed.clearance || (1 - s) * height < feed.clearance) continue;
    const double size = static_cast<double>(feed.profile.size());
    const double share =
        feed.profile.empty() ? 1 : feed.profile[static_cast<std::size_t>(s * size)];
    result[static_cast<std::size_t>(s * bins)] += share * parabola(s);
  }
  return result;
}

TEST(Arrivals, have_the_density_of_the_flux) {
  for (const std::uint64_t seed : {1U, 2U}) {
    for (const Feed& feed :
         {Feed{.hematocrit = 0.4, .clearance = 0, .profile = {}},
          Feed{.hematocrit = 0.4, .clearance = 5e-6, .profile = {}},
          Feed{.hematocrit = 0.4, .clearance = 3e-6, .profile = {0.2, 1, 1, 4, 1, 0, 0.5}}}) {
      const Drawn drawn = draw(feed, seed);
      EXPECT_LE(std::abs(surprise(drawn.places, masses(feed))), 4) << feed.profile.size();
      EXPECT_LE(std::abs(surprise(drawn.angles, std::vector<double>(bins, 1))), 4);
    }
  }
}

}  // namespace
}  // namespace hemoscale::micro
