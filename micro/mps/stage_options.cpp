#include "micro/mps/stage_options.hpp"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "micro/error.hpp"

namespace hemoscale::micro {

void check(const StageOptions& options) {
  std::vector<std::string> faults;
  const auto require = [&](bool holds, const std::string& fault) {
    if (!holds) faults.push_back(fault);
  };
  const bool is_quasi_steady = options.inertia == Inertia::quasi_steady;
  require(
      !is_quasi_steady || options.coupling == PressureCoupling::coupled,
      "quasi-steady flow needs the coupled solver: a projection needs the inertia that it leaves "
      "out");
  require(!is_quasi_steady || options.viscosity == ViscosityTreatment::implicit,
          "quasi-steady flow needs implicit viscosity");
  const bool is_explicit = options.viscosity == ViscosityTreatment::explicit_euler;
  require(!is_explicit || options.coupling != PressureCoupling::coupled,
          "the coupled solver is implicit in the viscosity; use a projection (chorin, incremental) "
          "for explicit viscosity");
  require(!is_explicit || options.time_scheme == TimeScheme::euler,
          "explicit viscosity is stepped by Euler; use implicit viscosity with sdirk2");
  require(options.shifting == Shifting::none || options.motion != NodeMotion::eulerian,
          "resting nodes need no shifting; use it with moving nodes (lagrangian, ale)");
  require(options.kernel_ratio > 1.5 && options.kernel_ratio <= 6,
          fmt::format("the kernel ratio is {:g}; least squares of degree two need more than 1.5 "
                      "spacings, and beyond 6 cost more than finer nodes",
                      options.kernel_ratio));
  require(
      options.stabilisation > 0,
      fmt::format("the stabilisation is {:g}; it must be positive, or pressures of neighbouring "
                  "nodes come apart",
                  options.stabilisation));
  require(options.shifting_strength > 0 && options.shifting_strength <= 0.5,
          fmt::format("the shifting strength is {:g} spacings per step; it must be above 0 and at "
                      "most 0.5",
                      options.shifting_strength));
  if (faults.empty()) return;
  std::string text;
  for (const std::string& fault : faults) text += (text.empty() ? "" : "\n") + fault;
  throw ParameterError(text);
}

}  // namespace hemoscale::micro
