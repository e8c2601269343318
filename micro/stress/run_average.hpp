#pragma once

#include <cstddef>
#include <vector>

#include "micro/model.hpp"

namespace hemoscale::micro {

/// @throws ParameterError with value, range and remedy if a run is not admissible
void require_admissible(const Run& run);

/// Collects equally spaced samples of the stress in simple shear and decides when a run has ended:
/// when the relative standard error of the total shear stress is reached with at least 20 effective
/// samples, not before the minimum strain; or when the maximum strain is spent. The error is looked
/// at when the averaged strain has grown by the larger of 1 and one twentieth since the last look:
/// looking after every sample would end runs at lucky moments.
class RunAverage {
 public:
  /// @param spacing  strain between samples [-]
  RunAverage(const Run& run, double shear_rate, double plasma_viscosity, double spacing);

  /// @param particle_stress  instantaneous stress due to the cells [Pa]
  void add(const Tensor<2>& particle_stress);

  bool finished() const { return finished_; }

  /// Stress, normal difference, particle stress, averaging time and termination; the other fields
  /// are left to the model.
  Observation<2> observation() const;

 private:
  double strain() const { return spacing_ * static_cast<double>(shear_stress_.size()); }
  bool is_precise() const;

  Run run_;
  double shear_rate_ = 0;                  // [1/s] signed
  double plasma_viscosity_ = 0;            // [Pa s]
  double spacing_ = 0;                     // [-] strain
  std::vector<double> shear_stress_;       // [Pa] total
  std::vector<double> normal_difference_;  // [Pa]
  Tensor<2> sum_ = Tensor<2>::Zero();      // [Pa] of the particle stress
  double next_look_ = 0;                   // [-] strain
  bool finished_ = false;
  Termination termination_ = Termination::allowance_spent;
};

}  // namespace hemoscale::micro
