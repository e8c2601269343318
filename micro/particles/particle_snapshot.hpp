#pragma once

#include <string>
#include <vector>

#include "micro/model.hpp"
#include "micro/particles/particle_set.hpp"

namespace hemoscale::micro {

/// Components of vectors, one vector after another, and back.
template <int dim>
std::vector<double> flat(const std::vector<Vector<dim>>& vectors);
template <int dim>
std::vector<Vector<dim>> vectors_of(const std::vector<double>& values);

/// Adds every array of the set to a snapshot, under names that begin with `prefix`.
template <int dim>
void store_particles(const ParticleSet<dim>& particles, const std::string& prefix,
                     Snapshot& snapshot);

/// @throws ParameterError naming the array if one is missing or has the wrong length
template <int dim>
ParticleSet<dim> load_particles(const Snapshot& snapshot, const std::string& prefix);

}  // namespace hemoscale::micro
