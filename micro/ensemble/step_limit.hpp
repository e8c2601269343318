#pragma once

#include "micro/cells/ring_mesh.hpp"
#include "micro/ensemble/contact_law.hpp"
#include "micro/ensemble/parameters.hpp"

namespace hemoscale::micro {

/// Largest stable step of the explicit scheme and what it is made of.
///
///   time_step = 2 zeta / (ring + contact + wall)
///
/// Explicit Euler on zeta dx/dt = -dE/dx damps a mode of eigenvalue lambda of the energy if
/// dt lambda / zeta < 2. The three parts are taken as if their stiffest modes coincided.
struct StepLimit {
  double drag = 0;       // [Pa s] zeta: drag of a node per unit depth
  double ring = 0;       // [Pa] ring_stiffness
  double contact = 0;    // [Pa] contact_stiffness
  double wall = 0;       // [Pa] curvature of the wall potential; 0 without walls
  double time_step = 0;  // [s]
};

/// Largest eigenvalue of the energy of one ring at its reference shape [Pa]:
///
///   max( 4 E_l / l0,  16 kappa g / l0^3,  k_A P^2 / (N A0) )
///
/// for the shortest segment l0. The first two belong to zigzags along and across the membrane,
/// which do not mix where the turning angle is small: for a regular polygon both are exact but for
/// the factor cos^2(pi/N). The third belongs to swelling and excites no zigzag. g = 1 for turning
/// angles; for half angles g = (1 + t^2)(1 + 3 t^2) with the largest t = |tan((theta - theta0)/2)|
/// of the reference shape.
///
/// It is an estimate, not a bound: bending and stretching mix where the outline turns sharply, and
/// both stiffen where a membrane is compressed. The default step keeps a fifth in hand.
double ring_stiffness(const RingMesh& mesh, const RingMesh& natural_outline,
                      const MembraneParameters& membrane);

/// Bound on the eigenvalue that contacts add [Pa]: two rows of nodes face each other at the spacing
/// l0; K = max over distance and offset of the sum of U'' cos^2 + (U'/r) sin^2 over the nodes of
/// the other row that act on one node, along or across the rows; both rows move against each other:
/// 2 K.
double contact_stiffness(const ContactLaw& law, double spacing);

/// Limit of an ensemble.
/// @throws ParameterError if a parameter is not admissible
StepLimit step_limit(const EnsembleParameters& parameters);

}  // namespace hemoscale::micro
