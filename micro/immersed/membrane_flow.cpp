#include "micro/immersed/membrane_flow.hpp"

#include "micro/cells/outline_checks.hpp"

namespace hemoscale::micro {

MembraneFlow::MembraneFlow(const ImplicitMembranes& membranes)
    : membranes_(membranes),
      sources_(membranes.sources()),
      reaction_(membranes.surroundings().reaction(sources_)) {}

bool MembraneFlow::is_inside(const RingSource& source, const Vector<2>& place) const {
  const std::vector<Vector<2>>& ring = source.fine().positions;
  Vector<2> nearest = place;
  if (const auto* periodic = std::get_if<PeriodicKernel>(&membranes_.surroundings().kernel())) {
    nearest = ring.front() + periodic->nearest(place - ring.front());
  }
  return encloses(ring, nearest);
}

FlowValues MembraneFlow::at(const std::vector<Vector<2>>& places) const {
  const Surroundings& surroundings = membranes_.surroundings();
  const Surroundings::Places here = surroundings.places(places);
  FlowValues flow{surroundings.at(reaction_, here), std::vector<double>(places.size(), 0.0)};
  for (std::size_t i = 0; i < places.size(); ++i) {
    flow.velocities[i] += here.flow[i];
    if (!surroundings.is_bounded()) continue;
    flow.pressures[i] = here.weights.sample(i, reaction_.nodes.pressures) +
                        here.weights.sample(i, surroundings.without_cells().pressures);
  }
  for (const RingSource& source : sources_) {
    add_ring_flow(source, surroundings.kernel(), surroundings.viscosity(), places, flow);
  }
  for (const RingSource& source : sources_) {
    if (source.viscosity_ratio() == 1) continue;
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (is_inside(source, places[i])) flow.velocities[i] /= source.viscosity_ratio();
    }
  }
  return flow;
}

double MembraneFlow::extra_pressure_drop() const {
  return membranes_.surroundings().extra_pressure_drop(reaction_, sources_);
}

}  // namespace hemoscale::micro
