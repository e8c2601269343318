#include "micro/ensemble/observables/step_forces.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>

namespace hemoscale::micro {
namespace {

/// zeta times the force per drag of a node that slips past the fluid with w.
Vector<2> dragged(const EnsembleState& state, std::size_t node, const Vector<2>& w,
                  double node_drag, const StepDrag& more) {
  Vector<2> force = node_drag * w + more.momentum * w.norm() * w;
  if (more.normal_ratio != 1) {
    const std::size_t first = node - node % state.nodes;
    const std::size_t before = first + (node - first + state.nodes - 1) % state.nodes;
    const std::size_t after = first + (node - first + 1) % state.nodes;
    const Vector<2> normal =
        Vector<2>(state.y[after] - state.y[before], state.x[before] - state.x[after]).normalized();
    force += node_drag * (more.normal_ratio - 1) * w.dot(normal) * normal;
  }
  return force;
}

}  // namespace

StepForces step_forces(const EnsembleState& before, const EnsembleState& after, double time_step,
                       const Box& box, const GivenFlow& flow, double node_drag, const PairLaw& law,
                       const WallPotential& wall, const StepDrag& more) {
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
  if (!more.drift_y.empty()) {
    result.lift.x.assign(n, 0);
    result.lift.y.resize(n);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const Vector<2> velocity((after.x[i] - before.x[i]) / time_step,
                             (after.y[i] - before.y[i]) / time_step);
    const Vector<2> given = flow.at({after.x[i], after.y[i]}, after.time).velocity;
    if (box.walls) {
      result.wall.y[i] = wall.force(after.y[i]) - wall.force(box.height - after.y[i]);
    }
    Vector<2> slip = velocity - given;
    if (!more.drift_y.empty()) {
      slip.y() -= more.drift_y[i];
      result.lift.y[i] = node_drag * more.drift_y[i];
    }
    const Vector<2> total = dragged(before, i, slip, node_drag, more);
    result.velocity_x[i] = velocity.x();
    result.velocity_y[i] = velocity.y();
    result.membrane.x[i] = total.x() - pairs.repulsion.x[i] - pairs.attraction.x[i];
    result.membrane.y[i] =
        total.y() - pairs.repulsion.y[i] - pairs.attraction.y[i] - result.wall.y[i];
  }
  return result;
}

std::vector<double> drift_velocities(const EnsembleState& before, const LateralMigration& migration,
                                     const Box& box, const GivenFlow& flow, double time_step) {
  std::vector<double> velocities;
  velocities.reserve(before.x.size());
  for (std::size_t cell = 0; cell < before.cells; ++cell) {
    Vector<2> centre = Vector<2>::Zero();
    for (std::size_t i = cell * before.nodes; i < (cell + 1) * before.nodes; ++i) {
      centre += Vector<2>(before.x[i], before.y[i]) / static_cast<double>(before.nodes);
    }
    const double displacement =
        migration.displacement(centre.y(), box.height, flow.at(centre, before.time), cell,
                               static_cast<std::uint64_t>(before.step), time_step);
    velocities.insert(velocities.end(), before.nodes, displacement / time_step);
  }
  return velocities;
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
