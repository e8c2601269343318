#include <gtest/gtest.h>

#include <limits>

#include "micro/ensemble/interpenetration.hpp"
#include "micro/ensemble/observables/contacts.hpp"
#include "micro/ensemble/observables/stress_profile.hpp"
#include "tests/support/micro/ensemble_observables.hpp"

namespace hemoscale::micro {
namespace {

/// Repels with unit stiffness below 0.5, attracts with a tenth of it up to 1.
const PairLaw law{
    .force_over_distance = [](double s) { return s < 0.25 ? 1.0 : (s < 1 ? -0.1 : 0.0); },
    .rest_distance = 0.5,
    .cutoff = 1};

Contacts contacts_of(const EnsembleState& state, const Box& box) {
  NeighbourList list;
  list.build(state, box, std::max(law.cutoff, longest_segment(state)));
  return count_contacts(state, box, list, law);
}

// Squares with nodes at their corners; sides of 2, in a channel of 12 x 10.
const Box channel{.length = 12, .height = 10, .walls = true};

TEST(Contacts, of_two_squares_face_to_face) {
  // Two node pairs at 0.4, across the seam; the third square has two pairs at 0.8 with the second.
  const Contacts found =
      contacts_of(test::rectangles({{10.6, 2}, {1, 2}, {3.8, 2}}, 2, 2), channel);
  EXPECT_EQ(found.pairs_within_cutoff, 4U);
  EXPECT_EQ(found.pairs_within_rest, 2U);
  EXPECT_EQ(found.cells_in_contact, 2U);
  EXPECT_NEAR(found.coordination, 4.0 / 3, 1e-14);
  EXPECT_NEAR(found.closest, 0.4, 1e-13);
  EXPECT_EQ(found.nodes_inside, 0U);
}

TEST(Contacts, of_lonely_cells_are_none) {
  const Contacts found = contacts_of(test::rectangles({{1, 1}, {6, 6}}, 2, 2), channel);
  EXPECT_EQ(found.pairs_within_cutoff, 0U);
  EXPECT_EQ(found.cells_in_contact, 0U);
  EXPECT_EQ(found.coordination, 0);
  EXPECT_EQ(found.closest, std::numeric_limits<double>::infinity());
}

TEST(Contacts, find_overlap_as_the_plain_count_does) {
  const EnsembleState state = test::ellipses(
      {{{2, 3}, 2, 1, 0.2}, {{5, 3.3}, 2, 1, 0.1}, {{11.3, 3}, 2, 1, 0}, {{6, 8}, 2, 1, 0}}, 32);
  const std::size_t plain = count_interpenetrating_nodes(state, channel);
  EXPECT_GT(plain, 0U);
  EXPECT_EQ(contacts_of(state, channel).nodes_inside, plain);
}

TEST(PairParts, tell_repulsion_from_attraction) {
  const EnsembleState state = test::rectangles({{1, 2}, {3.3, 2}, {6.1, 2}}, 2, 2);
  NeighbourList list;
  list.build(state, channel, 2);
  const PairParts parts = pair_parts(state, channel, list, law);
  EXPECT_NEAR(parts.repulsion.x[1], -0.3, 1e-14);   // right side of the first, 0.3 to the second
  EXPECT_NEAR(parts.repulsion.x[4], 0.3, 1e-14);    // left side of the second
  EXPECT_NEAR(parts.attraction.x[5], 0.08, 1e-14);  // right side of the second, 0.8 to the third
  EXPECT_NEAR(parts.attraction.x[8], -0.08, 1e-14);
  EXPECT_EQ(parts.attraction.x[1], 0);
  EXPECT_EQ(parts.repulsion.x[5], 0);
}

// A dumbbell between two heights transmits its tension through the planes between them alone.
TEST(PlaneStress, of_a_dumbbell_is_its_tension_per_length) {
  EnsembleState state;
  state.cells = 1;
  state.nodes = 2;
  state.x = {1, 1};
  state.y = {1.5, 4};
  const std::vector<double> force = {6, -6};  // drawn together
  const auto stress = plane_stress(state, force, 12, {.height = 5, .count = 5});
  EXPECT_NEAR(stress[0], 0, 1e-15);
  EXPECT_NEAR(stress[1], 0.5 * 6 / 12, 1e-15);
  EXPECT_NEAR(stress[2], 6.0 / 12, 1e-15);
  EXPECT_NEAR(stress[3], 6.0 / 12, 1e-15);
  EXPECT_NEAR(stress[4], 0, 1e-15);
}

TEST(PlaneStress, counts_nodes_beyond_a_wall_fully_or_not_at_all) {
  EnsembleState state;
  state.cells = 1;
  state.nodes = 2;
  state.x = {1, 1};
  state.y = {-1, 6};
  const auto stress =
      plane_stress(state, std::vector<double>{6, -6}, 12, {.height = 5, .count = 5});
  for (const double value : stress) EXPECT_NEAR(value, 0.5, 1e-15);
}

TEST(MembraneStresslet, of_a_stretched_dumbbell_is_positive) {
  const EnsembleState state = test::rectangles({{0, 0}}, 4, 1);
  const std::vector<double> fx = {1, -1, -1, 1};
  const std::vector<double> fy(4, 0.0);
  const auto stresslets = membrane_stresslets(state, measure_cells(state), {fx, fy});
  EXPECT_NEAR(stresslets[0](0, 0), 4 * 2, 1e-14);
  EXPECT_NEAR(stresslets[0](1, 1), 0, 1e-14);
}

}  // namespace
}  // namespace hemoscale::micro
