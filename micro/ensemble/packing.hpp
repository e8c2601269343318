#pragma once

#include <cstdint>
#include <vector>

#include "micro/ensemble/state.hpp"
#include "micro/ensemble/system.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// Random initial positions without interpenetration, the same for the same seed and stream.
///
/// The cells are put with random orientations and displacements on the sites of a lattice so wide
/// that they cannot touch; the box is then compressed to its size while contacts and membranes
/// relax, without flow. If nodes have entered other cells, the attempt is repeated at half the
/// speed from another arrangement. Cells without contact stiffness are put anywhere.
///
/// @param outline  undeformed cell, centred on the origin [m]
/// @throws ParameterError if no attempt succeeds: the message names fraction, effective fraction
/// with
///         half the rest distance around every cell, and remedies
EnsembleState pack_cells(const EnsembleSystem& system, const std::vector<Vector<2>>& outline,
                         std::size_t cells, const Box& box, std::uint64_t seed,
                         std::uint64_t stream);

}  // namespace hemoscale::micro
