#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "micro/ensemble/observables/cell_flux.hpp"
#include "micro/ensemble/observables/slices.hpp"
#include "micro/model.hpp"

namespace hemoscale::micro {

/// Profiles across a straight channel, by bins from wall to wall; not a number in a bin that no
/// cell has touched.
struct LateralProfiles {
  std::vector<double> y;              // [m] middle of the bin
  std::vector<double> area_fraction;  // [-]
  std::vector<double> cell_velocity;  // [m/s] along x, by area
  std::vector<double> flow_velocity;  // [m/s] of the given flow at the middle
  std::vector<double> area_flux;      // [m/s] flux density of cell area
  std::vector<double> along_flow;     // [-] <cos 2a> by area, a: inclination of the long axis
  std::vector<double> inclination;    // [rad] atan2(<sin 2a>, <cos 2a>)/2, mirrored above the axis
  std::vector<double> shear_stress;   // [Pa] of the cells through planes, Sigma_xy
  std::vector<double> normal_stress;  // [Pa] Sigma_yy
};

/// What one sample adds to the profiles; an empty list adds zeros.
struct LateralContribution {
  LateralSums sums;
  std::vector<double> flow_velocity;                // [m/s]
  std::vector<double> shear_stress, normal_stress;  // [Pa]
};

/// Mean of profiles over samples, all of the same weight.
class LateralAverage {
 public:
  explicit LateralAverage(std::size_t bins);

  /// @param length, height  of the channel [m]
  void add(const LateralContribution& contribution, double length, double height);

  std::int64_t samples() const { return samples_; }

  /// @throws ParameterError without a sample
  LateralProfiles profiles() const;

  void store(Snapshot& snapshot) const;
  /// @throws ParameterError if the snapshot has other bins
  void load(const Snapshot& snapshot);

 private:
  LateralContribution total_;
  double length_ = 0;  // [m] summed
  double height_ = 0;  // [m] summed
  std::int64_t samples_ = 0;
};

}  // namespace hemoscale::micro
