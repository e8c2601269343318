#pragma once

#include <functional>
#include <span>
#include <vector>

#include "micro/ensemble/box.hpp"
#include "micro/ensemble/contact_law.hpp"
#include "micro/ensemble/neighbour_list.hpp"
#include "micro/ensemble/state.hpp"
#include "micro/ensemble/system.hpp"

namespace hemoscale::micro {

/// Forces of one origin on all nodes [N/m], per unit depth; empty if there is no such origin.
struct ForceView {
  std::span<const double> x, y;
};

/// Forces on the nodes by origin. Pair forces between cells of the same kind are not among them:
/// observers compute these from the positions.
struct NodeForces {
  ForceView membrane;
  ForceView other_kinds;  // contacts with cells of another kind
  ForceView wall;
  ForceView lift;  // laws of lateral migration
};

/// A law of contact between two nodes, of whatever form.
struct PairLaw {
  std::function<double(double)> force_over_distance;  // [Pa] of the squared distance [m^2];
                                                      // positive: repulsion
  double rest_distance = 0;                           // [m] below which it repels
  double cutoff = 0;                                  // [m] from which it vanishes
};
PairLaw make_pair_law(const ContactLaw& law);

/// Owns the forces of one origin.
struct ForceArrays {
  std::vector<double> x, y;  // [N/m]

  ForceView view() const { return {x, y}; }
};

/// Pair forces between cells of one kind, apart by sign.
struct PairParts {
  ForceArrays repulsion, attraction;
};

/// @param list  built for these positions with a range of at least the cutoff
PairParts pair_parts(const EnsembleState& state, const Box& box, const NeighbourList& list,
                     const PairLaw& law);

/// Membrane and wall forces of the explicit reference model, for its states and for tests. An
/// implicit scheme leaves positions whose stiff forces are not those that moved the nodes; it gives
/// the mean force of its step instead, drag times (displacement over time step less the flow).
struct ReferenceForces {
  ForceArrays membrane, wall;
};
ReferenceForces reference_forces(const EnsembleState& state, const Box& box,
                                 const EnsembleSystem& system);

}  // namespace hemoscale::micro
