#pragma once

#include <cstddef>
#include <vector>

#include "macro/analytic/gauss_legendre.hpp"
#include "macro/viscosity/viscosity_law.hpp"

namespace hemoscale::macro {

/// Shear stress against shear rate of one law at one hematocrit, from rest up to a wall shear rate,
/// with the integrals that give velocity and flow rate of a plane channel.
///
/// With the stress tau(g) = mu(g) g and s = log(g), integration by shear rate instead of by
/// position needs no inversion and follows the law's own scale, however thin its layers:
///
///   slip(g) = int gamma d tau over (g, g_wall)  =  int g mu(g) (1 + slope(g)) g ds
///   moment  = int gamma tau d tau over (0, g_wall)
///
/// so that u = slip / G and the flow rate per depth is 2 moment / G^2 (Weissenberg and
/// Rabinowitsch, in Rabinowitsch 1929, for plates). Gauss-Legendre panels of half a unit of s, new
/// ones at every kink of the law; relative error below 1e-12 for laws that are analytic between
/// their kinks.
class FlowCurve {
 public:
  /// The curve up to the lowest shear rate that bears this stress.
  /// @param wall_stress  positive [Pa]
  /// @throws NumericalError naming the shear rate where the stress stops increasing, if that lies
  ///         below: the profile would not be unique (shear banding)
  static FlowCurve up_to_stress(const ViscosityLaw& law, double hematocrit, double wall_stress);

  /// The curve up to the wall shear rate at which the mean velocity in a channel of this height is
  /// reached.
  /// @param mean_rate  mean velocity over height, positive [1/s]
  /// @throws NumericalError as up_to_stress()
  static FlowCurve up_to_mean_rate(const ViscosityLaw& law, double hematocrit, double mean_rate);

  double wall_shear_rate() const;                          // [1/s]
  double wall_stress() const { return stresses_.back(); }  // [Pa]

  /// int gamma tau d tau from rest to the wall [Pa^2/s].
  double moment() const { return moments_.back(); }

  /// Shear rate that bears a stress, mu(g) g = stress to rounding [1/s].
  /// @param stress  0 to wall_stress() [Pa]
  double shear_rate(double stress) const;

  /// int gamma d tau from this shear rate to that at the wall [Pa/s]; exactly 0 at the wall.
  double slip(double shear_rate) const;

 private:
  FlowCurve(const ViscosityLaw& law, double hematocrit);

  double stress_at(double log_rate) const;        // mu(g) g [Pa]
  double stress_slope_at(double log_rate) const;  // d log(tau) / d s [-]
  double slip_density(double log_rate) const;     // d slip / d s [Pa/s]
  double moment_density(double log_rate) const;   // d moment / d s [Pa^2/s]

  void start_below(double shear_rate);
  void add_panel();
  double panel_end() const;
  void end_last_panel_at(double log_rate);
  void sum_slip_from_wall();
  double log_rate_for(double stress, double low, double high) const;

  ViscosityLaw law_;
  double hematocrit_;  // [-]
  GaussLegendre rule_;
  std::vector<double> log_kinks_;  // log(shear rate / (1/s)) increasing
  std::vector<double> log_rates_;  // panel ends, increasing; the last is the wall
  std::vector<double> stresses_;   // [Pa] at the panel ends
  std::vector<double> moments_;    // [Pa^2/s] from rest to the panel end
  std::vector<double> slips_;      // [Pa/s] from the panel end to the wall
};

}  // namespace hemoscale::macro
