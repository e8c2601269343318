#include "micro/mps/semi_implicit_options.hpp"

#include <fmt/format.h>

#include <string>

#include "micro/error.hpp"

namespace hemoscale::micro {

namespace {

void require(bool admissible, const std::string& message, std::string& faults) {
  if (!admissible) faults += (faults.empty() ? "" : "\n") + message;
}

void check_operators(const SemiImplicitOptions& o, std::string& faults) {
  require(
      o.operators != OperatorKind::lsmps2,
      "operators are lsmps2; the semi-implicit stepper has mps, cmps and gc; choose one of them "
      "or the least-squares stepper",
      faults);
  require(o.operators != OperatorKind::cmps || o.gradient_form == GradientForm::antisymmetric,
          "operators are cmps, whose pressure gradient is antisymmetric by definition; choose that "
          "form, or operators mps",
          faults);
  require(o.gradient_ratio > 1 && o.gradient_ratio <= 6,
          fmt::format("the gradient radius is {:g} spacings; it must lie in (1, 6]; 2.1 is usual",
                      o.gradient_ratio),
          faults);
  require(o.laplacian_ratio > 1 && o.laplacian_ratio <= 6,
          fmt::format("the Laplacian radius is {:g} spacings; it must lie in (1, 6]; 3.1 is usual",
                      o.laplacian_ratio),
          faults);
  require(o.condition_bound > 1,
          fmt::format("the bound on the condition number is {:g}; it must exceed 1; 100 is usual",
                      o.condition_bound),
          faults);
}

void check_scheme(const SemiImplicitOptions& o, std::string& faults) {
  require(o.relaxation > 0 && o.relaxation <= 1,
          fmt::format("the relaxation of the number density is {:g}; it must lie in (0, 1]",
                      o.relaxation),
          faults);
  require(
      o.shift_coefficient > 0 && o.shift_coefficient <= 1,
      fmt::format("the shift coefficient is {:g}; it must lie in (0, 1]; above, shifting itself "
                  "is unstable",
                  o.shift_coefficient),
      faults);
  require(!o.free_surface_ratio || (*o.free_surface_ratio > 0 && *o.free_surface_ratio <= 1),
          fmt::format("the free-surface ratio is {:g}; it must lie in (0, 1]; 0.97 is usual; leave "
                      "it out where there is no free surface",
                      o.free_surface_ratio.value_or(0)),
          faults);
  require(o.speed > 0,
          fmt::format("the characteristic speed is {:g} m/s; it must be positive: limits and "
                      "detectors are measured by it",
                      o.speed),
          faults);
  require(o.gap >= 0,
          fmt::format("the gap is {:g} m; it must not be negative; 0 for no channel", o.gap),
          faults);
}

}  // namespace

SemiImplicitOptions paper_literal() {
  return {};
}

SemiImplicitOptions best_repaired() {
  SemiImplicitOptions options;
  options.operators = OperatorKind::gc;
  options.gradient_ratio = 3.1;
  options.source = IncompressibilitySource::divergence;
  options.viscosity = ViscousStepping::implicit_euler;
  options.wall_velocity = WallVelocity::antisymmetric;
  options.shift = ShiftKind::ops;
  options.shift_coefficient = 0.2;
  return options;
}

void require_admissible(const SemiImplicitOptions& options) {
  std::string faults;
  check_operators(options, faults);
  check_scheme(options, faults);
  if (!faults.empty()) throw ParameterError(faults);
}

}  // namespace hemoscale::micro
