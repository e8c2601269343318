#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "micro/ensemble/flow/openings.hpp"

namespace hemoscale::micro {

/// What is fed into an opening.
struct Feed {
  double hematocrit = 0;  // [-] area of cells over area of blood that enters (discharge)
  double clearance = 0;   // [m] cells enter at least so far from the ends of the opening
  /// [-] relative concentration of cells in bins of equal width from a to b; empty: uniform
  std::vector<double> profile = {};
};

/// A cell that is due at an opening.
struct Arrival {
  Vector<2> place = Vector<2>::Zero();  // [m] of its centre, on the opening
  double angle = 0;                     // [rad] of its axis, uniform in [0, 2 pi)
};

/// Says when and where cells enter: their area flows in at the rate
///
///   dA/dt = hematocrit * integral of max(u.n, 0) ds,
///
/// and one is due whenever as much has entered as the next cell needs. Across the opening a centre
/// is found with a probability density proportional to max(u.n, 0) times the profile. Where is
/// drawn by number, so that the same seed and stream give the same cells, whatever the step.
class InflowQueue {
 public:
  /// What changes; all of it.
  struct State {
    double area = 0;             // [m^2] that has entered and is not yet in cells
    std::uint64_t arrivals = 0;  // so far
  };

  /// @throws ParameterError for an opening without length, a hematocrit outside [0, 1), a clearance
  ///         that leaves nothing of the opening, a profile that is negative or zero throughout
  InflowQueue(const Opening& opening, const Feed& feed, std::shared_ptr<const GivenFlow> flow,
              std::uint64_t seed, std::uint64_t stream);

  /// Lets the flow enter from a time on for dt; by Simpson's rule if the flow is not steady.
  void advance(double time, double dt);

  /// How many cells of this area [m^2] are due.
  std::uint64_t due(double cell_area) const;

  /// The next of them; its area is taken off what has entered.
  /// @throws NumericalError if none is due, or nothing flows in where centres may be
  Arrival take(double cell_area, double time);

  State state() const { return state_; }
  void restore(const State& state) { state_ = state; }

  const Opening& opening() const { return opening_; }

 private:
  double area_rate(double time) const;  // [m^2/s]
  double place_along(double draw, double time) const;

  Opening opening_;
  Feed feed_;
  std::shared_ptr<const GivenFlow> flow_;
  std::uint64_t seed_ = 0;
  std::uint64_t stream_ = 0;
  double steady_rate_ = 0;  // [m^2/s] of cells, if the flow is steady
  State state_;
};

}  // namespace hemoscale::micro
