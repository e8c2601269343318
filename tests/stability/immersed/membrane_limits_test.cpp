#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "micro/error.hpp"
#include "micro/immersed/direct_membranes.hpp"
#include "micro/immersed/immersed_membranes.hpp"
#include "tests/support/immersed/rings.hpp"

namespace hemoscale::micro {
namespace {

using testing::HasSubstr;
using namespace test;

/// Steps until a detector fires: its message, or nothing.
template <typename Model>
std::string end_of(Model& model, double dt, int steps) {
  try {
    for (int n = 0; n < steps; ++n) model.step(dt);
  } catch (const NumericalError& error) {
    return error.what();
  }
  return "";
}

double fastest(const std::vector<Cell>& cells) {
  double speed = 0;
  for (const Vector<2>& u : cells.front().velocities) speed = std::max(speed, u.norm());
  return speed;
}

struct Case {
  std::string name;
  const char* limit;
  double spacing;       // [m]
  double node_spacing;  // [l0]
  double stretch;       // [N/m]
  double bending;       // [J]
  TransferKernel kernel = TransferKernel::four_point;
  PressureCoupling coupling = PressureCoupling::coupled;
  Inertia inertia = Inertia::quasi_steady;
  NodeStepping stepping = NodeStepping::forward_euler;
};

void PrintTo(const Case& each, std::ostream* out) {
  *out << each.name;
}

std::string name_of(const testing::TestParamInfo<Case>& each) {
  return each.param.name;
}

constexpr const char* stretch = "membrane stretch limit";
constexpr const char* bending = "membrane bending limit";

MembraneParameters parameters_of(const Case& each, AreaLaw area_law) {
  MembraneParameters parameters;
  parameters.stretch_modulus = each.stretch;
  parameters.bending_modulus = each.bending;
  parameters.area_law = area_law;
  parameters.area_modulus = 1e3;
  return parameters;
}

class ImmersedLimit : public testing::TestWithParam<Case> {
 protected:
  ImmersedMembranes make(bool force) const {
    const Case& each = GetParam();
    ImmersedOptions options;
    options.kernel = each.kernel;
    options.stepping = each.stepping;
    options.flow.coupling = each.coupling;
    options.flow.inertia = each.inertia;
    options.force = force;
    const double height = box_rows * each.spacing;
    return {channel_nodes(height, height, true, {.spacing = each.spacing}),
            plasma,
            options,
            {noisy_ring(each.spacing, each.node_spacing, parameters_of(each, AreaLaw::exact))}};
  }
  double step_at(double share) const {
    return share * limit_of(make(true).limits(1), GetParam().limit);
  }
};

constexpr double half = 0.5e-6;  // [m]
constexpr double fine = 0.25e-6;
INSTANTIATE_TEST_SUITE_P(
    , ImmersedLimit,
    testing::Values(
        Case{"soft", stretch, half, 0.65, 1e-4, 2e-19},
        Case{"stiff", stretch, half, 0.65, 1e-3, 2e-19},
        Case{"fine", stretch, fine, 0.65, 1e-3, 2e-19},
        Case{"wide", stretch, half, 1.0, 1e-3, 2e-19},
        Case{"unsteady", stretch, half, 0.65, 1e-3, 2e-19, TransferKernel::four_point,
             PressureCoupling::coupled, Inertia::unsteady},
        Case{"incremental", stretch, half, 0.65, 1e-3, 2e-19, TransferKernel::four_point,
             PressureCoupling::incremental, Inertia::unsteady},
        Case{"two_steps", stretch, half, 0.65, 1e-3, 2e-19, TransferKernel::four_point,
             PressureCoupling::coupled, Inertia::quasi_steady, NodeStepping::adams_bashforth},
        Case{"three_point", stretch, half, 0.65, 1e-3, 2e-19, TransferKernel::three_point},
        Case{"three_point_incremental", stretch, half, 0.65, 1e-3, 2e-19,
             TransferKernel::three_point, PressureCoupling::incremental, Inertia::unsteady},
        Case{"bending", bending, half, 0.65, 1e-6, 1e-16},
        Case{"bending_three_point", bending, half, 0.65, 1e-6, 1e-16, TransferKernel::three_point}),
    name_of);

TEST_P(ImmersedLimit, below_it_noise_dies_out) {
  ImmersedMembranes membranes = make(false);
  const double dt = step_at(0.8);
  membranes.step(dt);
  const double before = fastest(membranes.cells());
  EXPECT_EQ(end_of(membranes, dt, 60), "");
  EXPECT_LT(fastest(membranes.cells()), before);
}

TEST_P(ImmersedLimit, beyond_it_the_run_is_refused_or_ends_and_names_it) {
  const double dt = step_at(1.3);
  ImmersedMembranes refused = make(false);
  try {
    refused.step(dt);
    FAIL() << "not refused";
  } catch (const ParameterError& error) {
    EXPECT_THAT(error.what(), testing::AllOf(HasSubstr(GetParam().limit), HasSubstr("implicit")));
  }
  EXPECT_EQ(refused.steps(), 0);
  ImmersedMembranes forced = make(true);
  EXPECT_THAT(end_of(forced, dt, 100),
              testing::AllOf(HasSubstr(GetParam().limit), HasSubstr("cell 0"), HasSubstr("step ")));
}

class DirectLimit : public testing::TestWithParam<std::pair<Case, ViscousStepping>> {
 protected:
  DirectMembranes make(bool force) const {
    const auto& [each, viscosity] = GetParam();
    SemiImplicitOptions options = best_repaired();
    options.viscosity = viscosity;
    options.speed = 0.01;
    options.force = force;
    const double height = box_rows * each.spacing;
    return {lattice_periodic_channel({.spacing = each.spacing}, height, height, 0),
            plasma,
            options,
            {noisy_ring(each.spacing, each.node_spacing, parameters_of(each, AreaLaw::penalty))}};
  }
  double step_at(double share) const {
    return share * limit_of(make(true).limits(1), GetParam().first.limit);
  }
};

constexpr auto implicit = ViscousStepping::implicit_euler;
constexpr auto explicit_viscosity = ViscousStepping::explicit_euler;
INSTANTIATE_TEST_SUITE_P(
    , DirectLimit,
    testing::Values(std::pair{Case{"soft", stretch, half, 0.65, 1e-4, 2e-19}, implicit},
                    std::pair{Case{"stiff", stretch, half, 0.65, 1e-3, 2e-19}, implicit},
                    std::pair{Case{"fine", stretch, fine, 0.65, 1e-4, 2e-19}, implicit},
                    std::pair{Case{"wide", stretch, half, 1.0, 1e-4, 2e-19}, implicit},
                    std::pair{Case{"bending", bending, half, 0.65, 1e-6, 2e-17}, implicit},
                    std::pair{Case{"stiff_explicit", stretch, half, 0.65, 1e-3, 2e-19},
                              explicit_viscosity}),
    [](const auto& each) { return each.param.first.name; });

TEST_P(DirectLimit, below_it_noise_dies_out) {
  DirectMembranes membranes = make(false);
  const double dt = step_at(0.8);
  membranes.step(dt);
  const double before = fastest(membranes.cells());
  EXPECT_EQ(end_of(membranes, dt, 80), "");
  EXPECT_LT(fastest(membranes.cells()), before);
}

TEST_P(DirectLimit, beyond_it_the_run_is_refused_or_ends_and_names_it) {
  const double dt = step_at(1.3);
  DirectMembranes refused = make(false);
  try {
    refused.step(dt);
    FAIL() << "not refused";
  } catch (const ParameterError& error) {
    EXPECT_THAT(error.what(),
                testing::AllOf(HasSubstr(GetParam().first.limit), HasSubstr("implicit")));
  }
  EXPECT_EQ(refused.steps(), 0);
  DirectMembranes forced = make(true);
  EXPECT_THAT(end_of(forced, dt, 150),
              testing::AllOf(HasSubstr("step "), HasSubstr(GetParam().first.limit)));
}

/// A stiff area in a short channel through whose end fluid can leave.
std::string end_with_area_modulus(double spacing, double modulus, double share) {
  SemiImplicitOptions options = best_repaired();
  options.speed = 0.01;
  options.force = true;
  MembraneParameters parameters{.stretch_modulus = 1e-5};
  parameters.area_modulus = modulus;
  const double height = box_rows * spacing;
  Cell cell = noisy_ring(spacing, 0.65, parameters);
  for (Vector<2>& x : cell.positions) x[0] += 2 * spacing;
  DirectMembranes membranes(
      lattice_open_channel({.spacing = spacing}, 24 * spacing, height, uniform_inflow(1e-3)),
      plasma, options, {cell});
  return end_of(membranes, share * limit_of(membranes.limits(1), "membrane area limit"), 60);
}

TEST(DirectAreaLimit, has_two_sides) {
  for (const double spacing : {half, fine}) {
    // The same ratio of the forces of the area and of viscosity.
    const double modulus = 5e4 * half / spacing * half / spacing;
    EXPECT_EQ(end_with_area_modulus(spacing, modulus, 0.8), "");
    EXPECT_THAT(end_with_area_modulus(spacing, modulus, 1.3), HasSubstr("membrane area limit"));
  }
}

}  // namespace
}  // namespace hemoscale::micro
