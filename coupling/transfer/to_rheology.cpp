#include "coupling/transfer/to_rheology.hpp"

#include <fmt/format.h>

#include <cmath>

#include "coupling/error.hpp"

namespace hemoscale::coupling {

namespace {

void require(bool holds, double shear_rate, const char* what, double value, const char* allowed) {
  if (holds) return;
  throw NumericalError(
      fmt::format("micro run at shear rate {} 1/s: {} is {}; it must be {}. Lengthen the run "
                  "(micro.run.*) or reduce its time step (micro.time_step)",
                  shear_rate, what, value, allowed));
}

}  // namespace

template <int dim>
RheologySample to_rheology(const micro::Observation<dim>& observation, double hematocrit) {
  const double rate = observation.shear_rate;
  const micro::Estimate& stress = observation.shear_stress;
  const micro::Estimate& normal = observation.first_normal_difference;
  require(std::isfinite(rate) && rate > 0, rate, "shear rate [1/s]", rate, "positive");
  require(std::isfinite(stress.mean) && stress.mean > 0, rate, "mean shear stress [Pa]",
          stress.mean, "positive, as viscosity is");
  require(std::isfinite(stress.standard_error) && stress.standard_error >= 0, rate,
          "standard error of the shear stress [Pa]", stress.standard_error, "finite, not negative");
  require(std::isfinite(normal.mean), rate, "first normal stress difference [Pa]", normal.mean,
          "finite");

  RheologySample sample;
  sample.shear_rate = rate;
  sample.hematocrit = hematocrit;
  sample.shear_stress = stress.mean;
  sample.viscosity = stress.mean / rate;
  sample.viscosity_error = stress.standard_error / rate;
  sample.first_normal_difference = normal.mean;
  sample.first_normal_error = normal.standard_error;
  sample.effective_samples = stress.effective_samples;
  sample.averaging_time = observation.averaging_time;
  sample.precision_reached = observation.termination == micro::Termination::precision_reached;
  sample.dimension = dim;
  return sample;
}

template RheologySample to_rheology<2>(const micro::Observation<2>&, double);
template RheologySample to_rheology<3>(const micro::Observation<3>&, double);

}  // namespace hemoscale::coupling
