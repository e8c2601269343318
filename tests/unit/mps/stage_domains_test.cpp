#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "micro/error.hpp"
#include "micro/mps/node_domains.hpp"

namespace hemoscale::micro {
namespace {

template <int dim>
std::size_t count_of(const FlowDomain<dim>& domain, ParticleKind kind) {
  return static_cast<std::size_t>(
      std::count(domain.particles.kinds.begin(), domain.particles.kinds.end(), kind));
}

template <int dim>
double measure_of(const FlowDomain<dim>& domain, std::int32_t patch) {
  double sum = 0;
  for (std::size_t i = 0; i < domain.particles.size(); ++i) {
    if (domain.particles.patches[i] == patch) sum += domain.particles.measures[i];
  }
  return sum;
}

TEST(NodeDomains, channel_of_the_paper_has_161_by_21_nodes) {
  const auto domain = channel_nodes(80e-6, 10e-6, false, {.spacing = 0.5e-6});
  EXPECT_EQ(domain.particles.size(), 161U * 21U);
  EXPECT_EQ(count_of(domain, ParticleKind::inlet), 19U);
  EXPECT_EQ(count_of(domain, ParticleKind::outlet), 19U);
  EXPECT_EQ(count_of(domain, ParticleKind::wall), 322U);
  EXPECT_NEAR(measure_of(domain, lower_wall), 80e-6, 1e-12);
  EXPECT_NEAR(measure_of(domain, upper_wall), 80e-6, 1e-12);
}

TEST(NodeDomains, disorder_is_seeded_bounded_and_leaves_boundaries_alone) {
  const auto even = channel_nodes(2, 1, false, {.spacing = 0.1});
  const auto one = channel_nodes(2, 1, false, {.spacing = 0.1, .disorder = 0.2, .seed = 1});
  const auto same = channel_nodes(2, 1, false, {.spacing = 0.1, .disorder = 0.2, .seed = 1});
  const auto other = channel_nodes(2, 1, false, {.spacing = 0.1, .disorder = 0.2, .seed = 2});
  EXPECT_EQ(one.particles.positions, same.particles.positions);
  EXPECT_NE(one.particles.positions, other.particles.positions);
  double largest = 0;
  for (std::size_t i = 0; i < even.particles.size(); ++i) {
    const double moved =
        (one.particles.positions[i] - even.particles.positions[i]).cwiseAbs().maxCoeff();
    if (even.particles.kinds[i] != ParticleKind::fluid) {
      EXPECT_EQ(moved, 0);
    }
    largest = std::max(largest, moved);
  }
  EXPECT_LE(largest, 0.02);
  EXPECT_GT(largest, 0.018);
}

TEST(NodeDomains, outlines_bear_nodes_with_normals_out_of_the_fluid) {
  const auto domain = cylinder_nodes(3, 1, 0.2, 1.5, false, {.spacing = 0.05});
  const Vector<2> centre(1.5, 0.5);
  EXPECT_NEAR(measure_of(domain, 4), 2 * M_PI * 0.2, 1e-3);
  for (std::size_t i = 0; i < domain.particles.size(); ++i) {
    const Vector<2>& x = domain.particles.positions[i];
    const double r = (x - centre).norm();
    if (domain.particles.patches[i] == 4) {
      EXPECT_NEAR(r, 0.2, 1e-4);
      EXPECT_LT(domain.particles.normals[i].dot(x - centre), -0.19);
    } else if (domain.particles.kinds[i] == ParticleKind::fluid) {
      EXPECT_GT(r, 0.2 + 0.6 * 0.05 - 1e-4);
      EXPECT_GT(x[1], 0);
      EXPECT_LT(x[1], 1);
    }
  }
}

TEST(NodeDomains, periodic_channel_with_a_cylinder_keeps_its_lattice) {
  const auto domain = cylinder_nodes(3, 1, 0.2, 1.5, true, {.spacing = 0.05});
  EXPECT_TRUE(domain.box.periodic[0]);
  EXPECT_EQ(count_of(domain, ParticleKind::inlet), 0U);
  EXPECT_NEAR(measure_of(domain, 4), 2 * M_PI * 0.2, 1e-3);
}

TEST(NodeDomains, constriction_and_bifurcation_have_their_shapes) {
  const auto narrow = constriction_nodes(6, 1, 0.5, 2, {.spacing = 0.05});
  const auto split = bifurcation_nodes(6, 2, 3, 0.5, {.spacing = 0.05});
  for (const auto& x : narrow.particles.positions) {
    if (std::abs(x[0] - 3) < 0.02) {
      EXPECT_GE(x[1], 0.25 - 1e-3);
      EXPECT_LE(x[1], 0.75 + 1e-3);
    }
  }
  std::size_t in_divider = 0;
  for (const auto& x : split.particles.positions) {
    if (x[0] > 3.3 && std::abs(x[1] - 1) < 0.24) ++in_divider;
  }
  EXPECT_EQ(in_divider, 0U);
  EXPECT_NEAR(measure_of(split, outlet_patch), measure_of(split, 5), 1e-9);
  EXPECT_EQ(split.patches[5].kind, ParticleKind::outlet);
}

TEST(NodeDomains, pipe_wall_has_its_area) {
  const auto domain = pipe_nodes(2, 0.5, false, {.spacing = 0.1});
  EXPECT_NEAR(measure_of(domain, 0), 2 * M_PI * 0.5 * 2, 1e-9);
}

TEST(NodeDomains, refuse_what_makes_no_domain) {
  EXPECT_THROW(channel_nodes(1, 1, true, {.spacing = 0}), ParameterError);
  EXPECT_THROW(channel_nodes(1, 1, true, {.spacing = 0.1, .disorder = 0.5}), ParameterError);
  EXPECT_NO_THROW(channel_nodes(1, 1, true, {.spacing = 0.25}));
  EXPECT_THROW(channel_nodes(1, 0.9, true, {.spacing = 0.25}), ParameterError);
  EXPECT_THROW(cylinder_nodes(3, 1, 0.45, 1.5, false, {.spacing = 0.05}), ParameterError);
  EXPECT_THROW(cylinder_nodes(3, 1, 0.2, 0.25, false, {.spacing = 0.05}), ParameterError);
  EXPECT_THROW(constriction_nodes(6, 1, 0.15, 2, {.spacing = 0.05}), ParameterError);
  EXPECT_THROW(constriction_nodes(6, 1, 1.5, 2, {.spacing = 0.05}), ParameterError);
  EXPECT_THROW(bifurcation_nodes(6, 2, 3, 0.1, {.spacing = 0.05}), ParameterError);
  const OutlineLoop open = {{0, {{0, 0}, {1, 0}}}, {0, {{1, 0}, {1, 1}}}};
  const std::vector<Patch<2>> walls(1);
  EXPECT_THROW(outline_nodes({open}, walls, {.spacing = 0.1}), ParameterError);
}

}  // namespace
}  // namespace hemoscale::micro
