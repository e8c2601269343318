#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "micro/cells/membrane.hpp"
#include "micro/ensemble/blocks/block_settings.hpp"
#include "micro/ensemble/packing/cell_room.hpp"
#include "micro/ensemble/packing/insertion.hpp"
#include "micro/ensemble/parameters.hpp"
#include "micro/ensemble/state.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// Platelets at rest: small stiff ellipses.
///
/// The drag of a cell per unit depth, 12 times the viscosity, is that of red cells: in two
/// dimensions the drag on a body per unit depth depends on its size by a logarithm alone, so it is
/// kept for platelets; the nodes share it.
struct PlateletParameters {
  double length = 2.5e-6;     // [m]
  double thickness = 1.0e-6;  // [m]
  int nodes = 28;             // a spacing of 0.2 um, about that of a red cell of 100
  // Ten times a red cell, so that no contact deforms them visibly.
  MembraneParameters membrane = {.stretch_modulus = 5e-5, .bending_modulus = 2e-18};
  DragParameters drag;
  double per_red_cell = 1.0 / 16;  // [-] of the numbers; 3e5 over 5e6 per cubic millimetre
};

struct Platelets {
  blocks::KindSettings kind;
  std::vector<Vector<2>> outline;  // [m] centred on the origin
};

/// @throws ParameterError for axes, moduli or drag that are not admissible
Platelets make_platelets(const PlateletParameters& parameters, double plasma_viscosity);

/// How many platelets go with so many red cells, to the nearest.
std::size_t platelets_for(std::size_t red_cells, const PlateletParameters& parameters);

/// Platelets at random places and angles in the gaps that cells leave, the same for the same seed
/// and stream.
/// @param cells   those that are there, all kinds
/// @param region  where centres may lie [m]
/// @throws ParameterError if no gap is left for one of them: how many found one, remedies
EnsembleState place_in_gaps(std::span<const Vector<2>> outline, std::size_t count,
                            std::span<const EnsembleState> cells, const CellRoom& room,
                            const Bounds& region, const Clearance& clearance, std::uint64_t seed,
                            std::uint64_t stream);

}  // namespace hemoscale::micro
