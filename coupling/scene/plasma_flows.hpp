#pragma once

#include "coupling/config/settings.hpp"
#include "coupling/scene/plasma_scene.hpp"

namespace hemoscale::coupling {

/// Fills in where a plasma flows, what drives it, how it begins, and the exact flow where one is
/// known. The method and the fluid of the scene are known already: nodes on the walls belong to the
/// least-squares method, rows of wall particles to the semi-implicit one.
/// @throws CaseError naming every key that the flow lacks, has no use for, or that the method
///         cannot resolve
template <int dim>
void build_plasma_flow(const Settings& settings, PlasmaScene<dim>& scene);

}  // namespace hemoscale::coupling
