#pragma once

namespace hemoscale::micro {

/// Which energy resists bending.
enum class BendingLaw {
  turning_angle,      // (kappa/2) sum (theta - theta0)^2 / l0
  half_angle_tangent  // (k_b/2) sum tan^2((theta - theta0)/2), k_b = 4 kappa/l0: the form of the
                      // paper
};

/// Angles at which bending vanishes.
enum class NaturalShape {
  flat,    // theta0 = 0
  outline  // theta0 of the outline
};

/// Moduli of a two-dimensional membrane; all energies are per unit depth.
struct MembraneParameters {
  double stretch_modulus = 5e-6;   // [N/m] line tension per strain
  double bending_modulus = 2e-19;  // [J] energy (kappa/2) int curvature^2 ds
  BendingLaw bending_law = BendingLaw::turning_angle;
  NaturalShape natural_shape = NaturalShape::outline;
  double area_modulus = 50;  // [Pa] energy (k_A/2) (A - A0)^2 / A0
};

}  // namespace hemoscale::micro
