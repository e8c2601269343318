#include "micro/mps/semi_implicit_snapshot.hpp"

#include <fmt/format.h>

#include <string>

#include "micro/error.hpp"
#include "micro/particles/particle_snapshot.hpp"

namespace hemoscale::micro {

namespace {

const std::string prefix = "semi_implicit.";

template <typename Value>
const std::vector<Value>& find(const std::map<std::string, std::vector<Value>>& arrays,
                               const char* name, std::size_t size) {
  const auto found = arrays.find(prefix + name);
  if (found == arrays.end() || found->second.size() != size) {
    throw ParameterError(fmt::format(
        "snapshot: {} numbers '{}{}' where {} are needed; restore it into the kind of model that "
        "wrote it",
        found == arrays.end() ? std::size_t{0} : found->second.size(), prefix, name, size));
  }
  return found->second;
}

}  // namespace

template <int dim>
Snapshot to_snapshot(const SemiImplicitState<dim>& state) {
  const ParticleSet<dim>& particles = state.particles;
  const auto count = static_cast<std::int64_t>(particles.size());
  const auto searched = static_cast<std::int64_t>(state.table_positions.size());
  const ParticleLedger& ledger = state.ledger;
  Snapshot snapshot;
  store_particles(particles, prefix, snapshot);
  snapshot.reals[prefix + "depths"] = state.depths;
  snapshot.reals[prefix + "table_positions"] = flat<dim>(state.table_positions);
  snapshot.reals[prefix + "time"] = {state.time};
  snapshot.integers[prefix + "counters"] = {dim,
                                            count,
                                            searched,
                                            state.step,
                                            state.searches,
                                            ledger.next_identity,
                                            ledger.initial,
                                            ledger.entered,
                                            ledger.left};
  return snapshot;
}

template <int dim>
SemiImplicitState<dim> from_snapshot(const Snapshot& snapshot) {
  const std::vector<std::int64_t>& counters = find(snapshot.integers, "counters", 9);
  if (counters[0] != dim || counters[1] < 0 || counters[2] < 0) {
    throw ParameterError(
        fmt::format("snapshot: {} particles in {} dimensions; a model of {} dimensions cannot take "
                    "them; restore "
                    "it into the kind of model that wrote it",
                    counters[1], counters[0], dim));
  }
  const auto count = static_cast<std::size_t>(counters[1]);
  const auto width = static_cast<std::size_t>(dim);
  const auto reals = [&](const char* name, std::size_t size) {
    return find(snapshot.reals, name, size);
  };
  SemiImplicitState<dim> state;
  state.particles = load_particles<dim>(snapshot, prefix);
  if (state.particles.size() != count) {
    throw ParameterError(
        fmt::format("snapshot: {} particles where {} are counted", state.particles.size(), count));
  }
  state.depths = reals("depths", count);
  state.table_positions =
      vectors_of<dim>(reals("table_positions", static_cast<std::size_t>(counters[2]) * width));
  state.time = reals("time", 1).front();
  state.step = counters[3];
  state.searches = counters[4];
  state.ledger = {.next_identity = counters[5],
                  .initial = counters[6],
                  .entered = counters[7],
                  .left = counters[8]};
  return state;
}

template Snapshot to_snapshot<2>(const SemiImplicitState<2>&);
template Snapshot to_snapshot<3>(const SemiImplicitState<3>&);
template SemiImplicitState<2> from_snapshot<2>(const Snapshot&);
template SemiImplicitState<3> from_snapshot<3>(const Snapshot&);

}  // namespace hemoscale::micro
