#pragma once

#include <optional>
#include <variant>

#include "macro/analytic/flow_curve.hpp"
#include "macro/viscosity/viscosity_law.hpp"

namespace hemoscale::macro {

/// Drive by a given pressure gradient G = -dp/dx, positive for flow along +x.
struct PressureGradient {
  double value = 0;  // [Pa/m]
};

/// Drive by whatever pressure gradient gives this mean velocity, positive along +x.
struct MeanVelocity {
  double value = 0;  // [m/s]
};

using ChannelDrive = std::variant<PressureGradient, MeanVelocity>;

/// Plane channel between resting walls y = 0 and y = height, filled at uniform hematocrit.
struct Channel {
  double height = 0;      // [m] positive
  double hematocrit = 0;  // [-] in [0, 1)
  ChannelDrive drive;     // zero: fluid at rest
};

/// @throws ParameterError naming the first parameter that is not admissible
void check(const Channel& channel);

/// Steady flow of a generalised Newtonian fluid in a plane channel: with the pressure gradient G
/// and the law mu(g),
///
///   tau(y) = G (height / 2 - y),   mu(g) g = |tau|,   du/dy = sign(tau) g,   u = 0 at both walls.
///
/// Relative accuracy of all figures better than 1e-10 (see FlowCurve for the quadrature).
class ChannelProfile {
 public:
  struct Point {
    double velocity = 0;    // [m/s]
    double shear_rate = 0;  // [1/s] |du/dy|
    double gradient = 0;    // [1/s] du/dy
  };

  /// @throws NumericalError if the shear stress of the law does not increase with the shear rate
  ///         everywhere between rest and the wall; the message names the shear rate
  ChannelProfile(const ViscosityLaw& law, const Channel& channel);

  /// @param y  0 to height [m]
  Point at(double y) const;

  double height() const { return height_; }                        // [m]
  double pressure_gradient() const { return pressure_gradient_; }  // [Pa/m] G = -dp/dx
  double wall_shear_rate() const;                                  // [1/s]
  double mean_velocity() const { return mean_velocity_; }          // [m/s]

 private:
  double height_;                   // [m]
  double sign_ = 0;                 // of the flow: 1, -1, or 0 at rest
  std::optional<FlowCurve> curve_;  // empty at rest
  double pressure_gradient_ = 0;    // [Pa/m]
  double mean_velocity_ = 0;        // [m/s]
};

}  // namespace hemoscale::macro
