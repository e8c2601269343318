#pragma once

#include "macro/openfoam/mesh_outline.hpp"
#include "macro/openfoam/mesh_units.hpp"

namespace Foam {
class polyMesh;
}

namespace hemoscale::macro {

/// The edges of the boundary faces that lie in the plane of least z, joined end to end; points on a
/// straight line are left out.
/// @throws ParameterError unless the mesh is one cell deep in z, between empty patches, or if
///         boundaries touch at a point
MeshOutline wall_polylines(const Foam::polyMesh& mesh, const MeshUnits& units);

}  // namespace hemoscale::macro
