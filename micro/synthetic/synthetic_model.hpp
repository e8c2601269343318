#pragma once

#include <cstdint>
#include <functional>

#include "micro/model.hpp"

namespace hemoscale::micro {

/// A micro model of known law, for tests and demonstrations of the coupling: its shear stress is
/// law(shear rate, hematocrit) * shear rate plus correlated noise.
struct SyntheticParameters {
  std::function<double(double shear_rate, double hematocrit)> law;  // [Pa s] of |shear rate| [1/s]
  double plasma_viscosity = 1.2e-3;  // [Pa s] only splits the stress into plasma and particles
  double noise = 0.05;               // [-] standard deviation of the stress over its mean
  double correlation_strain = 1;  // [-] of the noise: correlation exp(-strain/correlation_strain)
  double sampling_strain = 0.05;  // [-] between samples
};

/// Ends its runs by the same rule and with the same estimator as the ensemble.
class SyntheticModel final : public MicroModel<2> {
 public:
  /// @throws ParameterError
  SyntheticModel(SyntheticParameters parameters, std::uint64_t seed, std::uint64_t stream = 0);

  Observation<2> advance(const Forcing<2>& forcing, const Run& run) override;
  Snapshot snapshot() const override;
  void restore(const Snapshot& snapshot) override;

 private:
  double next_noise();  // [-] standard normal, correlated

  SyntheticParameters parameters_;
  std::uint64_t seed_ = 0;
  std::uint64_t stream_ = 0;
  std::uint64_t counter_ = 0;  // draws so far
  double noise_ = 0;           // [-] last value
  double time_ = 0;            // [s]
};

}  // namespace hemoscale::micro
