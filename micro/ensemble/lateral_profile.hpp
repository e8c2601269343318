#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "micro/ensemble/box.hpp"
#include "micro/ensemble/frame.hpp"
#include "micro/ensemble/state.hpp"
#include "micro/velocity_profile.hpp"

namespace hemoscale::micro {

/// Collects what varies across a channel, sample by sample.
class ProfileAverage {
 public:
  ProfileAverage(const Box& box, int bins);

  /// @param force_x  on the nodes, whose velocity is u + F / drag [N/m]
  /// @param wall_force  of the cells on both walls together [N/m]
  void add(const EnsembleState& state, const CubicProfile& flow, const std::vector<double>& force_x,
           double node_drag, double wall_force);

  /// @pre at least one sample
  LateralProfile mean() const;

 private:
  void add_area(const EnsembleState& state);
  void add_free_layer(const EnsembleState& state);

  Box box_;
  std::size_t bins_;
  std::vector<double> area_;         // [m^2] of cells in each bin, summed
  std::vector<double> velocity_;     // [m/s] summed over nodes
  std::vector<std::int64_t> nodes_;  // counted
  double free_layer_ = 0;            // [m] summed
  double wall_force_ = 0;            // [N/m] summed
  std::int64_t samples_ = 0;
};

/// Area of a closed polygon below a horizontal line [m^2], exact: the integral of x dy along the
/// part of its outline below the line.
/// @param x, y  nodes, counter-clockwise [m]
double area_below(const double* x, const double* y, std::size_t nodes, double line);

}  // namespace hemoscale::micro
