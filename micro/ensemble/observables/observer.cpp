#include "micro/ensemble/observables/observer.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "micro/ensemble/observables/stress_profile.hpp"
#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

/// The given flow at all nodes.
struct NodeFlow {
  std::vector<double> x, y;  // [m/s]
};

NodeFlow flow_at_nodes(const EnsembleState& state, const GivenFlow& flow) {
  NodeFlow given;
  given.x.reserve(state.x.size());
  given.y.reserve(state.x.size());
  for (std::size_t i = 0; i < state.x.size(); ++i) {
    const Vector<2> u = flow.at({state.x[i], state.y[i]}, state.time).velocity;
    given.x.push_back(u.x());
    given.y.push_back(u.y());
  }
  return given;
}

void add_to(std::vector<double>& sum, std::span<const double> values) {
  for (std::size_t i = 0; i < values.size(); ++i) sum[i] += values[i];
}

/// Membrane and contact forces: those that carry stress.
ForceArrays inner_forces(const NodeForces& forces, const PairParts& pairs) {
  ForceArrays sum = pairs.repulsion;
  for (const ForceView& part : {pairs.attraction.view(), forces.membrane, forces.other_kinds}) {
    add_to(sum.x, part.x);
    add_to(sum.y, part.y);
  }
  return sum;
}

/// Nodes move with the flow and their forces over the drag.
void add_drift(NodeFlow& velocity, const NodeForces& forces, const PairParts& pairs, double drag) {
  ForceArrays total = inner_forces(forces, pairs);
  for (const ForceView& part : {forces.wall, forces.lift}) {
    add_to(total.x, part.x);
    add_to(total.y, part.y);
  }
  for (std::size_t i = 0; i < total.x.size(); ++i) {
    velocity.x[i] += total.x[i] / drag;
    velocity.y[i] += total.y[i] / drag;
  }
}

void require_admissible(const ObservedKind& kind, const ObserverOptions& options) {
  if (options.bins < 2 || options.distance_bins < 1 || !(options.column_width > 0)) {
    throw ParameterError(
        fmt::format("observables: {} bins, {} distance bins, columns of {:.4g} m; at least 2 and 1 "
                    "bins and columns of positive width are needed; correct these numbers",
                    options.bins, options.distance_bins, options.column_width));
  }
  if (!(kind.rest_area > 0) || !(kind.rest_perimeter > 0) || !(kind.node_drag > 0)) {
    throw ParameterError(fmt::format(
        "observables: {} have the area {:.4g} m^2, perimeter {:.4g} m and node drag {:.4g} Pa s at "
        "rest; all must be positive; take them from the mesh and the drag of the kind",
        kind.name, kind.rest_area, kind.rest_perimeter, kind.node_drag));
  }
}

}  // namespace

EnsembleObserver::EnsembleObserver(ObservedKind kind, ObserverOptions options)
    : kind_(std::move(kind)),
      options_(std::move(options)),
      passages_(options_.sections, options_.period),
      average_(options_.bins) {
  require_admissible(kind_, options_);
}

const EnsembleSample& EnsembleObserver::sample(const EnsembleState& state, const Box& box,
                                               const GivenFlow& flow, const ObservedNodes& nodes) {
  last_ = EnsembleSample{};
  last_.time = state.time;
  last_.cells = state.cells;
  records_.clear();
  const std::vector<CellShape> shapes = measure_cells(state);
  std::vector<std::int64_t> identities(nodes.identities.begin(), nodes.identities.end());
  if (identities.empty()) {
    identities.resize(state.cells);
    std::iota(identities.begin(), identities.end(), 0);
  }
  passages_.update(identities, shapes);
  last_.passages = passages_.passages();
  const bool is_lateral = box.walls && options_.is_straight;
  if (state.cells == 0) {
    if (is_lateral) average({}, state, box, flow);
    return last_;
  }

  list_.build(state, box, std::max(kind_.law.cutoff, longest_segment(state)));
  const PairParts pairs = pair_parts(state, box, list_, kind_.law);
  const NodeFlow given = flow_at_nodes(state, flow);
  std::vector<CellMotion> motions;
  if (nodes.velocity_x.empty()) {
    NodeFlow velocity = given;
    add_drift(velocity, nodes.forces, pairs, kind_.node_drag);
    motions = cell_motions(state, shapes, velocity.x, velocity.y);
  } else {
    motions = cell_motions(state, shapes, nodes.velocity_x, nodes.velocity_y);
  }
  record_cells(state, nodes, shapes, motions);
  const double axis = is_lateral ? 0.5 * box.height : std::numeric_limits<double>::infinity();
  last_.orientation = orientation(shapes, axis);
  last_.contacts = count_contacts(state, box, list_, kind_.law);
  last_.area_fraction = 0;
  for (const CellShape& shape : shapes) last_.area_fraction += shape.area / box.area();
  if (is_lateral) {
    last_.lateral = sample_lateral(state, box, flow, nodes.forces, pairs, given.y, shapes, motions);
  }
  return last_;
}

void EnsembleObserver::record_cells(const EnsembleState& state, const ObservedNodes& nodes,
                                    std::span<const CellShape> shapes,
                                    std::span<const CellMotion> motions) {
  std::vector<Tensor<2>> stresslets(state.cells, Tensor<2>::Zero());
  if (!nodes.forces.membrane.x.empty()) {
    stresslets = membrane_stresslets(state, shapes, nodes.forces.membrane);
  }
  const auto count = static_cast<double>(state.cells);
  for (std::size_t cell = 0; cell < state.cells; ++cell) {
    const CellRecord record{.shape = shapes[cell],
                            .motion = motions[cell],
                            .stresslet = stresslets[cell],
                            .area_strain = shapes[cell].area / kind_.rest_area - 1,
                            .perimeter_strain = shapes[cell].perimeter / kind_.rest_perimeter - 1};
    records_.push_back(record);
    const double area_strain = std::abs(record.area_strain);
    const double perimeter_strain = std::abs(record.perimeter_strain);
    last_.speed += record.motion.velocity.norm() / count;
    last_.deformation += record.shape.deformation / count;
    last_.mean_area_strain += area_strain / count;
    last_.mean_perimeter_strain += perimeter_strain / count;
    last_.largest_area_strain = std::max(last_.largest_area_strain, area_strain);
    last_.largest_perimeter_strain = std::max(last_.largest_perimeter_strain, perimeter_strain);
  }
}

LateralSample EnsembleObserver::sample_lateral(const EnsembleState& state, const Box& box,
                                               const GivenFlow& flow, const NodeForces& forces,
                                               const PairParts& pairs,
                                               std::span<const double> flow_y,
                                               std::span<const CellShape> shapes,
                                               std::span<const CellMotion> motions) {
  const LateralBins bins{.height = box.height, .count = options_.bins};
  LateralContribution contribution;
  contribution.sums = lateral_sums(state, shapes, motions, bins);
  const ForceArrays inner = inner_forces(forces, pairs);
  contribution.shear_stress = plane_stress(state, inner.x, box.length, bins);
  contribution.normal_stress = plane_stress(state, inner.y, box.length, bins);
  LateralSample lateral;
  for (std::size_t b = 0; b < bins.count; ++b) {
    const double y = bins.middle(b);
    lateral.area_fractions.push_back(contribution.sums.area[b] / (box.length * bins.width()));
    // A bin on the axis has as much of either half.
    const double off = 2 * y / box.height - 1;
    const double side = std::abs(off) < 1e-9 ? 0 : (off < 0 ? 1 : -1);
    const auto count = static_cast<double>(bins.count);
    lateral.shear_stress += side * contribution.shear_stress[b] / count;
    lateral.normal_stress += contribution.normal_stress[b] / count;
  }
  lateral.moments = lateral_moments(state, shapes, box.height);
  lateral.distance_shares = distance_histogram(state, shapes, box.height, options_.distance_bins);
  lateral.balance = moment_balance(state, flow_y, pairs, forces, box.height, kind_.node_drag);
  lateral.envelope = envelope_layer(state, box, options_.column_width);
  lateral.half_core_distance = half_core_distance(lateral.area_fractions, box.height);
  lateral.hematocrits =
      hematocrits(shapes, motions, box, flow_rate(flow, 0, box.height, state.time));
  average(std::move(contribution), state, box, flow);
  return lateral;
}

void EnsembleObserver::average(LateralContribution contribution, const EnsembleState& state,
                               const Box& box, const GivenFlow& flow) {
  if (state.time < options_.average_from) return;
  const LateralBins bins{.height = box.height, .count = options_.bins};
  for (std::size_t b = 0; b < bins.count; ++b) {
    contribution.flow_velocity.push_back(flow.at({0, bins.middle(b)}, state.time).velocity.x());
  }
  average_.add(contribution, box.length, box.height);
}

Snapshot EnsembleObserver::snapshot() const {
  Snapshot snapshot;
  average_.store(snapshot);
  passages_.store(snapshot);
  return snapshot;
}

void EnsembleObserver::restore(const Snapshot& snapshot) {
  // Both or none: a snapshot that is not admissible changes nothing.
  LateralAverage average = average_;
  PassageCounter passages = passages_;
  average.load(snapshot);
  passages.load(snapshot);
  average_ = std::move(average);
  passages_ = std::move(passages);
}

}  // namespace hemoscale::micro
