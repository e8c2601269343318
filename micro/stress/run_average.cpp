#include "micro/stress/run_average.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "micro/error.hpp"
#include "micro/stress/series_estimate.hpp"

namespace hemoscale::micro {

void require_admissible(const Run& run) {
  if (!(run.warm_up_strain >= 0) || !std::isfinite(run.warm_up_strain)) {
    throw ParameterError(
        fmt::format("warm-up strain {}; it must be finite and not negative; choose 0 "
                    "for none",
                    run.warm_up_strain));
  }
  if (!(run.minimum_strain > 0) || !std::isfinite(run.minimum_strain)) {
    throw ParameterError(
        fmt::format("minimum strain {}; it must be finite and positive; choose "
                    "several correlation strains, such as 20",
                    run.minimum_strain));
  }
  if (!(run.maximum_strain >= run.minimum_strain) || !std::isfinite(run.maximum_strain)) {
    throw ParameterError(
        fmt::format("maximum strain {} with a minimum of {}; it must be finite and at "
                    "least the minimum; raise it",
                    run.maximum_strain, run.minimum_strain));
  }
  if (!(run.relative_standard_error > 0 && run.relative_standard_error < 1)) {
    throw ParameterError(
        fmt::format("relative standard error {}; it must lie between 0 and 1; choose "
                    "such as 0.02",
                    run.relative_standard_error));
  }
}

RunAverage::RunAverage(const Run& run, double shear_rate, double plasma_viscosity, double spacing)
    : run_(run),
      shear_rate_(shear_rate),
      plasma_viscosity_(plasma_viscosity),
      spacing_(spacing),
      next_look_(run.minimum_strain) {
  require_admissible(run);
}

void RunAverage::add(const Tensor<2>& particle_stress) {
  const double symmetric = 0.5 * (particle_stress(0, 1) + particle_stress(1, 0));
  shear_stress_.push_back(plasma_viscosity_ * shear_rate_ + symmetric);
  normal_difference_.push_back(particle_stress(0, 0) - particle_stress(1, 1));
  sum_ += particle_stress;
  // Strains are sums of spacings: the last comparison forgives their round-off.
  const double reached = strain() * (1 + 1e-12);
  if (reached >= next_look_) {
    next_look_ = strain() + std::max(1.0, 0.05 * strain());
    if (is_precise()) {
      finished_ = true;
      termination_ = Termination::precision_reached;
    }
  }
  finished_ = finished_ || reached >= run_.maximum_strain;
}

bool RunAverage::is_precise() const {
  constexpr double fewest_effective_samples = 20;
  const Estimate stress = estimate_mean(shear_stress_, 1);
  return stress.effective_samples >= fewest_effective_samples &&
         stress.standard_error <= run_.relative_standard_error * std::abs(stress.mean);
}

Observation<2> RunAverage::observation() const {
  const double rate = std::abs(shear_rate_);
  Observation<2> result;
  result.shear_rate = rate;
  result.shear_stress = estimate_mean(shear_stress_, spacing_ / rate);
  result.first_normal_difference = estimate_mean(normal_difference_, spacing_ / rate);
  result.particle_stress = sum_ / static_cast<double>(shear_stress_.size());
  result.averaging_time = strain() / rate;
  result.termination = termination_;
  return result;
}

}  // namespace hemoscale::micro
