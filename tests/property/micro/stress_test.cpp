#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "micro/ensemble/ensemble_model.hpp"
#include "tests/support/micro/ensembles.hpp"

namespace hemoscale::micro {
namespace {

using test::shear;

/// Stress at this moment, up to the motion in one step.
Tensor<2> stress_now(EnsembleModel& model, double rate, double hematocrit) {
  return model.advance_by(shear(rate, hematocrit), model.time_step()).particle_stress;
}

double scale_of(const Tensor<2>& stress) {
  return stress.cwiseAbs().maxCoeff();
}

TEST(ParticleStress, of_a_stretched_cell_is_positive_along_the_stretch) {
  EnsembleModel model(test::lonely_cell(), 1);
  test::move_nodes(model, [](std::size_t, double x, double y) { return std::pair(1.1 * x, y); });
  const Tensor<2> stress = stress_now(model, 0, 0.01);
  EXPECT_GT(stress(0, 0), 0);
}

TEST(ParticleStress, of_pushing_neighbours_is_a_pressure) {
  EnsembleParameters p = test::small_ensemble();
  p.hematocrit = 0.55;
  p.contact.attraction = 0;
  EnsembleModel model(p, 1);
  const Tensor<2> stress = stress_now(model, 0, 0.55);
  EXPECT_LT(stress(0, 0) + stress(1, 1), 0);
}

TEST(ParticleStress, is_symmetric) {
  EnsembleModel model(test::small_ensemble(), 1);
  for (int i = 0; i < 20; ++i) {
    model.advance_by(shear(100, 0.3), 0.002);
    const Tensor<2> stress = stress_now(model, 100, 0.3);
    EXPECT_LE(std::abs(stress(0, 1) - stress(1, 0)), 1e-11 * scale_of(stress));
  }
}

TEST(ParticleStress, of_cells_that_do_not_meet_is_the_sum_over_the_cells) {
  EnsembleParameters p = test::small_ensemble();
  p.contact.stiffness = 0;
  EnsembleModel both(p, 1);
  both.advance_by(shear(100, 0.3), 0.01);
  const Snapshot state = both.snapshot();
  // The same box with one cell at a time: one sixth of the cells at one sixth of the hematocrit.
  p.cells = 1;
  p.hematocrit = 0.05;
  Tensor<2> sum = Tensor<2>::Zero();
  for (std::size_t cell = 0; cell < 6; ++cell) {
    EnsembleModel single(p, 1);
    Snapshot part = single.snapshot();
    const auto first = static_cast<std::ptrdiff_t>(cell * 24);
    for (const char* name : {"ensemble.x", "ensemble.y"}) {
      const auto& all = state.reals.at(name);
      part.reals.at(name).assign(all.begin() + first, all.begin() + first + 24);
    }
    part.reals.at("ensemble.image_offset") = state.reals.at("ensemble.image_offset");
    single.restore(part);
    sum += stress_now(single, 100, 0.05);
  }
  const Tensor<2> stress = stress_now(both, 100, 0.3);
  EXPECT_LE((stress - sum).cwiseAbs().maxCoeff(), 1e-12 * scale_of(stress));
}

TEST(ParticleStress, does_not_depend_on_the_origin) {
  EnsembleModel model(test::small_ensemble(), 1);
  model.advance_by(shear(100, 0.3), 0.02);
  const Snapshot start = model.snapshot();
  const Tensor<2> expected = model.advance_by(shear(100, 0.3), 0.002).particle_stress;
  for (const auto& shift : {Vector<2>(3e-6, 0), Vector<2>(-5e-6, 4.4e-6), Vector<2>(1e-6, -9e-6)}) {
    model.restore(start);
    test::move_nodes(model, [&](std::size_t, double x, double y) {
      return std::pair(x + shift.x(), y + shift.y());
    });
    const Tensor<2> stress = model.advance_by(shear(100, 0.3), 0.002).particle_stress;
    EXPECT_LE((stress - expected).cwiseAbs().maxCoeff(), 1e-8 * scale_of(expected));
  }
}

TEST(ParticleStress, does_not_notice_that_a_cell_is_replaced_by_its_image) {
  EnsembleModel model(test::small_ensemble(), 1);
  model.advance_by(shear(100, 0.3), 0.02);
  const Snapshot start = model.snapshot();
  const EnsembleFrame frame = model.frame();
  const Tensor<2> expected = model.advance_by(shear(100, 0.3), 0.002).particle_stress;
  for (const auto& [columns, rows] : {std::pair{1, 0}, {0, 1}, {-1, -1}}) {
    model.restore(start);
    test::move_nodes(model, [&, c = columns, r = rows](std::size_t i, double x, double y) {
      return i / 24 == 2
                 ? std::pair(x + c * frame.length + r * frame.image_offset, y + r * frame.height)
                 : std::pair(x, y);
    });
    const Tensor<2> stress = model.advance_by(shear(100, 0.3), 0.002).particle_stress;
    EXPECT_LE((stress - expected).cwiseAbs().maxCoeff(), 1e-8 * scale_of(expected));
  }
}

TEST(ParticleStress, in_a_reversed_and_reflected_flow_is_reflected) {
  EnsembleModel model(test::small_ensemble(), 1);
  model.advance_by(shear(100, 0.3), 0.02);
  const Snapshot start = model.snapshot();
  const double length = model.frame().length;
  const Tensor<2> expected = model.advance_by(shear(100, 0.3), 0.002).particle_stress;
  // Mirror x; the order of the nodes is turned round to stay counter-clockwise.
  Snapshot mirrored = start;
  for (const char* name : {"ensemble.x", "ensemble.y"}) {
    auto& values = mirrored.reals.at(name);
    for (std::ptrdiff_t cell = 0; cell < 6; ++cell) {
      // Node 0 keeps its place: the outline is symmetric about it, so are the rest lengths.
      std::reverse(values.begin() + cell * 24 + 1, values.begin() + cell * 24 + 24);
    }
  }
  for (double& x : mirrored.reals.at("ensemble.x")) {
    x = length - x;
  }
  double& offset = mirrored.reals.at("ensemble.image_offset").front();
  offset = offset == 0 ? 0 : length - offset;
  model.restore(mirrored);
  const Tensor<2> stress = model.advance_by(shear(-100, 0.3), 0.002).particle_stress;
  EXPECT_NEAR(stress(0, 1), -expected(0, 1), 1e-8 * scale_of(expected));
  EXPECT_NEAR(stress(0, 0), expected(0, 0), 1e-8 * scale_of(expected));
  EXPECT_NEAR(stress(1, 1), expected(1, 1), 1e-8 * scale_of(expected));
}

}  // namespace
}  // namespace hemoscale::micro
