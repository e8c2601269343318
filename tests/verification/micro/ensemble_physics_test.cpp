#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "micro/ensemble/ensemble_model.hpp"
#include "tests/support/micro/ensembles.hpp"

namespace hemoscale::micro {
namespace {

using test::shear;

double mean_y(const EnsembleModel& model) {
  const EnsembleFrame f = model.frame();
  double sum = 0;
  for (std::size_t i = 1; i < f.positions.size(); i += 2) {
    sum += f.positions[i];
  }
  return sum / (0.5 * static_cast<double>(f.positions.size()));
}

// With isotropic drag the forces of a ring sum to zero: no shape can make it migrate.
TEST(EnsemblePhysics, an_isolated_cell_does_not_drift_in_a_shear_box) {
  EnsembleModel model(test::lonely_cell(), 3);
  const double before = mean_y(model);
  model.advance_by(shear(100, 0.01), 0.1);
  EXPECT_NEAR(mean_y(model), before, 1e-12 * 10 * 3e-6);
}

TEST(EnsemblePhysics, an_isolated_cell_does_not_drift_in_a_channel) {
  EnsembleParameters p = test::lonely_cell();
  p.domain = PlaneChannel{.height = 40e-6};
  EnsembleModel model(p, 3);
  // Off the axis, clear of the walls.
  const double start = mean_y(model);
  test::move_nodes(
      model, [&](std::size_t, double x, double y) { return std::pair(x, y - start + 12e-6); });
  const Forcing<2> forcing = test::poiseuille(40e-6, 2e-3, 0.01);
  const double before = mean_y(model);
  model.advance_by(forcing, 0.05);
  EXPECT_NEAR(mean_y(model), before, 1e-12 * 10 * 3e-6);
}

// A stiff circle of radius a turns with half the shear rate and resists the strain. Its nodes, each
// with the drag zeta, exert the stress  (n zeta_cell a^2 / 2) E:  [eta] = c / (4 pi).
TEST(EnsemblePhysics, a_stiff_circle_has_the_exact_intrinsic_viscosity) {
  EnsembleParameters p = test::lonely_cell();
  p.nodes = 16;
  p.outline = {.outline = Outline::ellipse, .length = 4e-6, .aspect = 1};
  p.membrane.stretch_modulus = 1e-3;
  p.membrane.bending_modulus = 1e-16;
  p.membrane.area_modulus = 100;
  EnsembleModel model(p, 1);
  const double rate = 50;
  model.advance_by(shear(rate, 0.01), 0.002);
  const SceneObservation o = model.advance_by(shear(rate, 0.01), 0.002);
  // Nodes on a regular polygon have the second moment a^2/2 exactly; the hematocrit counts the
  // polygon.
  const double polygon = 0.5 * 16 * std::sin(2 * std::numbers::pi / 16) / std::numbers::pi;
  const double expected = 12 / (4 * std::numbers::pi * polygon) * p.plasma_viscosity * rate * 0.01;
  EXPECT_NEAR(o.particle_stress(0, 1), expected, 5e-3 * expected);
  EXPECT_NEAR(o.shear_stress.mean, expected + p.plasma_viscosity * rate,
              1e-4 * p.plasma_viscosity * rate);
}

TEST(EnsemblePhysics, drag_conventions_agree_when_their_drags_do) {
  EnsembleParameters p = test::small_ensemble();
  EnsembleModel cell(p, 1);
  p.drag = {.convention = DragConvention::node, .coefficient = 0.5};  // 12 / 24
  EnsembleModel node(p, 1);
  EXPECT_EQ(cell.time_step(), node.time_step());
  EXPECT_EQ(cell.advance_by(shear(100, 0.3), 0.005).particle_stress,
            node.advance_by(shear(100, 0.3), 0.005).particle_stress);
}

// V Sigma:L = dE/dt + sum F.F/zeta holds exactly for the equations, up to O(dt) for Euler's scheme.
TEST(EnsemblePhysics, power_balance_closes_with_first_order) {
  double imbalance[2];
  int k = 0;
  for (const double share : {0.4, 0.1}) {
    EnsembleParameters p = test::small_ensemble();
    p.sampling_strain = 0.01;
    p.time_step = share * step_limit(p).time_step;
    EnsembleModel model(p, 1);
    model.advance_by(shear(100, 0.3), 0.02);
    const SceneObservation o = model.advance_by(shear(100, 0.3), 0.02);
    imbalance[k++] = test::deviation(o.ledger, "power balance");
  }
  EXPECT_LT(imbalance[0], 1e-3);
  EXPECT_NEAR(std::log(imbalance[0] / imbalance[1]) / std::log(4.0), 1, 0.15);
}

// With isotropic drag, d/dt sum (y - H/2)^2 = (2/zeta) sum (y - H/2) F_y: the lateral spread of the
// cells changes by their normal stress alone, if the walls do not push.
TEST(EnsemblePhysics, cells_spread_as_their_normal_stress_says) {
  EnsembleParameters p = test::small_ensemble();
  const double height = 20e-6;
  p.domain = PlaneChannel{.height = height};
  p.wall.stiffness = 0;
  EnsembleModel model(p, 2);
  const Forcing<2> forcing = test::poiseuille(height, 2e-3, 0.3);
  model.advance_by(forcing, 0.01);
  const auto sum_of_squares = [&] {
    const EnsembleFrame f = model.frame();
    double sum = 0;
    for (std::size_t i = 1; i < f.positions.size(); i += 2) {
      sum += std::pow(f.positions[i] - 0.5 * height, 2);
    }
    return sum;
  };
  const double volume = model.frame().length * height;
  const double before = sum_of_squares();
  double predicted = 0;
  for (int i = 0; i < 400; ++i) {
    const SceneObservation o = model.advance_by(forcing, model.time_step());
    predicted -= 2 / model.step_limit().drag * volume * o.particle_stress(1, 1) * o.duration;
  }
  EXPECT_NE(predicted, 0);
  EXPECT_NEAR(sum_of_squares() - before, predicted, 0.01 * std::abs(predicted));
}

}  // namespace
}  // namespace hemoscale::micro
