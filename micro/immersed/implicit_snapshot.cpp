#include <fmt/format.h>

#include <array>

#include "micro/immersed/flat_points.hpp"
#include "micro/immersed/implicit_membranes.hpp"
#include "micro/immersed/membrane_snapshot.hpp"

namespace hemoscale::micro {

namespace {

constexpr std::array<const char*, 3> answer_names = {"answer_0", "answer_1", "answer_2"};
constexpr std::array<const char*, 3> forces_names = {"forces_0", "forces_1", "forces_2"};
constexpr std::array<const char*, 3> velocity_names = {"velocity_0", "velocity_1", "velocity_2"};

std::string slot(std::size_t cell, const char* name) {
  return fmt::format("implicit.{}.{}", cell, name);
}

std::vector<double> values_of(const Eigen::VectorXd& v) {
  return {v.data(), v.data() + v.size()};
}

Eigen::VectorXd column_of(const std::vector<double>& v) {
  return Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
}

const std::vector<double>& optional_reals(const Snapshot& snapshot, const std::string& name) {
  static const std::vector<double> none;
  const auto found = snapshot.reals.find(name);
  return found == snapshot.reals.end() ? none : found->second;
}

}  // namespace

Snapshot ImplicitMembranes::snapshot() const {
  Snapshot snapshot;
  store_cells(cells_, snapshot);
  snapshot.reals["implicit.times"] = {time_, last_step_, next_step_, extra_pressure_drop_};
  snapshot.integers["implicit.counters"] = {counters_.steps, counters_.refused, counters_.sweeps,
                                            counters_.factorisations};
  for (std::size_t c = 0; c < rings_.size(); ++c) {
    const Ring& ring = rings_[c];
    snapshot.reals[slot(c, "leak")] = {ring.unknowns.leak};
    snapshot.reals[slot(c, "tensions")] = ring.unknowns.tensions;
    if (ring.before.empty()) continue;
    snapshot.reals[slot(c, "before")] = values_of(flat_of(ring.before));
    snapshot.reals[slot(c, "tensions_before")] = ring.tensions_before;
    const Eigen::MatrixXd& m = ring.map.matrix();
    snapshot.reals[slot(c, "map")] = {m.data(), m.data() + m.size()};
    for (std::size_t k = 0; k < ring.answers.size(); ++k) {
      const Answer& answer = ring.answers[k];
      snapshot.reals[slot(c, answer_names[k])] = {answer.time};
      snapshot.reals[slot(c, forces_names[k])] = values_of(answer.forces);
      snapshot.reals[slot(c, velocity_names[k])] = values_of(answer.velocity);
    }
  }
  return snapshot;
}

void ImplicitMembranes::restore(const Snapshot& snapshot) {
  const std::vector<double>& times = stored_reals(snapshot, "implicit.times", 4);
  const std::vector<std::int64_t>& counters = stored_integers(snapshot, "implicit.counters", 4);
  load_cells(snapshot, cells_);
  time_ = times[0];
  last_step_ = times[1];
  next_step_ = times[2];
  extra_pressure_drop_ = times[3];
  counters_ = {counters[0], counters[1], counters[2], counters[3]};
  for (std::size_t c = 0; c < rings_.size(); ++c) {
    Ring& ring = rings_[c];
    const std::size_t n = cells_[c].positions.size();
    ring.unknowns.positions = cells_[c].positions;
    ring.unknowns.leak = stored_reals(snapshot, slot(c, "leak").c_str(), 1)[0];
    ring.unknowns.tensions = stored_reals(snapshot, slot(c, "tensions").c_str(), n);
    ring.before.clear();
    ring.tensions_before.clear();
    ring.map = SecantMap(static_cast<Eigen::Index>(2 * n));
    ring.answers.clear();
    if (last_step_ == 0) continue;
    ring.before = points_of(column_of(stored_reals(snapshot, slot(c, "before").c_str(), 2 * n)));
    ring.tensions_before = stored_reals(snapshot, slot(c, "tensions_before").c_str(), n);
    const std::vector<double>& map = stored_reals(snapshot, slot(c, "map").c_str(), 4 * n * n);
    const auto size = static_cast<Eigen::Index>(2 * n);
    ring.map.restore(Eigen::Map<const Eigen::MatrixXd>(map.data(), size, size));
    for (std::size_t k = 0; k < answer_names.size(); ++k) {
      const std::vector<double>& time = optional_reals(snapshot, slot(c, answer_names[k]));
      if (time.empty()) break;
      ring.answers.push_back({column_of(optional_reals(snapshot, slot(c, forces_names[k]))),
                              column_of(optional_reals(snapshot, slot(c, velocity_names[k]))),
                              time.front()});
    }
  }
}

}  // namespace hemoscale::micro
