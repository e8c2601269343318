#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "micro/error.hpp"
#include "micro/immersed/direct_membranes.hpp"
#include "tests/support/immersed/rings.hpp"

namespace hemoscale::micro {
namespace {

using testing::HasSubstr;
using namespace test;

constexpr double um = 1e-6;

FlowDomain<2> channel() {
  return lattice_periodic_channel({.spacing = 0.5 * um}, 10 * um, 10 * um, 0);
}

Cell ring() {
  return ring_cell({.node_spacing = 0.33 * um, .radius = 3 * um, .centre = {5 * um, 5 * um}}, {});
}

TEST(Insertion, puts_nodes_where_they_are_and_makes_room_for_them) {
  FlowDomain<2> domain = channel();
  for (std::size_t i = 0; i < domain.particles.size(); ++i) {
    if (domain.particles.kinds[i] == ParticleKind::fluid) domain.particles.velocities[i] = {0.3, 0};
  }
  const std::vector<Cell> cells = {ring()};
  const InsertedMembranes inserted = insert_membranes(domain, cells, {}, 2.1, 3.1);
  const ParticleSet<2>& particles = inserted.domain.particles;
  const std::size_t nodes = cells[0].positions.size();
  ASSERT_EQ(particles.size() + inserted.removed, domain.particles.size() + nodes);
  const std::size_t first = particles.size() - nodes;
  for (std::size_t i = 0; i < nodes; ++i) {
    EXPECT_EQ(particles.positions[first + i], cells[0].positions[i]);
    EXPECT_EQ(particles.identities[first + i],
              inserted.first_identity + static_cast<std::int64_t>(i));
    EXPECT_EQ(particles.velocities[first + i], Vector<2>(0.3, 0));
    EXPECT_EQ(inserted.domain.patches[static_cast<std::size_t>(particles.patches[first + i])].kind,
              ParticleKind::fluid);
  }
  const InsertedMembranes crowded =
      insert_membranes(domain, cells, {.clearance = 0.2, .sweeps = 0}, 2.1, 3.1);
  EXPECT_LT(inserted.deviation, 0.2);
  EXPECT_GT(crowded.deviation, 2 * inserted.deviation);
}

TEST(Insertion, of_two_cells_and_of_one_where_there_is_no_plasma) {
  Cell small =
      ring_cell({.node_spacing = 0.33 * um, .radius = 1 * um, .centre = {2 * um, 2 * um}}, {});
  Cell other = small;
  for (Vector<2>& x : other.positions) x[0] += 4 * um;
  const InsertedMembranes inserted = insert_membranes(channel(), {small, other}, {}, 2.1, 3.1);
  EXPECT_EQ(inserted.domain.patches.size(), channel().patches.size() + 2);
  for (Vector<2>& x : small.positions) x[1] += 30 * um;
  EXPECT_THROW(insert_membranes(channel(), {small}, {}, 2.1, 3.1), ParameterError);
}

SemiImplicitOptions options() {
  SemiImplicitOptions options = best_repaired();
  options.speed = 0.01;
  return options;
}

TEST(DirectMembranes, refuse_what_they_cannot_hold) {
  const auto refusal = [](const MembraneParameters& parameters, double ratio) -> std::string {
    Cell cell = ring_cell({.node_spacing = 0.33 * um, .radius = 3 * um, .centre = {5 * um, 5 * um}},
                          parameters);
    cell.viscosity_ratio = ratio;
    try {
      DirectMembranes(channel(), plasma, options(), {cell});
    } catch (const ParameterError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(refusal({}, 1), "");
  EXPECT_THAT(refusal({}, 5), HasSubstr("viscosity ratio is 5"));
  EXPECT_THAT(refusal({.area_law = AreaLaw::exact}, 1), HasSubstr("implicit coupling"));
  EXPECT_THAT(refusal({.stretch_law = StretchLaw::inextensible}, 1),
              HasSubstr("implicit coupling"));
}

TEST(DirectMembranes, are_never_shifted_and_push_with_their_whole_force) {
  // At rest, noise aside: the plasma around the ring is uneven and shifts, the nodes stay.
  DirectMembranes membranes(channel(), plasma, options(), {ring()}, {.sweeps = 0});
  const std::vector<Vector<2>> before = membranes.particles().positions;
  membranes.step(1e-7);
  double plasma_way = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    plasma_way = std::max(plasma_way, (membranes.particles().positions[i] - before[i]).norm());
  }
  double node_way = 0;
  for (std::size_t i = 0; i < ring().positions.size(); ++i) {
    node_way = std::max(node_way, (membranes.cells()[0].positions[i] - ring().positions[i]).norm());
  }
  EXPECT_GT(plasma_way, 1e-2 * um);
  EXPECT_LT(node_way, 1e-6 * um);
}

TEST(DirectMembranes, a_cell_that_reaches_the_outlet_ends_the_run) {
  SemiImplicitOptions fast = options();
  fast.speed = 0.1;
  const FlowDomain<2> open = lattice_open_channel({.spacing = 1 * um, .wall_layers = 4}, 24 * um,
                                                  12 * um, uniform_inflow(0.1));
  const Cell cell =
      ring_cell({.node_spacing = 0.7 * um, .radius = 3 * um, .centre = {14 * um, 6 * um}},
                {.stretch_modulus = 1e-4});
  DirectMembranes membranes(open, plasma, fast, {cell}, {}, {.strain = 3, .area = 1});
  try {
    for (int n = 0; n < 60; ++n) membranes.step(1e-6);
    FAIL() << "not noticed";
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("cell 0"), HasSubstr("from an opening")));
  }
  const std::int64_t steps = membranes.steps();
  EXPECT_GT(steps, 5);
  EXPECT_THROW(membranes.step(1e-6), NumericalError);  // the last good state is kept
  EXPECT_EQ(membranes.steps(), steps);
}

TEST(Openings, do_not_take_particles_of_a_membrane) {
  // Without the watch of the cells: a single particle of a patch of the fluid before the outlet.
  SemiImplicitOptions fast = options();
  fast.speed = 0.1;
  FlowDomain<2> open = lattice_open_channel({.spacing = 1 * um, .wall_layers = 4}, 16 * um, 8 * um,
                                            uniform_inflow(0.1));
  const auto patch = static_cast<std::int32_t>(open.patches.size());
  open.patches.push_back({.name = "membrane", .kind = ParticleKind::fluid});
  std::int64_t tied = -1;
  for (std::size_t i = 0; i < open.particles.size(); ++i) {
    const Vector<2>& x = open.particles.positions[i];
    const bool is_there =
        std::abs(x[0] - 11.5 * um) < 0.1 * um && std::abs(x[1] - 3.5 * um) < 0.1 * um;
    if (!is_there) continue;
    open.particles.patches[i] = patch;
    tied = open.particles.identities[i];
  }
  ASSERT_GE(tied, 0);
  SemiImplicitStepper<2> stepper(open, plasma, fast);
  try {
    for (int n = 0; n < 60; ++n) stepper.step(1e-6);
    FAIL() << "taken";
  } catch (const NumericalError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(HasSubstr("membrane (patch " + std::to_string(patch)),
                                             HasSubstr("outlet"), HasSubstr("step ")));
  }
}

}  // namespace
}  // namespace hemoscale::micro
