#pragma once

#include <string>
#include <vector>

#include "coupling/scene/plasma_scene.hpp"
#include "micro/cells/capillary_number.hpp"
#include "micro/immersed/cells_in_plasma.hpp"

namespace hemoscale::coupling {

/// Everything a run of cells in plasma is made of.
struct CellScene {
  PlasmaScene<2> plasma;           // without particles in unbounded flow
  std::vector<micro::Cell> cells;  // at the start
  double rate = 0;                 // [1/s] of unbounded shear; zero in bounded flow
  double time_step = 0;            // [s] the longest
  double radius = 0;               // [m] R0 of a cell

  /// Open lines along the walls, for gaps and pictures.
  std::vector<std::vector<micro::Vector<2>>> walls;

  bool is_unbounded() const { return rate != 0; }
  double period() const;  // [m] along x; zero if there is none
};

/// Whether the case has cells in its plasma.
bool has_cells_in_plasma(const Settings& settings);

/// @throws CaseError with all keys that are missing or cannot be, micro::ParameterError for what
///         they cannot be together
CellScene build_cell_scene(const Settings& settings, bool force);

/// The model of the scene, by the coupling that the case names.
/// @throws micro::ParameterError for what the coupling cannot take, limits of its step included
micro::CellsInPlasma build_cells_in_plasma(const CellScene& scene, const Settings& settings,
                                           bool force);

/// For dimensionless numbers.
micro::CellInFlow cell_in_flow(const CellScene& scene, const Settings& settings);

/// What deserves a warning before the run: membranes that stretch without bound.
std::vector<std::string> cell_warnings(const CellScene& scene, const Settings& settings);

/// What the case is, in lines for `hemoscale check`.
std::string describe_cells_in_plasma(const Settings& settings);

}  // namespace hemoscale::coupling
