#pragma once

#include <variant>

#include "micro/cells/area.hpp"
#include "micro/cells/half_angle_bending.hpp"
#include "micro/cells/ring_geometry.hpp"
#include "micro/cells/ring_mesh.hpp"
#include "micro/cells/stretch.hpp"
#include "micro/cells/turning_angle_bending.hpp"

namespace hemoscale::micro {

/// The energies of one kind of cell, resolved from its parameters once.
struct MembraneLaws {
  Stretch stretch;
  std::variant<TurningAngleBending, HalfAngleBending> bending;
  AreaPenalty area;
};

MembraneLaws make_membrane_laws(const MembraneParameters& parameters);

/// Elastic forces on the nodes of one ring [N/m], overwriting force_x and force_y. The shape is
/// left in `scratch`.
void ring_forces(const MembraneLaws& laws, const RingMesh& mesh, const double* x, const double* y,
                 RingGeometry& scratch, double* force_x, double* force_y);

/// Elastic energy of one ring per unit depth [N].
double ring_energy(const MembraneLaws& laws, const RingMesh& mesh, const double* x, const double* y,
                   RingGeometry& scratch);

}  // namespace hemoscale::micro
