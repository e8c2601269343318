#pragma once

#include <memory>
#include <optional>
#include <variant>
#include <vector>

#include "micro/cells/ring_mesh.hpp"
#include "micro/ensemble/contact_law.hpp"
#include "micro/ensemble/flow/given_flow.hpp"
#include "micro/ensemble/flow/wall_geometry.hpp"
#include "micro/ensemble/migration/lateral_migration.hpp"
#include "micro/ensemble/ring_forces.hpp"
#include "micro/ensemble/wall_potential.hpp"

namespace hemoscale::micro::blocks {

/// How the equations of the nodes are advanced.
enum class Integrator {
  explicit_euler,     // overdamped, x += dt (u + F/zeta)
  linearly_implicit,  // one linear system per ring and step, full second derivative of its energy
  constant_operator,  // backward Euler, one simplified Newton step with constant coefficients
  constant_operator_second_order,  // the same with backward differences of second order
  inertial,  // nodes with mass; drag by velocity difference, linear and quadratic
  chebyshev  // stabilised explicit Runge-Kutta of second order; forces of contacts of first order
};

/// Whether an integrator keeps a second state of every node.
constexpr bool has_memory(Integrator integrator) {
  return integrator != Integrator::linearly_implicit;
}

/// One kind of cell with its laws, in SI.
struct KindSettings {
  RingMesh mesh;
  MembraneLaws laws;
  double node_drag =
      0;  // [Pa s] zeta, per unit depth; that of a cell shared by its nodes, or their own
  double normal_drag =
      1;                 // [-] drag of a node across the membrane over that along it, `node_drag`;
                         // other than 1 for the explicit integrators without mass alone
  double node_mass = 0;  // [kg/m] per unit depth; inertial integrator alone
  double momentum_drag = 0;  // [kg/m^2] k of the force k |u - v| (u - v) on a node, for nodes with
                             // mass
};

/// Everything that does not change while the blocks advance, in SI.
struct BlockSettings {
  std::vector<KindSettings> kinds;
  ContactLaw contact;
  std::shared_ptr<const GivenFlow> flow;
  bool parallel_flow = true;                     // along x, varying with y alone
  std::optional<WallPotential> plane_walls;      // at y = 0 and y = height
  double height = 0;                             // [m] of the plane channel, or the period along y
  bool periodic_y = false;                       // images slide with the shear of the flow
  double length = 0;                             // [m] period along x; 0: none
  std::shared_ptr<const WallGeometry> geometry;  // general walls, with `geometry_wall`
  WallPotential geometry_wall;
  Integrator integrator = Integrator::linearly_implicit;
  int stages = 10;       // [-] of a step by Integrator::chebyshev
  double time_step = 0;  // [s]
  bool force = false;    // a time step beyond the limits of block_limits.hpp
  LateralMigration migration;
  double skin = 0.4e-6;  // [m] by which contacts are searched beyond the cutoff; lists are pruned
                         // to a part of it between searches; no result depends on it
  std::size_t cache = 12U << 20U;  // [bytes] of data beyond which blocks are advanced in tiles that
                                   // stay in the cache; no result depends on it
  int threads = 1;
};

/// Whether the data of so many cells exceed the cache, at some 40 bytes for each node.
bool exceed_cache(const BlockSettings& settings, std::size_t cells);

}  // namespace hemoscale::micro::blocks
