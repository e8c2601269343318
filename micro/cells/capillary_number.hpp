#pragma once

#include <string>

namespace hemoscale::micro {

/// A cell and the flow around it, for dimensionless numbers.
struct CellInFlow {
  double viscosity = 0;        // [Pa s] of the plasma
  double density = 0;          // [kg/m^3] of the plasma; zero without inertia
  double speed = 0;            // [m/s] U: mean velocity in a channel, G R0 in the shear G
  double radius = 0;           // [m] R0 = P / (2 pi), of the perimeter at rest
  double gap_width = 0;        // [m] H between the walls; infinite in unbounded flow
  double stretch_modulus = 0;  // [N/m] E_l; infinite for an inextensible membrane
  double bending_modulus = 0;  // [J] kappa
};

struct CellNumbers {
  double bending_capillary = 0;  // [-] Ca_b = mu U R0^2 / kappa
  double stretch_capillary = 0;  // [-] Ca_s = mu U / E_l: about the strain of the membrane
  double confinement = 0;        // [-] C_n = 2 R0 / H
  double reynolds = 0;           // [-] Re = rho U H / mu, with 2 R0 for H in unbounded flow
};

/// Ca_b is stated with R0 and U; in shear U = G R0 makes it mu G R0^3 / kappa. With the rate U / H
/// of a channel, or with R_A = sqrt(A / pi), as others have it, it is R0 / H, or nu^(3/2) with the
/// reduced area nu, times this.
/// @throws ParameterError naming all values that are not admissible
CellNumbers cell_numbers(const CellInFlow& cell);

/// A linear membrane stretches without bound when the viscous traction, mu U, exceeds its modulus:
/// beyond Ca_s = 1 no steady shape exists, and what is computed says nothing about cells.
constexpr double largest_stretch_capillary = 1;

/// @returns the sentence that says so, with the numbers and the remedy; empty while Ca_s is below
///          the largest
std::string unbounded_stretch(const CellInFlow& cell);

}  // namespace hemoscale::micro
