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
  flat,      // theta0 = 0
  outline,   // theta0 of the outline
  curvature  // theta0 = c0 l0: a uniform spontaneous curvature
};

/// What resists a change of length.
enum class StretchLaw {
  linear,        // (E_l/2) sum l0 ((l - l0)/l0)^2
  line_element,  // (k_l/2) sum ((l - l0)/l0)^2 with one k_l for all: the form of the paper
  inextensible   // l = l0, held by one multiplier for each segment
};

/// What keeps the enclosed area.
enum class AreaLaw {
  penalty,  // (k_A/2) (A - A0)^2 / A0
  exact     // A = A0, held by a projection along the normals
};

/// Moduli of a two-dimensional membrane; all energies are per unit depth.
struct MembraneParameters {
  StretchLaw stretch_law = StretchLaw::linear;
  double stretch_modulus = 5e-6;   // [N/m] line tension per strain
  double bending_modulus = 2e-19;  // [J] energy (kappa/2) int curvature^2 ds
  BendingLaw bending_law = BendingLaw::turning_angle;
  NaturalShape natural_shape = NaturalShape::outline;
  double spontaneous_curvature = 0;  // [1/m] c0, with NaturalShape::curvature
  AreaLaw area_law = AreaLaw::penalty;
  double area_modulus = 50;  // [Pa] energy (k_A/2) (A - A0)^2 / A0
};

}  // namespace hemoscale::micro
