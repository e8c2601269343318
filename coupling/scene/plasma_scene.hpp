#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "coupling/config/settings.hpp"
#include "macro/flow_field.hpp"
#include "micro/mps/limits.hpp"
#include "micro/mps/plasma_model.hpp"

namespace hemoscale::coupling {

/// Everything a lone plasma run is made of.
template <int dim>
struct PlasmaScene {
  micro::FlowDomain<dim> domain;
  micro::Fluid fluid;
  micro::PlasmaMethod method;
  double time_step = 0;   // [s]
  double speed = 0;       // [m/s] largest to be expected
  double mean_speed = 0;  // [m/s] that the flow is named by: of the Reynolds number
  double size = 0;        // [m] likewise: height, edge
  std::optional<micro::ChannelSections> sections;

  /// The exact flow where it is known, and the abscissae between which it holds.
  std::shared_ptr<const macro::FlowField<dim>> exact;
  double exact_from = 0;          // [m]
  double exact_to = 0;            // [m]
  bool compares_pressure = true;  // not where a body force stands for the pressure gradient
};

/// 2 or 3.
int plasma_dimension(const Settings& settings);

/// @param force  run beyond the limits of the method
/// @throws CaseError with all keys that the flow or the method lacks or cannot take,
///         micro::ParameterError for what they cannot be together
template <int dim>
PlasmaScene<dim> build_plasma_scene(const Settings& settings, bool force);

/// The limits of the method that depend on the step.
template <int dim>
std::vector<micro::Limit> plasma_limits(const PlasmaScene<dim>& scene);

/// The longest step that the limits admit [s]; those that do not grow with the step do not count.
/// Infinite if none does.
double longest_step(const std::vector<micro::Limit>& limits, double time_step);

/// What the case is, in lines for `hemoscale check`.
std::string describe_plasma(const Settings& settings);

}  // namespace hemoscale::coupling
