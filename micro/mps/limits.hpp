#pragma once

#include <string>
#include <vector>

namespace hemoscale::micro {

/// One limit of a method, evaluated.
struct Limit {
  std::string name;  // e.g. "viscous limit"
  double value = 0;
  double limit = 0;  // value must not exceed it
  std::string unit;
  std::string remedy;

  bool exceeded() const { return !(value <= limit); }
};

/// "viscous limit: 5e-07 s exceeds 4.1e-07 s; ...".
std::string describe(const Limit& limit);

/// @throws ParameterError describing all exceeded limits, unless `force`
void require_within(const std::vector<Limit>& limits, bool force);

/// Explicit Euler on the Laplacian of the moving-particle method: the step must not exceed
///
///   2 l0^2 / (nu Lambda)
///
/// with its largest eigenvalue Lambda / l0^2 on the lattice (sharp; 5 % disorder moves it by less
/// than a tenth).
/// @param radius  of the Laplacian over the spacing
template <int dim>
Limit viscous_limit(double time_step, double kinematic_viscosity, double spacing, double radius);

/// Particles must not pass each other within a step: u dt / l0 <= 1/2.
Limit advective_limit(double time_step, double speed, double spacing);

/// The projection without the old pressure leaves, in a channel driven by a pressure gradient, a
/// slip velocity dt grad p / rho = 12 nu dt / D^2 U; 0.89 of it is the root mean square error.
/// Admitted: 1 %.
Limit splitting_limit(double time_step, double kinematic_viscosity, double gap);

/// The number-density source corrects displacements x and velocities u (in units of a step) by a
/// share g = gamma density_gain() of the deviation: x <- (1 - g)(x + u), u <- u - g (x + u). The
/// eigenvalues 1 - g +- sqrt(g^2 - g) lie within the unit circle up to
///
///   g = 4/3,
///
/// whatever the step: beyond it the pressure alternates and grows. Radii of 2.1 (gradient) and 3.1
/// (Laplacian) need gamma < 0.94. Within it, waves of about two spacings still grow by some per
/// cent a step if there is no viscosity to damp them: their gain is slightly negative. On particles
/// that are no longer a lattice the limit is lower; half of it has proved safe.
template <int dim>
Limit density_gain_limit(double relaxation, double gradient_radius, double laplacian_radius);

/// A deviation eps of the number density throws particles apart with gamma eps l0 / dt in one step,
/// the faster the smaller the step. Admitted: the speed of the flow.
/// @param relaxation  gamma [-]
/// @param deviation  eps: root mean square of n / n0 - 1 at the beginning [-]
Limit density_kick_limit(double time_step, double relaxation, double deviation, double spacing,
                         double speed);

}  // namespace hemoscale::micro
