#include "micro/synthetic/synthetic_model.hpp"

#include <fmt/core.h>

#include <cmath>
#include <utility>

#include "micro/error.hpp"
#include "micro/random/philox.hpp"
#include "micro/stress/run_average.hpp"

namespace hemoscale::micro {
namespace {

void require_positive(double value, const char* name, const char* remedy) {
  if (!(value > 0) || !std::isfinite(value)) {
    throw ParameterError(fmt::format(
        "synthetic model: {} is {}; it must be finite and positive; {}", name, value, remedy));
  }
}

}  // namespace

SyntheticModel::SyntheticModel(SyntheticParameters parameters, std::uint64_t seed,
                               std::uint64_t stream)
    : parameters_(std::move(parameters)), seed_(seed), stream_(stream) {
  if (!parameters_.law) {
    throw ParameterError(
        "synthetic model: there is no law; a function of shear rate and hematocrit is "
        "needed; give one");
  }
  require_positive(parameters_.plasma_viscosity, "plasma viscosity", "give it in Pa s");
  require_positive(parameters_.correlation_strain, "correlation strain", "choose such as 1");
  require_positive(parameters_.sampling_strain, "sampling strain", "choose such as 0.05");
  if (!(parameters_.noise >= 0) || !std::isfinite(parameters_.noise)) {
    throw ParameterError(
        fmt::format("synthetic model: noise is {}; it must be finite and not "
                    "negative; choose 0 for none",
                    parameters_.noise));
  }
  noise_ = normal({seed_, stream_, counter_++});
}

double SyntheticModel::next_noise() {
  // First-order autoregression of unit variance.
  const double memory = std::exp(-parameters_.sampling_strain / parameters_.correlation_strain);
  noise_ = memory * noise_ + std::sqrt(1 - memory * memory) * normal({seed_, stream_, counter_++});
  return noise_;
}

Observation<2> SyntheticModel::advance(const Forcing<2>& forcing, const Run& run) {
  require_admissible(run);
  const Tensor<2> rate = 0.5 * (forcing.velocity_gradient + forcing.velocity_gradient.transpose());
  const double shear_rate = std::sqrt(2.0) * rate.norm();
  if (!(shear_rate > 0) || !std::isfinite(shear_rate)) {
    throw ParameterError(
        fmt::format("synthetic model: shear rate {} 1/s; it must be finite and "
                    "positive; leave such points out of the sampling",
                    shear_rate));
  }
  const double viscosity = parameters_.law(shear_rate, forcing.hematocrit);
  if (!(viscosity > 0) || !std::isfinite(viscosity)) {
    throw ParameterError(
        fmt::format("synthetic model: the law gives {} Pa s at {} 1/s and hematocrit "
                    "{}; it must be finite and positive; correct the law",
                    viscosity, shear_rate, forcing.hematocrit));
  }
  const double direction = forcing.velocity_gradient(0, 1) < 0 ? -1 : 1;
  const double spacing = parameters_.sampling_strain;
  const auto warm_up = static_cast<std::int64_t>(std::ceil(run.warm_up_strain / spacing));
  for (std::int64_t i = 0; i < warm_up; ++i) {
    next_noise();
  }
  RunAverage average(run, direction * shear_rate, parameters_.plasma_viscosity, spacing);
  std::int64_t samples = 0;
  while (!average.finished()) {
    const double total = viscosity * shear_rate * (1 + parameters_.noise * next_noise());
    Tensor<2> stress = Tensor<2>::Zero();
    stress(0, 1) = direction * (total - parameters_.plasma_viscosity * shear_rate);
    stress(1, 0) = stress(0, 1);
    average.add(stress);
    ++samples;
  }
  Observation<2> result = average.observation();
  result.hematocrit = forcing.hematocrit;
  result.warm_up_time = static_cast<double>(warm_up) * spacing / shear_rate;
  result.steps = warm_up + samples;
  time_ += result.warm_up_time + result.averaging_time;
  return result;
}

Snapshot SyntheticModel::snapshot() const {
  return {.reals = {{"synthetic.noise", {noise_}}, {"synthetic.time", {time_}}},
          .integers = {{"synthetic.seed", {static_cast<std::int64_t>(seed_)}},
                       {"synthetic.stream", {static_cast<std::int64_t>(stream_)}},
                       {"synthetic.counter", {static_cast<std::int64_t>(counter_)}}}};
}

void SyntheticModel::restore(const Snapshot& snapshot) {
  const auto real = [&](const char* name) {
    const auto found = snapshot.reals.find(name);
    if (found == snapshot.reals.end() || found->second.size() != 1) {
      throw ParameterError(
          fmt::format("snapshot: no single value '{}'; one of a synthetic model is "
                      "needed; restore it into the kind of model that wrote it",
                      name));
    }
    return found->second.front();
  };
  const auto integer = [&](const char* name) {
    const auto found = snapshot.integers.find(name);
    if (found == snapshot.integers.end() || found->second.size() != 1) {
      throw ParameterError(
          fmt::format("snapshot: no single value '{}'; one of a synthetic model is "
                      "needed; restore it into the kind of model that wrote it",
                      name));
    }
    return static_cast<std::uint64_t>(found->second.front());
  };
  const double noise = real("synthetic.noise");
  const double time = real("synthetic.time");
  const std::uint64_t seed = integer("synthetic.seed");
  const std::uint64_t stream = integer("synthetic.stream");
  counter_ = integer("synthetic.counter");
  seed_ = seed;
  stream_ = stream;
  noise_ = noise;
  time_ = time;
}

}  // namespace hemoscale::micro
