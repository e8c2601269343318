#include "micro/ensemble/observables/moment_balance.hpp"

#include <cstddef>
#include <vector>

namespace hemoscale::micro {
namespace {

/// Places of the nodes, and of their cells, relative to the axis [m].
struct Places {
  std::size_t nodes = 0;  // per cell
  std::vector<double> node, cell;
};

/// 2 <place velocity> over nodes and over cells.
struct Rates {
  double nodes = 0, cells = 0;
};

Rates rates_of(const Places& places, std::span<const double> velocity) {
  Rates rates;
  for (std::size_t i = 0; i < velocity.size(); ++i) {
    rates.nodes += 2 * places.node[i] * velocity[i];
    rates.cells += 2 * places.cell[i / places.nodes] * velocity[i];
  }
  const auto count = static_cast<double>(places.node.size());
  return {rates.nodes / count, rates.cells / count};
}

}  // namespace

MomentBalance moment_balance(const EnsembleState& state, std::span<const double> flow_y,
                             const PairParts& pairs, const NodeForces& forces, double height,
                             double node_drag) {
  MomentBalance balance;
  Places places{state.nodes, {}, std::vector<double>(state.cells, 0.0)};
  places.node.reserve(state.y.size());
  for (std::size_t i = 0; i < state.y.size(); ++i) {
    const double y = state.y[i] - 0.5 * height;
    places.node.push_back(y);
    places.cell[i / state.nodes] += y / static_cast<double>(state.nodes);
    balance.node_moment += y * y / static_cast<double>(state.y.size());
  }
  for (const double y : places.cell) {
    balance.cell_moment += y * y / static_cast<double>(state.cells);
  }
  const auto put = [&](double MomentRate::*part, std::span<const double> values, double drag) {
    const Rates rates = rates_of(places, values);
    balance.nodes.*part = rates.nodes / drag;
    balance.cells.*part = rates.cells / drag;
  };
  put(&MomentRate::flow, flow_y, 1);
  put(&MomentRate::membrane, forces.membrane.y, node_drag);
  put(&MomentRate::attraction, pairs.attraction.y, node_drag);
  put(&MomentRate::repulsion, pairs.repulsion.y, node_drag);
  put(&MomentRate::other_kinds, forces.other_kinds.y, node_drag);
  put(&MomentRate::wall, forces.wall.y, node_drag);
  put(&MomentRate::lift, forces.lift.y, node_drag);
  return balance;
}

}  // namespace hemoscale::micro
