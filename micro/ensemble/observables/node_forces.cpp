#include "micro/ensemble/observables/node_forces.hpp"

#include <cmath>

#include "micro/ensemble/ring_forces.hpp"

namespace hemoscale::micro {

PairLaw make_pair_law(const ContactLaw& law) {
  return {.force_over_distance = [law](double s) { return force_over_distance(law, s); },
          .rest_distance = rest_distance_of(law),
          .cutoff = cutoff_of(law)};
}

PairParts pair_parts(const EnsembleState& state, const Box& box, const NeighbourList& list,
                     const PairLaw& law) {
  const ImageTable images(box, state.image_offset);
  const std::size_t nodes = state.x.size();
  const double cutoff_squared = law.cutoff * law.cutoff;
  PairParts parts;
  for (ForceArrays* part : {&parts.repulsion, &parts.attraction}) {
    part->x.assign(nodes, 0.0);
    part->y.assign(nodes, 0.0);
  }
  for (std::size_t i = 0; i < nodes; ++i) {
    for (const Neighbour& other : list.of(i)) {
      const auto image = static_cast<std::size_t>(other.image);
      const auto j = static_cast<std::size_t>(other.node);
      const double dx = state.x[i] - (state.x[j] + images.x[image]);
      const double dy = state.y[i] - (state.y[j] + images.y[image]);
      const double s = dx * dx + dy * dy;
      if (s >= cutoff_squared) continue;
      const double f = law.force_over_distance(s);
      ForceArrays& part = f > 0 ? parts.repulsion : parts.attraction;
      part.x[i] += f * dx;
      part.y[i] += f * dy;
    }
  }
  return parts;
}

ReferenceForces reference_forces(const EnsembleState& state, const Box& box,
                                 const EnsembleSystem& system) {
  const std::size_t nodes = state.x.size();
  ReferenceForces forces;
  forces.membrane.x.resize(nodes);
  forces.membrane.y.resize(nodes);
  RingGeometry scratch(system.mesh.nodes);
  for (std::size_t first = 0; first < nodes; first += state.nodes) {
    ring_forces(system.laws, system.mesh, state.x.data() + first, state.y.data() + first, scratch,
                forces.membrane.x.data() + first, forces.membrane.y.data() + first);
  }
  if (box.walls) {
    forces.wall.x.assign(nodes, 0.0);
    forces.wall.y.resize(nodes);
    for (std::size_t i = 0; i < nodes; ++i) {
      forces.wall.y[i] = system.wall.force(state.y[i]) - system.wall.force(box.height - state.y[i]);
    }
  }
  return forces;
}

}  // namespace hemoscale::micro
