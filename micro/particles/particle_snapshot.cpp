#include "micro/particles/particle_snapshot.hpp"

#include <fmt/format.h>

#include "micro/error.hpp"

namespace hemoscale::micro {

template <int dim>
std::vector<double> flat(const std::vector<Vector<dim>>& vectors) {
  std::vector<double> values;
  values.reserve(vectors.size() * static_cast<std::size_t>(dim));
  for (const Vector<dim>& v : vectors) values.insert(values.end(), v.data(), v.data() + dim);
  return values;
}

template <int dim>
std::vector<Vector<dim>> vectors_of(const std::vector<double>& values) {
  std::vector<Vector<dim>> vectors(values.size() / static_cast<std::size_t>(dim));
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    vectors[i] = Eigen::Map<const Vector<dim>>(values.data() + i * static_cast<std::size_t>(dim));
  }
  return vectors;
}

namespace {

template <typename Value>
const std::vector<Value>& find(const std::map<std::string, std::vector<Value>>& arrays,
                               const std::string& name) {
  const auto found = arrays.find(name);
  if (found == arrays.end()) {
    throw ParameterError(fmt::format(
        "snapshot: '{}' is missing; restore it into the kind of model that wrote it", name));
  }
  return found->second;
}

void require_length(const std::string& name, std::size_t length, std::size_t wanted) {
  if (length == wanted) return;
  throw ParameterError(
      fmt::format("snapshot: '{}' holds {} values where {} are needed", name, length, wanted));
}

}  // namespace

template <int dim>
void store_particles(const ParticleSet<dim>& particles, const std::string& prefix,
                     Snapshot& snapshot) {
  snapshot.reals[prefix + "positions"] = flat<dim>(particles.positions);
  snapshot.reals[prefix + "velocities"] = flat<dim>(particles.velocities);
  snapshot.reals[prefix + "pressures"] = particles.pressures;
  snapshot.reals[prefix + "normals"] = flat<dim>(particles.normals);
  snapshot.reals[prefix + "measures"] = particles.measures;
  std::vector<std::int64_t> kinds;
  for (const ParticleKind kind : particles.kinds) kinds.push_back(static_cast<std::int64_t>(kind));
  snapshot.integers[prefix + "kinds"] = std::move(kinds);
  snapshot.integers[prefix + "patches"] = {particles.patches.begin(), particles.patches.end()};
  snapshot.integers[prefix + "identities"] = particles.identities;
}

template <int dim>
ParticleSet<dim> load_particles(const Snapshot& snapshot, const std::string& prefix) {
  ParticleSet<dim> particles;
  const auto components = static_cast<std::size_t>(dim);
  particles.identities = find(snapshot.integers, prefix + "identities");
  const std::size_t count = particles.identities.size();
  const auto vectors = [&](const char* name) {
    const std::vector<double>& values = find(snapshot.reals, prefix + name);
    require_length(prefix + name, values.size(), count * components);
    return vectors_of<dim>(values);
  };
  const auto reals = [&](const char* name) {
    const std::vector<double>& values = find(snapshot.reals, prefix + name);
    require_length(prefix + name, values.size(), count);
    return values;
  };
  const auto integers = [&](const char* name) {
    const std::vector<std::int64_t>& values = find(snapshot.integers, prefix + name);
    require_length(prefix + name, values.size(), count);
    return values;
  };
  particles.positions = vectors("positions");
  particles.velocities = vectors("velocities");
  particles.normals = vectors("normals");
  particles.pressures = reals("pressures");
  particles.measures = reals("measures");
  for (const std::int64_t kind : integers("kinds")) {
    particles.kinds.push_back(static_cast<ParticleKind>(kind));
  }
  for (const std::int64_t patch : integers("patches")) {
    particles.patches.push_back(static_cast<std::int32_t>(patch));
  }
  return particles;
}

template std::vector<double> flat<2>(const std::vector<Vector<2>>&);
template std::vector<double> flat<3>(const std::vector<Vector<3>>&);
template std::vector<Vector<2>> vectors_of<2>(const std::vector<double>&);
template std::vector<Vector<3>> vectors_of<3>(const std::vector<double>&);
template void store_particles<2>(const ParticleSet<2>&, const std::string&, Snapshot&);
template void store_particles<3>(const ParticleSet<3>&, const std::string&, Snapshot&);
template ParticleSet<2> load_particles<2>(const Snapshot&, const std::string&);
template ParticleSet<3> load_particles<3>(const Snapshot&, const std::string&);

}  // namespace hemoscale::micro
