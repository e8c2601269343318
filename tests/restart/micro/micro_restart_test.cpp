#include <gtest/gtest.h>

#include <limits>

#include "micro/ensemble/ensemble_model.hpp"
#include "micro/error.hpp"
#include "micro/synthetic/synthetic_model.hpp"
#include "tests/support/micro/ensembles.hpp"

namespace hemoscale::micro {
namespace {

using test::shear;

void expect_same_bits(const Snapshot& a, const Snapshot& b) {
  EXPECT_EQ(a.reals, b.reals);
  EXPECT_EQ(a.integers, b.integers);
}

// Saves at odd moments, between rebuilds of the neighbour list and between homecomings of cells.
TEST(EnsembleRestart, continues_with_the_same_bits) {
  const EnsembleParameters p = test::small_ensemble();
  EnsembleModel whole(p, 1);
  const double dt = whole.time_step();
  for (const int steps : {1, 7, 100, 333, 1000, 5, 554}) {
    whole.advance_by(shear(200, 0.3), steps * dt);
  }
  EnsembleModel first(p, 1);
  Snapshot saved = first.snapshot();
  for (const int steps : {1, 7, 100, 333, 1000, 5, 554}) {
    EnsembleModel next(p, 99);  // another packing, which the snapshot replaces
    next.restore(saved);
    next.advance_by(shear(200, 0.3), steps * dt);
    saved = next.snapshot();
  }
  EXPECT_EQ(saved.integers.at("ensemble.step").front(), 2000);
  expect_same_bits(saved, whole.snapshot());
}

// A model that is restored after every step builds its list anew each time; one that runs on keeps
// it for hundreds of steps. A pair missed by the older list would show.
TEST(EnsembleRestart, the_age_of_the_neighbour_list_does_not_change_a_bit) {
  EnsembleParameters p = test::small_ensemble();
  p.hematocrit = 0.45;
  EnsembleModel old_list(p, 1);
  EnsembleModel new_list(p, 1);
  for (int i = 0; i < 3000; ++i) {
    new_list.restore(new_list.snapshot());
    new_list.advance_by(shear(50, 0.45), new_list.time_step());
  }
  old_list.advance_by(shear(50, 0.45), 3000 * old_list.time_step());
  expect_same_bits(old_list.snapshot(), new_list.snapshot());
}

TEST(EnsembleRestart, channel_continues_with_the_same_bits) {
  EnsembleParameters p = test::small_ensemble();
  p.domain = PlaneChannel{.height = 15e-6};
  const Forcing<2> forcing = test::poiseuille(15e-6, 4e-3, 0.3);
  EnsembleModel whole(p, 1);
  const double dt = whole.time_step();
  whole.advance_by(forcing, 1000 * dt);
  whole.advance_by(forcing, 1000 * dt);
  EnsembleModel first(p, 1);
  first.advance_by(forcing, 1000 * dt);
  EnsembleModel second(p, 5);
  second.restore(first.snapshot());
  second.advance_by(forcing, 1000 * dt);
  expect_same_bits(second.snapshot(), whole.snapshot());
}

TEST(EnsembleRestart, observations_of_later_runs_are_the_same) {
  const micro::Run run{.warm_up_strain = 0.2,
                       .minimum_strain = 0.5,
                       .maximum_strain = 1,
                       .relative_standard_error = 0.02};
  EnsembleModel a(test::small_ensemble(), 1);
  a.advance(shear(200, 0.3), run);
  EnsembleModel b(test::small_ensemble(), 2);
  b.restore(a.snapshot());
  const Observation<2> oa = a.advance(shear(-100, 0.3), run);
  const Observation<2> ob = b.advance(shear(-100, 0.3), run);
  EXPECT_EQ(oa.shear_stress.mean, ob.shear_stress.mean);
  EXPECT_EQ(oa.shear_stress.standard_error, ob.shear_stress.standard_error);
  expect_same_bits(a.snapshot(), b.snapshot());
}

TEST(EnsembleRestart, the_number_of_threads_does_not_change_a_bit) {
  EnsembleParameters p = test::small_ensemble();
  EnsembleModel one(p, 1);
  p.threads = 2;
  EnsembleModel two(p, 1);
  const SceneObservation a = one.advance_by(shear(200, 0.3), 500 * one.time_step());
  const SceneObservation b = two.advance_by(shear(200, 0.3), 500 * one.time_step());
  EXPECT_EQ(a.particle_stress, b.particle_stress);
  expect_same_bits(one.snapshot(), two.snapshot());
}

TEST(EnsembleRestart, refuses_snapshots_of_others) {
  EnsembleParameters p = test::small_ensemble();
  EnsembleModel model(p, 1);
  EXPECT_THROW(model.restore({}), ParameterError);
  p.nodes = 22;
  EXPECT_THROW(model.restore(EnsembleModel(p, 1).snapshot()), ParameterError);
  Snapshot broken = model.snapshot();
  broken.reals.at("ensemble.x")[3] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(model.restore(broken), ParameterError);
  broken = model.snapshot();
  broken.reals.at("ensemble.y").pop_back();
  EXPECT_THROW(model.restore(broken), ParameterError);
  broken = model.snapshot();
  broken.integers.erase("ensemble.step");
  EXPECT_THROW(model.restore(broken), ParameterError);
  broken = model.snapshot();
  broken.reals.at("ensemble.image_offset").front() = 1;
  EXPECT_THROW(model.restore(broken), ParameterError);
}

TEST(SyntheticRestart, continues_with_the_same_bits) {
  const SyntheticParameters parameters{.law = [](double, double) { return 3e-3; }, .noise = 0.2};
  const micro::Run run{.warm_up_strain = 3,
                       .minimum_strain = 20,
                       .maximum_strain = 40,
                       .relative_standard_error = 0.001};
  SyntheticModel whole(parameters, 4, 2);
  whole.advance(shear(10, 0.3), run);
  SyntheticModel other(parameters, 0, 0);
  other.restore(whole.snapshot());
  const Observation<2> a = whole.advance(shear(30, 0.3), run);
  const Observation<2> b = other.advance(shear(30, 0.3), run);
  EXPECT_EQ(a.shear_stress.mean, b.shear_stress.mean);
  EXPECT_EQ(a.shear_stress.standard_error, b.shear_stress.standard_error);
  expect_same_bits(whole.snapshot(), other.snapshot());
}

}  // namespace
}  // namespace hemoscale::micro
