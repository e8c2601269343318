#include "micro/ensemble/observables/step_forces.hpp"

#include <cmath>
#include <cstddef>

namespace hemoscale::micro {

StepForces step_forces(const EnsembleState& before, const EnsembleState& after, double time_step,
                       const Box& box, const GivenFlow& flow, double node_drag, const PairLaw& law,
                       const WallPotential& wall) {
  NeighbourList list;
  list.build(after, box, law.cutoff);
  const PairParts pairs = pair_parts(after, box, list, law);
  const std::size_t n = after.x.size();
  StepForces result;
  result.velocity_x.resize(n);
  result.velocity_y.resize(n);
  result.membrane.x.resize(n);
  result.membrane.y.resize(n);
  result.wall.x.assign(n, 0);
  result.wall.y.assign(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    const Vector<2> velocity((after.x[i] - before.x[i]) / time_step,
                             (after.y[i] - before.y[i]) / time_step);
    const Vector<2> given = flow.at({after.x[i], after.y[i]}, after.time).velocity;
    if (box.walls) {
      result.wall.y[i] = wall.force(after.y[i]) - wall.force(box.height - after.y[i]);
    }
    const Vector<2> total = node_drag * (velocity - given);
    result.velocity_x[i] = velocity.x();
    result.velocity_y[i] = velocity.y();
    result.membrane.x[i] = total.x() - pairs.repulsion.x[i] - pairs.attraction.x[i];
    result.membrane.y[i] =
        total.y() - pairs.repulsion.y[i] - pairs.attraction.y[i] - result.wall.y[i];
  }
  return result;
}

void bring_home(const Box& box, EnsembleState& state, EnsembleState* companion) {
  for (std::size_t cell = 0; cell < state.cells; ++cell) {
    double sum = 0;
    for (std::size_t i = cell * state.nodes; i < (cell + 1) * state.nodes; ++i) sum += state.x[i];
    const double shift =
        std::floor(sum / static_cast<double>(state.nodes) / box.length) * box.length;
    if (shift == 0) continue;
    for (std::size_t i = cell * state.nodes; i < (cell + 1) * state.nodes; ++i) {
      state.x[i] -= shift;
      if (companion != nullptr) companion->x[i] -= shift;
    }
  }
}

}  // namespace hemoscale::micro
