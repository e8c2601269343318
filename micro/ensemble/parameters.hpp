#pragma once

#include <optional>
#include <variant>

#include "micro/cells/membrane.hpp"
#include "micro/cells/outline.hpp"

namespace hemoscale::micro {

/// Simple shear u = g y e_x in a box that is periodic in both directions; the images above and
/// below slide with the flow [Lees and Edwards 1972]. The area of the box follows from the number
/// of cells, their area and the hematocrit.
struct ShearBox {
  double aspect_ratio = 1;  // [-] length over height
};

/// Given flow u(y) e_x between the walls y = 0 and y = height, periodic along x. The length follows
/// from the number of cells, their area and the hematocrit.
struct PlaneChannel {
  double height = 0;  // [m]
};

/// Whose drag the coefficient describes. The choice moves the explicit limit of the time step by
/// the number of nodes over two or so, hence it is a named part of every case.
enum class DragConvention {
  cell,  // coefficient * viscosity is the drag of a cell, shared equally by its nodes
  node   // coefficient * viscosity is the drag of every node
};

struct DragParameters {
  DragConvention convention = DragConvention::cell;
  double coefficient = 12;  // [-] drag per unit depth over plasma viscosity
};

/// Soft repulsion and weak attraction between nodes of different cells (see pair_potential.hpp).
struct ContactParameters {
  double stiffness = 10;  // [Pa] -dF/dr at the rest distance, repulsive side, per pair and depth
  double rest_distance = 0.5e-6;  // [m] where the force of a pair vanishes
  double cutoff = 0.8e-6;         // [m] beyond which nodes do not feel each other
  double attraction = 0.05;       // [-] scale of the attractive branch over the repulsive one
};

/// Repulsion of a node by a wall (see wall_potential.hpp).
struct WallParameters {
  double stiffness = 10;  // [Pa] per node and unit depth
  double range = 0.5e-6;  // [m]
};

/// Everything that defines an ensemble except its seed. All quantities are per unit depth.
struct EnsembleParameters {
  int cells = 24;
  int nodes = 40;                    // per cell
  double hematocrit = 0.4;           // [-] area fraction, (0, 0.75]
  double plasma_viscosity = 1.2e-3;  // [Pa s]
  std::variant<ShearBox, PlaneChannel> domain = ShearBox{};
  OutlineParameters outline;
  MembraneParameters membrane;
  DragParameters drag;
  ContactParameters contact;
  WallParameters wall;
  std::optional<double> time_step = std::nullopt;  // [s] default: 0.8 of the explicit limit
  bool force = false;                              // run although the time step exceeds the limit
  double sampling_strain = 0.05;                   // [-] between samples of the stress
  double segment_strain_limit =
      1;            // [-] a segment stretched or compressed more than this ends the run
  int threads = 1;  // any number gives the same bits
};

}  // namespace hemoscale::micro
