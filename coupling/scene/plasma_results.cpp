#include "coupling/scene/plasma_results.hpp"

#include <fmt/format.h>

#include <cmath>

#include "coupling/scene/plasma_error.hpp"

namespace hemoscale::coupling {

namespace {

const std::string prefix = "micro.plasma.";

template <int dim>
bool has_boundary_nodes(const PlasmaScene<dim>& scene) {
  return std::holds_alternative<micro::StageOptions>(scene.method);
}

/// Pressure in the middle of a patch of fluid around the origin.
double central_pressure(const micro::PlasmaModel<2>& model) {
  const micro::ParticleSet<2>& particles = model.particles();
  double weights = 0;
  double sum = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double r = particles.positions[i].norm() / (1.5 * model.spacing());
    if (r >= 1 || particles.kinds[i] != micro::ParticleKind::fluid) continue;
    weights += 1 - r;
    sum += (1 - r) * particles.pressures[i];
  }
  return weights > 0 ? sum / weights : 0;
}

}  // namespace

template <int dim>
std::vector<Column> plasma_columns(const PlasmaScene<dim>& scene) {
  std::vector<Column> columns = {{"time", "s"},
                                 {"steps", "-"},
                                 {"particles", "-"},
                                 {"kinetic energy", dim == 2 ? "J/m" : "J"},
                                 {"largest speed", "m/s"}};
  if (scene.sections) {
    columns.push_back({"flow rate upstream", "m^2/s"});
    columns.push_back({"flow rate downstream", "m^2/s"});
    columns.push_back({"pressure drop", "Pa"});
    columns.push_back({"wall shear stress", "Pa"});
  }
  if (scene.exact) {
    columns.push_back({"relative L2 error of velocity", "-"});
    columns.push_back({"relative largest error of velocity", "-"});
    if (scene.compares_pressure) columns.push_back({"relative L2 error of pressure", "-"});
  }
  return columns;
}

template <int dim>
std::vector<double> plasma_row(const PlasmaScene<dim>& scene, micro::PlasmaModel<dim>& model) {
  const micro::PlasmaObservation seen = model.observe();
  std::vector<double> row = {seen.time, static_cast<double>(seen.steps),
                             static_cast<double>(seen.particles), seen.kinetic_energy,
                             seen.largest_speed};
  if (scene.sections) {
    row.insert(row.end(), {seen.flow_rate_upstream, seen.flow_rate_downstream, seen.pressure_drop,
                           seen.wall_shear_stress});
  }
  if (scene.exact) {
    const PlasmaError error =
        plasma_error(scene, model.particles(), model.time(), has_boundary_nodes(scene));
    row.insert(row.end(), {error.velocity, error.largest_velocity});
    if (scene.compares_pressure) row.push_back(error.pressure);
  }
  return row;
}

template <int dim>
std::vector<Figure> plasma_figures(const Settings& settings, const PlasmaScene<dim>& scene,
                                   micro::PlasmaModel<dim>& model, double first_energy) {
  std::vector<Figure> figures;
  const std::vector<Column> columns = plasma_columns(scene);
  const std::vector<double> row = plasma_row(scene, model);
  for (std::size_t k = 0; k < columns.size(); ++k) {
    figures.push_back({columns[k].name, row[k], columns[k].unit});
  }
  const std::string& flow = settings.text(prefix + "flow");
  const double viscosity = scene.fluid.viscosity();
  if (viscosity > 0) {
    figures.push_back(
        {"Reynolds number", scene.fluid.density * scene.mean_speed * scene.size / viscosity, "-"});
  }
  if (scene.sections && row[5] != 0) {
    figures.push_back({"relative loss of flow rate", std::abs(row[6] / row[5] - 1), "-"});
  }
  if constexpr (dim == 2) {
    if (flow == "cylinder") {
      // Per depth, over viscosity and the largest speed of the oncoming parabola.
      const double speed = 1.5 * settings.quantity(prefix + "speed");
      figures.push_back({"drag coefficient", model.force_on(4)[0] / (viscosity * speed), "-"});
    }
    if (flow == "rotating-patch") {
      const double scale =
          scene.fluid.density *
          std::pow(settings.quantity(prefix + "rate") * settings.quantity(prefix + "length"), 2);
      figures.push_back({"central pressure coefficient", central_pressure(model) / scale, "-"});
      figures.push_back(
          {"kinetic energy over its start", model.observe().kinetic_energy / first_energy, "-"});
    }
  }
  const std::vector<micro::Limit> limits = plasma_limits(scene);
  const double longest = longest_step(limits, scene.time_step);
  if (std::isfinite(longest)) figures.push_back({"limit of the time step", longest, "s"});
  for (const micro::Limit& limit : limits) {
    if (limit.unit == "s") figures.push_back({limit.name, limit.limit, "s"});
    figures.push_back({limit.name + ", share used", limit.value / limit.limit, "-"});
  }
  figures.push_back({"time step", scene.time_step, "s"});
  return figures;
}

template <int dim>
void write_particles(const std::filesystem::path& path, const micro::ParticleSet<dim>& particles) {
  std::vector<Column> columns = {{"x", "m"}, {"y", "m"}};
  if (dim == 3) columns.push_back({"z", "m"});
  columns.insert(columns.end(), {{"u", "m/s"}, {"v", "m/s"}});
  if (dim == 3) columns.push_back({"w", "m/s"});
  columns.insert(columns.end(), {{"pressure", "Pa"}, {"kind", "-"}, {"patch", "-"}});
  std::vector<std::vector<double>> rows;
  rows.reserve(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) {
    std::vector<double> row(particles.positions[i].data(), particles.positions[i].data() + dim);
    row.insert(row.end(), particles.velocities[i].data(), particles.velocities[i].data() + dim);
    row.insert(row.end(), {particles.pressures[i], static_cast<double>(particles.kinds[i]),
                           static_cast<double>(particles.patches[i])});
    rows.push_back(std::move(row));
  }
  write_table(path, columns, rows);
}

std::vector<std::string> plasma_statements(const Settings& settings) {
  std::vector<std::string> statements = {"plasma alone: no cells"};
  if (settings.text(prefix + "flow") != "pipe" &&
      settings.text(prefix + "flow") != "taylor-green-3d") {
    statements.push_back("two-dimensional: flow rates, forces and energies are per unit depth");
  }
  return statements;
}

#define HEMOSCALE_INSTANTIATE(dim)                                                                 \
  template std::vector<Column> plasma_columns<dim>(const PlasmaScene<dim>&);                       \
  template std::vector<double> plasma_row<dim>(const PlasmaScene<dim>&, micro::PlasmaModel<dim>&); \
  template std::vector<Figure> plasma_figures<dim>(const Settings&, const PlasmaScene<dim>&,       \
                                                   micro::PlasmaModel<dim>&, double);              \
  template void write_particles<dim>(const std::filesystem::path&, const micro::ParticleSet<dim>&);
HEMOSCALE_INSTANTIATE(2)
HEMOSCALE_INSTANTIATE(3)
#undef HEMOSCALE_INSTANTIATE

}  // namespace hemoscale::coupling
