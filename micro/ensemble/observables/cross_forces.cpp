#include "micro/ensemble/observables/cross_forces.hpp"

#include <cstddef>

#include "micro/ensemble/neighbour_list.hpp"

namespace hemoscale::micro {
namespace {

/// All nodes of all kinds, each a cell of its own, so that a list of them joins any two kinds.
struct JoinedNodes {
  EnsembleState state;
  std::vector<std::size_t> kinds;  // by node
  std::vector<std::size_t> first;  // node of each kind
};

JoinedNodes join(std::span<const EnsembleState> kinds) {
  JoinedNodes joined;
  joined.state.nodes = 1;
  joined.state.image_offset = kinds.front().image_offset;
  joined.state.time = kinds.front().time;
  joined.state.step = kinds.front().step;
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    joined.first.push_back(joined.state.x.size());
    joined.state.x.insert(joined.state.x.end(), kinds[k].x.begin(), kinds[k].x.end());
    joined.state.y.insert(joined.state.y.end(), kinds[k].y.begin(), kinds[k].y.end());
    joined.kinds.insert(joined.kinds.end(), kinds[k].x.size(), k);
  }
  joined.state.cells = joined.state.x.size();
  return joined;
}

void move_part(std::vector<double>& from, const std::vector<double>& part) {
  for (std::size_t i = 0; i < part.size(); ++i) from[i] -= part[i];
}

}  // namespace

std::vector<ForceArrays> cross_forces(std::span<const EnsembleState> kinds, const Box& box,
                                      const PairLaw& law) {
  std::vector<ForceArrays> forces(kinds.size());
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    forces[k].x.assign(kinds[k].x.size(), 0);
    forces[k].y.assign(kinds[k].x.size(), 0);
  }
  if (kinds.size() < 2) return forces;
  const JoinedNodes joined = join(kinds);
  if (joined.state.cells == 0 || !(law.cutoff > 0)) return forces;
  NeighbourList list;
  list.build(joined.state, box, law.cutoff);
  const ImageTable images(box, joined.state.image_offset);
  const double cutoff_squared = law.cutoff * law.cutoff;
  for (std::size_t i = 0; i < joined.state.cells; ++i) {
    const std::size_t kind = joined.kinds[i];
    const std::size_t own = i - joined.first[kind];
    for (const Neighbour& other : list.of(i)) {
      const auto image = static_cast<std::size_t>(other.image);
      const auto j = static_cast<std::size_t>(other.node);
      if (joined.kinds[j] == kind) continue;
      const double dx = joined.state.x[i] - (joined.state.x[j] + images.x[image]);
      const double dy = joined.state.y[i] - (joined.state.y[j] + images.y[image]);
      const double s = dx * dx + dy * dy;
      if (s >= cutoff_squared) continue;
      const double f = law.force_over_distance(s);
      forces[kind].x[own] += f * dx;
      forces[kind].y[own] += f * dy;
    }
  }
  return forces;
}

void separate_other_kinds(std::span<StepForces> steps, std::span<const EnsembleState> kinds,
                          const Box& box, const PairLaw& law) {
  std::vector<ForceArrays> forces = cross_forces(kinds, box, law);
  for (std::size_t k = 0; k < steps.size(); ++k) {
    move_part(steps[k].membrane.x, forces[k].x);
    move_part(steps[k].membrane.y, forces[k].y);
    steps[k].other_kinds = std::move(forces[k]);
  }
}

}  // namespace hemoscale::micro
