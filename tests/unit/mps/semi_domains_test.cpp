#include <gtest/gtest.h>

#include <map>

#include "micro/error.hpp"
#include "micro/mps/inlet_outlet.hpp"
#include "micro/mps/lattice_domains_flows.hpp"
#include "micro/mps/semi_implicit_boundaries.hpp"

namespace hemoscale::micro {
namespace {

template <int dim>
std::map<ParticleKind, int> counts(const FlowDomain<dim>& domain) {
  std::map<ParticleKind, int> found;
  for (const ParticleKind kind : domain.particles.kinds) ++found[kind];
  return found;
}

TEST(LatticeDomains, of_a_channel_have_a_wall_row_and_dummies_behind) {
  const FlowDomain<2> domain =
      lattice_periodic_channel({.spacing = 1, .wall_layers = 3}, 12, 10, 1);
  std::map<ParticleKind, int> found = counts(domain);
  EXPECT_EQ(found[ParticleKind::fluid], 120);
  EXPECT_EQ(found[ParticleKind::wall], 24);
  EXPECT_EQ(found[ParticleKind::dummy], 48);
  const std::vector<double> depths = wall_depths(domain);
  for (std::size_t i = 0; i < domain.particles.size(); ++i) {
    const double y = domain.particles.positions[i].y();
    if (domain.particles.kinds[i] == ParticleKind::fluid) {
      EXPECT_EQ(depths[i], 0);
      continue;
    }
    EXPECT_NEAR(depths[i], y < 0 ? -y : y - 10, 1e-12);
    EXPECT_NEAR(domain.particles.normals[i].y(), y < 0 ? -1 : 1, 1e-12);
  }
}

TEST(LatticeDomains, around_a_disc_are_staircases_with_normals_into_it) {
  const Region<2> outside_disc = [](const Vector<2>& x) { return x.norm() > 4.2; };
  const FlowDomain<2> domain = lattice_around<2>(
      {.spacing = 1}, {.lower = {-10, -10}, .upper = {10, 10}, .periodic = {true, true}},
      outside_disc);
  for (std::size_t i = 0; i < domain.particles.size(); ++i) {
    if (domain.particles.kinds[i] == ParticleKind::fluid) continue;
    const Vector<2>& x = domain.particles.positions[i];
    EXPECT_GT(-domain.particles.normals[i].dot(x.normalized()), 0.7) << x.transpose();
    EXPECT_EQ(domain.particles.kinds[i] == ParticleKind::wall, x.norm() > 2.9) << x.transpose();
  }
}

TEST(LatticeDomains, in_a_pipe_have_walls_all_around) {
  const Region<3> pipe = [](const Vector<3>& x) { return x.tail<2>().norm() < 3; };
  const FlowDomain<3> domain = lattice_around<3>(
      {.spacing = 1, .wall_layers = 2},
      {.lower = {0, -3, -3}, .upper = {5, 3, 3}, .periodic = {true, false, false}}, pipe);
  std::map<ParticleKind, int> found = counts(domain);
  EXPECT_EQ(found[ParticleKind::fluid], 5 * 32);
  EXPECT_GT(found[ParticleKind::wall], 5 * 16);
}

TEST(LatticeDomains, are_refused_when_rows_do_not_fit) {
  EXPECT_THROW(lattice_periodic_channel({.spacing = 1}, 12, 10.5, 1), ParameterError);
  EXPECT_THROW(lattice_periodic_channel({.spacing = 0}, 12, 10, 1), ParameterError);
  EXPECT_THROW(lattice_periodic_channel({.spacing = 1, .disorder = 0.6}, 12, 10, 1),
               ParameterError);
  EXPECT_THROW(lattice_around<2>({.spacing = 1}, {.lower = {0, 0}, .upper = {5, 5}},
                                 [](const Vector<2>&) { return false; }),
               ParameterError);
}

TEST(LatticeDomains, are_disturbed_by_seed_and_number) {
  const Lattice lattice = {.spacing = 1, .disorder = 0.2, .seed = 3};
  const auto places = [](const Lattice& l) {
    return lattice_taylor_green<2>(l, 10, 1).particles.positions;
  };
  EXPECT_EQ(places(lattice), places(lattice));
  Lattice other = lattice;
  other.seed = 4;
  EXPECT_NE(places(lattice), places(other));
  other.disorder = 0;
  double largest = 0;
  for (std::size_t i = 0; i < 100; ++i) {
    largest = std::max(largest, (places(lattice)[i] - places(other)[i]).cwiseAbs().maxCoeff());
  }
  EXPECT_LE(largest, 0.2);
  EXPECT_GT(largest, 0.15);
}

class OpenChannel : public testing::Test {
 protected:
  FlowDomain<2> domain_ = lattice_open_channel({.spacing = 1}, 20, 6, uniform_inflow(1));
  Openings<2> openings_ = find_openings(domain_);
  std::vector<double> depths_ = std::vector<double>(domain_.particles.size(), 0.0);
  ParticleLedger ledger_ = {.next_identity = 1000, .initial = count_moving(domain_.particles)};

  void move(double distance) {
    for (std::size_t i = 0; i < domain_.particles.size(); ++i) {
      const ParticleKind kind = domain_.particles.kinds[i];
      if (kind == ParticleKind::wall || kind == ParticleKind::dummy) continue;
      domain_.particles.positions[i].x() += distance;
    }
  }
};

TEST_F(OpenChannel, has_its_planes_between_rows) {
  ASSERT_EQ(openings_.inlets.size(), 1u);
  ASSERT_EQ(openings_.outlets.size(), 1u);
  EXPECT_DOUBLE_EQ(openings_.inlets[0].plane, 0);
  EXPECT_DOUBLE_EQ(openings_.inlets[0].depth, 4);
  EXPECT_DOUBLE_EQ(openings_.outlets[0].edge, 16);
  EXPECT_DOUBLE_EQ(openings_.outlets[0].plane, 20);
}

TEST_F(OpenChannel, exchanges_a_column_at_each_end_and_keeps_the_balance) {
  EXPECT_FALSE(pass_openings(openings_, domain_.particles, depths_, ledger_));
  const std::size_t size = domain_.particles.size();
  move(0.6);
  EXPECT_TRUE(pass_openings(openings_, domain_.particles, depths_, ledger_));
  EXPECT_EQ(ledger_.entered, 6);
  EXPECT_EQ(ledger_.left, 6);
  EXPECT_EQ(ledger_.next_identity, 1006);
  EXPECT_EQ(domain_.particles.size(), size);
  EXPECT_EQ(depths_.size(), size);
  EXPECT_EQ(count_moving(domain_.particles), ledger_.initial);
  // The new ones stand one spacing behind the former last ones of their rows.
  double furthest = 0;
  for (std::size_t i = 0; i < size; ++i) {
    if (domain_.particles.kinds[i] == ParticleKind::inlet) {
      furthest = std::min(furthest, domain_.particles.positions[i].x());
    }
  }
  EXPECT_NEAR(furthest, -3.5 - 1 + 0.6, 1e-12);
}

TEST_F(OpenChannel, takes_particles_back_from_the_outlet_zone) {
  move(0.6);
  pass_openings(openings_, domain_.particles, depths_, ledger_);
  const int in_zone = counts(domain_)[ParticleKind::outlet];
  move(-0.6);
  EXPECT_TRUE(pass_openings(openings_, domain_.particles, depths_, ledger_));
  EXPECT_EQ(counts(domain_)[ParticleKind::outlet], in_zone - 6);
}

}  // namespace
}  // namespace hemoscale::micro
