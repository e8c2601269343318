#pragma once

#include <variant>

#include "micro/cells/ring_mesh.hpp"
#include "micro/ensemble/box.hpp"
#include "micro/ensemble/pair_potential.hpp"
#include "micro/ensemble/ring_forces.hpp"
#include "micro/ensemble/wall_potential.hpp"
#include "micro/velocity_profile.hpp"

namespace hemoscale::micro {

/// What does not change while an ensemble moves: parameters resolved into laws.
struct EnsembleSystem {
  RingMesh mesh;
  MembraneLaws laws;
  PairPotential contact;
  WallPotential wall;
  double node_drag = 0;             // [Pa s] zeta, per unit depth
  double time_step = 0;             // [s]
  double explicit_limit = 0;        // [s] for messages
  double segment_strain_limit = 0;  // [-]
  int threads = 1;
};

/// Simple shear u = rate * y e_x.
struct SimpleShear {
  double rate = 0;  // [1/s] of either sign
};

using Flow = std::variant<SimpleShear, CubicProfile>;

}  // namespace hemoscale::micro
