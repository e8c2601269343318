// From the keys of an ensemble on vectors to kinds of cells, laws and options.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <numbers>

#include "coupling/scene/ensemble_kinds.hpp"

#include "tests/unit/config/case_text.hpp"

namespace hemoscale::coupling {
namespace {

using micro::blocks::Integrator;
using micro::blocks::KindSettings;

Settings channel(const std::string& more) {
  return settings_of(
      "case.name = \"a\"\ncase.seed = 5\nscene.kind = \"micro\"\nfluid.hematocrit = 0.4\n[micro]\n"
      "domain = \"channel\"\nnodes = 50\nchannel.height = \"30 um\"\nmean_velocity = \"1 mm/s\"\n"
      "duration = \"1 s\"\noutput_interval = \"1 s\"\n" +
      more);
}

TEST(EnsembleKinds, share_drag_and_mass_of_a_cell) {
  const EnsembleKinds all =
      build_kinds(channel("integrator = \"inertial\"\ninertia.cell_mass = \"2e-8 kg/m\"\n"
                          "drag.momentum = \"1e-3 kg/m^2\"\ndrag.coefficient = 10\n"));
  ASSERT_EQ(all.kinds.size(), 1U);
  const KindSettings& red = all.kinds.front();
  EXPECT_DOUBLE_EQ(red.node_mass, 2e-8 / 50);
  EXPECT_DOUBLE_EQ(red.momentum_drag, 1e-3 / 50);
  EXPECT_DOUBLE_EQ(red.node_drag, 10 * 1.2e-3 / 50);
  EXPECT_EQ(red.normal_drag, 1);
}

TEST(EnsembleKinds, give_every_node_its_own_drag) {
  const KindSettings red =
      build_kinds(channel("integrator = \"inertial\"\n"
                          "drag.convention = \"node\"\ndrag.coefficient = 0.2\n"
                          "drag.momentum = \"1e-3 kg/m^2\"\n"))
          .kinds.front();
  EXPECT_DOUBLE_EQ(red.node_drag, 0.2 * 1.2e-3);
  EXPECT_DOUBLE_EQ(red.momentum_drag, 1e-3);
  EXPECT_DOUBLE_EQ(red.node_mass, 1050 * red.mesh.rest_area / 50);
}

TEST(EnsembleKinds, have_mass_with_the_inertial_integrator_alone) {
  const KindSettings red = build_kinds(channel("integrator = \"chebyshev\"\n"
                                               "drag.normal_ratio = 2\n"))
                               .kinds.front();
  EXPECT_EQ(red.node_mass, 0);
  EXPECT_EQ(red.momentum_drag, 0);
  EXPECT_EQ(red.normal_drag, 2);
}

TEST(EnsembleKinds, make_platelets_as_dense_as_red_cells) {
  const EnsembleKinds all =
      build_kinds(channel("cells = 8\nplatelets.per_cell = 0.5\nplatelets.nodes = 20\n"
                          "integrator = \"inertial\"\ndrag.momentum = \"1e-3 kg/m^2\"\n"));
  ASSERT_EQ(all.kinds.size(), 2U);
  EXPECT_EQ(all.names, (std::vector<std::string>{"red cells", "platelets"}));
  const KindSettings& red = all.kinds[0];
  const KindSettings& platelet = all.kinds[1];
  EXPECT_NEAR(platelet.node_mass * 20 / platelet.mesh.rest_area, 1050, 1e-9);
  EXPECT_NEAR(platelet.momentum_drag / platelet.node_drag, red.momentum_drag / red.node_drag,
              1e-12);
  EXPECT_EQ(all.outlines[1].size(), 20U);
}

TEST(EnsembleKinds, know_every_integrator) {
  const auto named = [](const std::string& name) {
    return block_integrator(channel("integrator = \"" + name + "\"\n"));
  };
  EXPECT_EQ(named("explicit"), Integrator::explicit_euler);
  EXPECT_EQ(named("linearly-implicit"), Integrator::linearly_implicit);
  EXPECT_EQ(named("constant-operator"), Integrator::constant_operator);
  EXPECT_EQ(named("constant-operator-2"), Integrator::constant_operator_second_order);
  EXPECT_EQ(named("inertial"), Integrator::inertial);
  EXPECT_EQ(named("chebyshev"), Integrator::chebyshev);
  EXPECT_EQ(integrator_name(channel("")), "constant-operator-2");
}

TEST(EnsembleKinds, choose_the_law_of_contact) {
  const auto polynomial = std::get<micro::PairPotential>(
      contact_law(channel("contact.stiffness = \"3 Pa\"\ncontact.attraction = 0.2\n")));
  EXPECT_NEAR(micro::stiffness_at_rest(polynomial), 3, 1e-12);
  EXPECT_EQ(polynomial.attraction, 0.2);
  const auto morse = std::get<micro::MorsePotential>(
      contact_law(channel("contact.law = \"morse\"\ncontact.morse.energy_scale = \"2e-14 N\"\n"
                          "contact.morse.steepness = \"1e7 1/m\"\n")));
  EXPECT_DOUBLE_EQ(morse.energy_scale, 2e-14);
  EXPECT_DOUBLE_EQ(morse.steepness, 1e7);
  EXPECT_DOUBLE_EQ(morse.rest_distance, 0.5e-6);
  EXPECT_DOUBLE_EQ(morse.cutoff, 0.8e-6);
  const std::string jones =
      "contact.law = \"lennard-jones\"\ncontact.lennard_jones.energy_scale = \"2e-14 N\"\n";
  const auto by_default = std::get<micro::LennardJonesPotential>(contact_law(channel(jones)));
  EXPECT_DOUBLE_EQ(by_default.energy_scale, 2e-14);
  EXPECT_DOUBLE_EQ(by_default.core, 0.45e-6);
  const auto given = std::get<micro::LennardJonesPotential>(
      contact_law(channel(jones + "contact.lennard_jones.core = \"0.3 um\"\n")));
  EXPECT_DOUBLE_EQ(given.core, 0.3e-6);
}

TEST(EnsembleKinds, migrate_by_the_laws_that_are_on) {
  const auto mesh = build_kinds(channel("")).kinds.front().mesh;
  const double radius = mesh.rest_perimeter / (2 * std::numbers::pi);
  EXPECT_FALSE(build_migration(channel(""), mesh, 200).is_any());
  EXPECT_TRUE(optional_laws(channel("")).empty());
  const Settings all = channel(
      "migration.wall_lift = 0.1\nmigration.shear_lift = 0.15\nmigration.shear_diffusion = 0.2\n");
  const micro::LateralMigration laws = build_migration(all, mesh, 200);
  ASSERT_TRUE(laws.wall_lift && laws.shear_lift && laws.shear_diffusion);
  EXPECT_DOUBLE_EQ(laws.wall_lift->coefficient, 0.1 * 200 * radius * radius * radius);
  EXPECT_DOUBLE_EQ(laws.shear_lift->coefficient, 0.15);
  EXPECT_DOUBLE_EQ(laws.shear_lift->radius, radius);
  EXPECT_DOUBLE_EQ(laws.shear_diffusion->coefficient, 0.2);
  EXPECT_DOUBLE_EQ(laws.shear_diffusion->radius, radius);
  EXPECT_EQ(laws.shear_diffusion->seed, 5U);
  EXPECT_THAT(optional_laws(all), testing::SizeIs(3));
}

TEST(EnsembleKinds, spread_over_ranks_as_asked) {
  const micro::RegionOptions plain = region_options(channel(""));
  EXPECT_EQ(plain.motion, micro::regions::CopyMotion::flow);
  EXPECT_EQ(plain.exchange_interval, 0);
  const micro::RegionOptions asked =
      region_options(channel("regions.copies = \"frozen\"\nregions.exchange_interval = 9\n"
                             "regions.copy_growth = 2\n"));
  EXPECT_EQ(asked.motion, micro::regions::CopyMotion::frozen);
  EXPECT_EQ(asked.exchange_interval, 9);
  EXPECT_EQ(asked.copy_growth, 2);
}

}  // namespace
}  // namespace hemoscale::coupling
