#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "coupling/report/series.hpp"
#include "coupling/report/summary.hpp"
#include "coupling/scene/plasma_scene.hpp"

namespace hemoscale::coupling {

/// Columns of series.csv of a plasma scene, and the row of one moment; the same order.
template <int dim>
std::vector<Column> plasma_columns(const PlasmaScene<dim>& scene);
template <int dim>
std::vector<double> plasma_row(const PlasmaScene<dim>& scene, micro::PlasmaModel<dim>& model);

/// The figures of the end of a run: those of the last row, and what the flow is known by.
/// @param first_energy  kinetic energy at the beginning
template <int dim>
std::vector<Figure> plasma_figures(const Settings& settings, const PlasmaScene<dim>& scene,
                                   micro::PlasmaModel<dim>& model, double first_energy);

/// Every particle: place, velocity, pressure, kind, patch.
template <int dim>
void write_particles(const std::filesystem::path& path, const micro::ParticleSet<dim>& particles);

/// What the results are and are not.
std::vector<std::string> plasma_statements(const Settings& settings);

}  // namespace hemoscale::coupling
