#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "coupling/config/settings.hpp"
#include "micro/cells/outline.hpp"
#include "micro/ensemble/blocks/block_settings.hpp"
#include "micro/ensemble/regions/region_settings.hpp"

namespace hemoscale::coupling {

/// micro.integrator, or its default for the domain.
std::string integrator_name(const Settings& settings);

/// The integrator on vectors of that name.
/// @pre runs_on_vectors
micro::blocks::Integrator block_integrator(const Settings& settings);

/// The law of contact that micro.contact.law asks for.
micro::ContactLaw contact_law(const Settings& settings);

/// Red cells, then platelets if there are any: meshes, laws, drag and mass. With mass, platelets
/// have the density of the red cells and the same ratio of momentum drag to viscous drag.
/// @throws micro::ParameterError
struct EnsembleKinds {
  std::vector<micro::blocks::KindSettings> kinds;
  std::vector<std::string> names;
  std::vector<std::vector<micro::Vector<2>>> outlines;  // [m] at rest
};
EnsembleKinds build_kinds(const Settings& settings);

/// How many platelets go with the red cells.
std::size_t platelet_count(const Settings& settings);

/// Laws of lateral migration that are on; the radius is that of a circle with the perimeter of a
/// red cell.
/// @param shear_rate  [1/s] the largest of the flow, which plane channels have at a wall
micro::LateralMigration build_migration(const Settings& settings, const micro::RingMesh& red_cell,
                                        double shear_rate);

/// What every result must say about laws that are on although the model is defined without them.
std::vector<std::string> optional_laws(const Settings& settings);

/// micro.regions.
micro::RegionOptions region_options(const Settings& settings);

}  // namespace hemoscale::coupling
