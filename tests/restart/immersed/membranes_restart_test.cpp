#include <gtest/gtest.h>
#include <omp.h>

#include "micro/error.hpp"
#include "micro/immersed/direct_membranes.hpp"
#include "micro/immersed/immersed_membranes.hpp"
#include "tests/support/immersed/rings.hpp"

namespace hemoscale::micro {
namespace {

using namespace test;

constexpr double um = 1e-6;

std::vector<Cell> two_rings(AreaLaw area_law) {
  const MembraneParameters parameters{.stretch_modulus = 1e-4, .area_law = area_law};
  const Cell one = ring_cell(
      {.node_spacing = 0.6 * um, .radius = 2.5 * um, .aspect = 1.2, .centre = {4 * um, 5 * um}},
      parameters);
  const Cell other = ring_cell(
      {.node_spacing = 0.6 * um, .radius = 2 * um, .aspect = 1.2, .centre = {12 * um, 4 * um}},
      parameters);
  return {one, other};
}

ImmersedMembranes immersed(Inertia inertia, NodeStepping stepping) {
  FlowDomain<2> domain = channel_nodes(16 * um, 10 * um, true, {.spacing = 0.8 * um});
  domain.acceleration = [](double) { return Vector<2>(100, 0); };
  ImmersedOptions options;
  options.flow.inertia = inertia;
  options.stepping = stepping;
  return {std::move(domain), plasma, options, two_rings(AreaLaw::exact)};
}

ImmersedMembranes unsteady() {
  return immersed(Inertia::unsteady, NodeStepping::adams_bashforth);
}

ImmersedMembranes quasi_steady() {
  return immersed(Inertia::quasi_steady, NodeStepping::forward_euler);
}

// Fast enough to be put in order and wrapped at the joint within the test.
DirectMembranes direct() {
  SemiImplicitOptions options = best_repaired();
  options.speed = 0.1;
  FlowDomain<2> domain = lattice_periodic_channel({.spacing = 0.8 * um}, 16 * um, 9.6 * um, 5000);
  for (std::size_t i = 0; i < domain.particles.size(); ++i) {
    if (domain.particles.kinds[i] == ParticleKind::fluid) domain.particles.velocities[i] = {0.1, 0};
  }
  return {domain, plasma, options, two_rings(AreaLaw::penalty), {}, {.strain = 3, .area = 1}};
}

void expect_same(const Snapshot& a, const Snapshot& b) {
  EXPECT_EQ(a.integers, b.integers);
  for (const auto& [name, values] : a.reals) EXPECT_EQ(values, b.reals.at(name)) << name;
}

template <typename Make>
void continues(const Make& make, double dt) {
  auto whole = make();
  for (int n = 0; n < 12; ++n) whole.step(dt);
  const Snapshot saved = whole.snapshot();
  auto second = make();
  second.restore(saved);
  expect_same(saved, second.snapshot());
  EXPECT_EQ(second.time(), whole.time());
  for (int n = 0; n < 14; ++n) {
    whole.step(dt);
    second.step(dt);
  }
  expect_same(whole.snapshot(), second.snapshot());
}

template <typename Make>
void is_the_same_with_threads(const Make& make, double dt) {
  const int threads = omp_get_max_threads();
  std::vector<Snapshot> ends;
  for (const int count : {1, 2}) {
    omp_set_num_threads(count);
    auto membranes = make();
    for (int n = 0; n < 12; ++n) membranes.step(dt);
    ends.push_back(membranes.snapshot());
  }
  omp_set_num_threads(threads);
  expect_same(ends[0], ends[1]);
}

TEST(ImmersedRestart, continues_with_the_same_bits) {
  continues(unsteady, 2e-5);
  continues(quasi_steady, 5e-5);
}

TEST(ImmersedRestart, does_not_depend_on_the_number_of_threads) {
  is_the_same_with_threads(unsteady, 2e-5);
  is_the_same_with_threads(quasi_steady, 5e-5);
}

TEST(DirectRestart, continues_with_the_same_bits) {
  continues(direct, 3e-6);
}

TEST(DirectRestart, does_not_depend_on_the_number_of_threads) {
  is_the_same_with_threads(direct, 3e-6);
}

TEST(DirectRestart, nodes_are_found_again_in_any_order_of_the_particles) {
  DirectMembranes membranes = direct();
  const std::vector<Cell> before = membranes.cells();
  const std::vector<std::int64_t> identities = membranes.particles().identities;
  for (int n = 0; n < 90; ++n) membranes.step(3e-6);
  EXPECT_NE(membranes.particles().identities, identities);  // particles were put in order
  for (std::size_t c = 0; c < before.size(); ++c) {
    double way = 0;
    for (std::size_t i = 0; i < before[c].positions.size(); ++i) {
      way += membranes.cells()[c].positions[i][0] - before[c].positions[i][0];
    }
    way /= static_cast<double>(before[c].positions.size());
    EXPECT_GT(way, 8 * um);  // the second went beyond the joint
    EXPECT_LT(way, 16 * um);
    // Neighbours stayed neighbours.
    EXPECT_LT(membranes.reports()[c].largest_strain, 1.5);
  }
}

TEST(MembraneSnapshot, of_other_cells_is_refused) {
  ImmersedMembranes membranes = unsteady();
  Snapshot snapshot = membranes.snapshot();
  snapshot.reals["cells.positions"].pop_back();
  EXPECT_THROW(membranes.restore(snapshot), ParameterError);
  snapshot = membranes.snapshot();
  snapshot.integers["cells.nodes"][0] += 1;
  EXPECT_THROW(membranes.restore(snapshot), ParameterError);
  EXPECT_THROW(direct().restore(membranes.snapshot()), ParameterError);
}

}  // namespace
}  // namespace hemoscale::micro
