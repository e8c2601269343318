#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "micro/ensemble/contact_law.hpp"
#include "micro/ensemble/observables/node_forces.hpp"
#include "tests/support/micro/contact_laws.hpp"

namespace hemoscale::micro {
namespace {

using testing::HasSubstr;

class ContactLaws : public testing::TestWithParam<test::NamedLaw> {
 protected:
  ContactLaw law = GetParam().law;
  double cutoff = cutoff_of(law);
  double force(double r) const { return force_over_distance(law, r * r) * r; }
  double energy(double r) const { return pair_energy(law, r * r); }
  // Of the largest force in the range where cells meet.
  double scale = std::abs(force(0.5 * cutoff)) + std::abs(force(0.25 * cutoff));

  /// Distances between nodes, but for those within h of a kink.
  std::vector<double> distances() const {
    std::vector<double> result;
    for (int k = 1; k < 400; ++k) {
      const double r = cutoff * (k + 0.37) / 400;
      if (std::abs(r - rest_distance_of(law)) > 1e-4 * cutoff) result.push_back(r);
    }
    return result;
  }
};

TEST_P(ContactLaws, force_is_minus_gradient_of_energy) {
  const double h = 1e-5 * cutoff;
  for (const double r : distances()) {
    const double slope =
        (8 * (energy(r + h) - energy(r - h)) - (energy(r + 2 * h) - energy(r - 2 * h))) / (12 * h);
    EXPECT_NEAR(force(r), -slope, 1e-6 * (scale + std::abs(force(r)))) << r;
  }
}

TEST_P(ContactLaws, curvature_is_minus_slope_of_force) {
  const double h = 1e-5 * cutoff;
  for (const double r : distances()) {
    const double slope =
        (8 * (force(r + h) - force(r - h)) - (force(r + 2 * h) - force(r - 2 * h))) / (12 * h);
    EXPECT_NEAR(pair_curvature(law, r * r), -slope,
                2e-5 * (scale / cutoff + std::abs(pair_curvature(law, r * r))))
        << r;
  }
}

TEST_P(ContactLaws, vanishes_continuously_at_the_cutoff_and_is_zero_beyond) {
  EXPECT_LT(std::abs(force(cutoff * (1 - 1e-9))), 1e-6 * scale);
  EXPECT_LT(std::abs(energy(cutoff * (1 - 1e-9))), 1e-9 * scale * cutoff);
  for (const double r : {cutoff, 1.001 * cutoff, 10 * cutoff, 1e6 * cutoff}) {
    EXPECT_EQ(force(r), 0);
    EXPECT_EQ(energy(r), 0);
    EXPECT_EQ(pair_curvature(law, r * r), 0);
  }
}

TEST_P(ContactLaws, repels_below_the_rest_distance_and_attracts_above) {
  const double rest = rest_distance_of(law);
  ASSERT_LT(rest, cutoff);
  EXPECT_GT(force(rest * 0.999), 0);
  EXPECT_LT(force(rest * 1.001), 0);
  EXPECT_LT(energy(rest), 0);
  EXPECT_NEAR(stiffness_at_rest(law), (force(rest * (1 - 1e-6)) - force(rest)) / (1e-6 * rest),
              1e-4 * stiffness_at_rest(law));
}

TEST_P(ContactLaws, nodes_that_coincide_have_a_finite_stiffness_and_no_force) {
  EXPECT_EQ(force_over_distance(law, 0) * 0, 0);
  EXPECT_TRUE(std::isfinite(pair_curvature(law, 0)));
  EXPECT_TRUE(std::isfinite(energy(0)));
}

TEST_P(ContactLaws, are_what_observers_are_given) {
  const PairLaw given = make_pair_law(law);
  EXPECT_EQ(given.cutoff, cutoff);
  EXPECT_EQ(given.rest_distance, rest_distance_of(law));
  EXPECT_EQ(given.force_over_distance(0.04e-12), force_over_distance(law, 0.04e-12));
}

TEST_P(ContactLaws, of_the_tests_are_sound) {
  EXPECT_EQ(contact_law_faults(law), "");
}

INSTANTIATE_TEST_SUITE_P(Laws, ContactLaws, testing::ValuesIn(test::contact_laws()),
                         [](const auto& each) { return std::string(each.param.name); });

TEST(LennardJonesPotential, is_linear_within_its_core) {
  const auto law = std::get<LennardJonesPotential>(test::lennard_jones_contact());
  const double at_core = law.curvature(law.core * law.core);
  const auto force = [&](double r) { return law.force_over_distance(r * r) * r; };
  EXPECT_GT(at_core, 0);
  EXPECT_EQ(law.curvature(0.25 * law.core * law.core), at_core);
  EXPECT_NEAR(force(0.3 * law.core), force(law.core) + 0.7 * law.core * at_core,
              1e-12 * force(0.3 * law.core));
}

TEST(MorsePotential, has_the_depth_and_the_place_of_the_law_that_is_cut_far_away) {
  const MorsePotential law{
      .energy_scale = 2e-13, .steepness = 8e6, .rest_distance = 0.4e-6, .cutoff = 2.4e-6};
  EXPECT_NEAR(law.energy(0.16e-12), -2e-13, 1e-5 * 2e-13);
  EXPECT_NEAR(law.zero_of_force(), 0.4e-6, 1e-7 * 0.4e-6);
  EXPECT_NEAR(law.curvature(0.16e-12), 2 * 2e-13 * 64e12, 1e-9);
}

struct Refused {
  ContactLaw law;
  const char* why;
};

TEST(ContactLawFaults, name_value_range_and_remedy) {
  const Refused refused[] = {
      {PairPotential{.scale = -1, .rest_squared = 0.09e-12, .cutoff_squared = 0.25e-12},
       "must not be negative"},
      {PairPotential{.scale = 1, .rest_squared = 0.25e-12, .cutoff_squared = 0.25e-12},
       "cutoff the larger"},
      {MorsePotential{.energy_scale = 1e-13, .steepness = 0, .rest_distance = 1, .cutoff = 2},
       "steepness is 0 1/m"},
      {MorsePotential{
           .energy_scale = 1e-13, .steepness = 8e6, .rest_distance = 0.3e-6, .cutoff = 0.35e-6},
       "strongest attraction"},
      {MorsePotential{
           .energy_scale = 1e-13, .steepness = 1e8, .rest_distance = 0.3e-6, .cutoff = 0.5e-6},
       "at most 20"},
      {LennardJonesPotential{
           .energy_scale = 1e-13, .rest_distance = 0.3e-6, .core = 0.3e-6, .cutoff = 0.5e-6},
       "core"},
      {LennardJonesPotential{
           .energy_scale = 1e-13, .rest_distance = 0.3e-6, .core = 0.2e-6, .cutoff = 0.32e-6},
       "strongest attraction"},
      {LennardJonesPotential{
           .energy_scale = 1e-13, .rest_distance = 0.3e-6, .core = 0.01e-6, .cutoff = 0.5e-6},
       "enlarge it"}};
  for (const Refused& each : refused) {
    EXPECT_THAT(contact_law_faults(each.law), HasSubstr(each.why));
  }
}

}  // namespace
}  // namespace hemoscale::micro
