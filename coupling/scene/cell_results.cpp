#include "coupling/scene/cell_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "micro/cells/angle_period.hpp"
#include "micro/cells/curve_distance.hpp"
#include "micro/cells/ring_concavity.hpp"
#include "micro/cells/ring_motion.hpp"
#include "micro/cells/ring_shape.hpp"
#include "micro/cells/ring_strain.hpp"
#include "micro/cells/steady_state.hpp"
#include "micro/immersed/cell_stress.hpp"

namespace hemoscale::coupling {

namespace {

using Points = std::vector<micro::Vector<2>>;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::string name_of(std::size_t cell, const std::string& quantity) {
  return fmt::format("cell {}: {}", cell, quantity);
}

Points shifted(Points points, const micro::Vector<2>& by) {
  for (micro::Vector<2>& x : points) x += by;
  return points;
}

/// What the columns of a cell hold, in their order.
struct CellSight {
  micro::RingShape shape;
  micro::RingMotion motion;
  micro::RingStrain strain;
  double dimple = 0;          // [m]
  double gap = 0;             // [m]
  double energy = 0;          // [N]
  double bending_energy = 0;  // [N]
  double tension = 0;         // [N/m] largest
  double smallest_tension = 0;
};

CellSight sight_of(const CellScene& scene, const micro::CellsInPlasma& model, std::size_t c) {
  const micro::Cell& cell = model.cells()[c];
  const micro::RingCurve curve(cell.positions);
  CellSight sight;
  sight.shape = micro::measure_shape(curve);
  sight.motion = micro::measure_motion(curve, micro::RingCurve(cell.velocities));
  sight.strain = micro::measure_strain(cell.positions, cell.membrane->mesh());
  sight.dimple = micro::dimple_depth(micro::concavities(curve), {-1, 0});
  sight.gap = smallest_gap(scene, model, c);
  const micro::MembraneEnergy energy = cell.membrane->energy(cell.positions);
  sight.energy = energy.total();
  sight.bending_energy = energy.bending;
  const std::vector<double> tensions = model.tensions(c);
  const auto [least, most] = std::minmax_element(tensions.begin(), tensions.end());
  sight.tension = *most;
  sight.smallest_tension = *least;
  return sight;
}

struct Quantity {
  const char* name;
  const char* unit;
  double (*value)(const CellSight&);
};

const std::vector<Quantity>& quantities() {
  static const std::vector<Quantity> list = {
      {"velocity along the flow", "m/s", [](const CellSight& s) { return s.motion.velocity.x(); }},
      {"velocity across the flow", "m/s", [](const CellSight& s) { return s.motion.velocity.y(); }},
      {"position along the flow", "m", [](const CellSight& s) { return s.shape.centroid.x(); }},
      {"position across the flow", "m", [](const CellSight& s) { return s.shape.centroid.y(); }},
      {"length", "m", [](const CellSight& s) { return s.shape.length; }},
      {"width", "m", [](const CellSight& s) { return s.shape.width; }},
      {"smallest gap", "m", [](const CellSight& s) { return s.gap; }},
      {"rear dimple depth", "m", [](const CellSight& s) { return s.dimple; }},
      {"inclination", "rad", [](const CellSight& s) { return s.shape.inclination; }},
      {"deformation", "-", [](const CellSight& s) { return s.shape.deformation; }},
      {"tank-treading rate", "rad/s", [](const CellSight& s) { return s.motion.treading_rate; }},
      {"membrane energy", "N", [](const CellSight& s) { return s.energy; }},
      {"bending energy", "N", [](const CellSight& s) { return s.bending_energy; }},
      {"largest tension", "N/m", [](const CellSight& s) { return s.tension; }},
      {"smallest tension", "N/m", [](const CellSight& s) { return s.smallest_tension; }},
      {"area error", "-", [](const CellSight& s) { return s.strain.area_error; }},
      {"perimeter error", "-", [](const CellSight& s) { return s.strain.perimeter_error; }},
      {"largest length error of a segment", "-",
       [](const CellSight& s) { return s.strain.length_error; }}};
  return list;
}

/// Stress of all cells over the viscous stress times their area fraction.
micro::Tensor<2> intrinsic_stress(const CellScene& scene, const micro::ImplicitMembranes& model) {
  micro::Tensor<2> sum = micro::Tensor<2>::Zero();
  double area = 0;
  const double viscosity = scene.plasma.fluid.viscosity();
  for (const micro::RingSource& source : model.sources()) {
    sum += micro::cell_stress(source, viscosity);
    area += std::abs(micro::measure_shape(micro::RingCurve(source.coarse().positions)).area);
  }
  return sum / (viscosity * scene.rate * area);
}

bool is_tumbling(const CellHistory& history, std::size_t cell) {
  const std::vector<double>& angles = history[name_of(cell, "inclination")];
  const auto [least, most] = std::minmax_element(angles.begin(), angles.end());
  return *most - *least > 0.9 * std::numbers::pi;
}

/// Figures of one quantity: whether it is steady, since when, and what it tends to.
void add_steady_state(const CellHistory& history, const std::string& column,
                      const std::string& unit, const std::vector<double>& progress,
                      const micro::SteadyCriterion& criterion, std::vector<Figure>& figures) {
  const micro::SteadyState state =
      micro::find_steady_state(history["time"], progress, history[column], criterion);
  const std::size_t colon = column.find(": ");
  const std::string cell = column.substr(0, colon + 2);
  const std::string quantity = column.substr(colon + 2);
  figures.push_back(
      {cell + "settling time of " + quantity, state.settling_time.value_or(nan), "s"});
  if (state.steadiness == micro::Steadiness::too_short) return;
  figures.push_back({cell + "steady value of " + quantity, state.final_value, unit});
  figures.push_back({cell + "change still to come of " + quantity, state.remaining, "-"});
}

}  // namespace

double smallest_gap(const CellScene& scene, const micro::CellsInPlasma& model, std::size_t c) {
  const double period = scene.period();
  Points positions = model.cells()[c].positions;
  const double middle = positions.front().x();
  if (period > 0) {
    positions = shifted(std::move(positions), {-period * std::floor(middle / period), 0});
  }
  const micro::RingCurve curve(positions);
  double smallest = std::numeric_limits<double>::infinity();
  for (const Points& wall : scene.walls) smallest = std::min(smallest, micro::gap(curve, wall));
  for (std::size_t o = 0; o < model.cells().size(); ++o) {
    if (o == c) continue;
    Points other = model.cells()[o].positions;
    if (period > 0) {
      const double apart = other.front().x() - positions.front().x();
      other = shifted(std::move(other), {-period * std::nearbyint(apart / period), 0});
    }
    smallest = std::min(smallest, micro::gap(curve, micro::RingCurve(other)));
  }
  return smallest;
}

std::vector<Column> cell_columns(const CellScene& scene) {
  std::vector<Column> columns = {{"time", "s"}, {"steps", "-"}};
  if (scene.is_unbounded()) {
    columns.push_back({"strain", "-"});
    columns.push_back({"intrinsic viscosity", "-"});
    columns.push_back({"intrinsic normal stress difference", "-"});
  }
  for (std::size_t c = 0; c < scene.cells.size(); ++c) {
    for (const Quantity& quantity : quantities()) {
      columns.push_back({name_of(c, quantity.name), quantity.unit});
    }
  }
  if (!scene.is_unbounded()) columns.push_back({"extra pressure drop", "Pa"});
  return columns;
}

std::vector<double> cell_row(const CellScene& scene, const micro::CellsInPlasma& model) {
  std::vector<double> row = {model.time(), static_cast<double>(model.steps())};
  const micro::ImplicitMembranes* implicit = model.implicit();
  if (scene.is_unbounded()) {
    const micro::Tensor<2> stress = intrinsic_stress(scene, *implicit);
    row.insert(row.end(), {model.time() * scene.rate, 0.5 * (stress(0, 1) + stress(1, 0)),
                           stress(0, 0) - stress(1, 1)});
  }
  for (std::size_t c = 0; c < scene.cells.size(); ++c) {
    const CellSight sight = sight_of(scene, model, c);
    for (const Quantity& quantity : quantities()) row.push_back(quantity.value(sight));
  }
  if (!scene.is_unbounded()) {
    // The explicit couplings know the pressure only with the noise of their nodes, far above what a
    // cell adds.
    row.push_back(implicit != nullptr ? implicit->extra_pressure_drop() : nan);
  }
  return row;
}

CellHistory::CellHistory(std::vector<Column> columns) : values_(columns.size()) {
  for (std::size_t k = 0; k < columns.size(); ++k) index_[columns[k].name] = k;
}

void CellHistory::append(const std::vector<double>& row) {
  for (std::size_t k = 0; k < values_.size(); ++k) values_[k].push_back(row[k]);
}

void CellHistory::unwrap(std::vector<double>& row) const {
  if (empty()) return;
  for (const auto& [name, k] : index_) {
    if (name.find(": inclination") == std::string::npos) continue;
    const double turns = std::nearbyint((values_[k].back() - row[k]) / std::numbers::pi);
    row[k] += turns * std::numbers::pi;
  }
}

const std::vector<double>& CellHistory::operator[](const std::string& column) const {
  return values_[index_.at(column)];
}

std::vector<Figure> cell_figures(const Settings& settings, const CellScene& scene,
                                 const micro::CellsInPlasma& model, const CellHistory& history) {
  std::vector<Figure> figures;
  for (const Column& column : cell_columns(scene)) {
    figures.push_back({column.name, history[column.name].back(), column.unit});
  }
  const double mean_speed = scene.plasma.mean_speed;
  if (!scene.is_unbounded()) figures.push_back({"mean speed", mean_speed, "m/s"});
  const micro::CellNumbers numbers = micro::cell_numbers(cell_in_flow(scene, settings));
  figures.push_back({"bending capillary number", numbers.bending_capillary, "-"});
  figures.push_back({"stretch capillary number", numbers.stretch_capillary, "-"});
  figures.push_back({"Reynolds number", numbers.reynolds, "-"});
  figures.push_back({"confinement", numbers.confinement, "-"});
  for (std::size_t c = 0; c < scene.cells.size(); ++c) {
    const micro::RingMesh& mesh = scene.cells[c].membrane->mesh();
    const std::string speed = name_of(c, "velocity along the flow");
    const std::string length = name_of(c, "length");
    if (c == 0) {
      figures.push_back(
          {"reduced area of a cell at rest",
           4 * std::numbers::pi * mesh.rest_area / (mesh.rest_perimeter * mesh.rest_perimeter),
           "-"});
    }
    if (scene.is_unbounded()) {
      const std::vector<double>& strain = history["strain"];
      const bool tumbles = is_tumbling(history, c);
      figures.push_back({name_of(c, "tumbles"), tumbles ? 1.0 : 0.0, "-"});
      if (tumbles) {
        const auto period = micro::turning_period(
            history["time"], history[name_of(c, "inclination")], std::numbers::pi / 2);
        figures.push_back({name_of(c, "tumbling period"), period ? period->mean : nan, "s"});
      } else {
        const double rate = std::abs(history[name_of(c, "tank-treading rate")].back());
        figures.push_back({name_of(c, "tank-treading period"), 2 * std::numbers::pi / rate, "s"});
        const micro::SteadyCriterion criterion{.tolerance = 0.01, .window = 5};
        add_steady_state(history, name_of(c, "inclination"), "rad", strain, criterion, figures);
      }
      continue;
    }
    figures.push_back(
        {name_of(c, "velocity over mean speed"), history[speed].back() / mean_speed, "-"});
    // Progress is the way of the cell; two heights are long against what a shape remembers.
    std::vector<double> way = history[name_of(c, "position along the flow")];
    const double start = way.front();
    double furthest = 0;
    for (double& x : way) furthest = x = std::max(furthest, x - start);
    const micro::SteadyCriterion of_speed{.tolerance = 0.005, .window = scene.plasma.size};
    const micro::SteadyCriterion of_length{.tolerance = 0.01, .window = scene.plasma.size};
    add_steady_state(history, speed, "m/s", way, of_speed, figures);
    add_steady_state(history, length, "m", way, of_length, figures);
  }
  if (const micro::ImplicitMembranes* implicit = model.implicit()) {
    const micro::ImplicitCounters& counters = implicit->counters();
    figures.push_back({"refused steps", static_cast<double>(counters.refused), "-"});
    figures.push_back({"sweeps", static_cast<double>(counters.sweeps), "-"});
  }
  const double longest = longest_step(model.limits(), scene.time_step);
  if (std::isfinite(longest)) figures.push_back({"limit of the time step", longest, "s"});
  for (const micro::Limit& limit : model.limits()) {
    figures.push_back({limit.name + ", share used", limit.value / limit.limit, "-"});
  }
  figures.push_back({"time step", scene.time_step, "s"});
  return figures;
}

std::vector<Column> node_columns() {
  return {{"time", "s"}, {"cell", "-"}, {"node", "-"}, {"x", "m"},
          {"y", "m"},    {"u", "m/s"},  {"v", "m/s"},  {"tension", "N/m"}};
}

std::vector<std::vector<double>> node_rows(const micro::CellsInPlasma& model) {
  std::vector<std::vector<double>> rows;
  for (std::size_t c = 0; c < model.cells().size(); ++c) {
    const micro::Cell& cell = model.cells()[c];
    const std::vector<double> tensions = model.tensions(c);
    for (std::size_t i = 0; i < cell.positions.size(); ++i) {
      const micro::Vector<2>& x = cell.positions[i];
      const micro::Vector<2>& u = cell.velocities[i];
      rows.push_back({model.time(), static_cast<double>(c), static_cast<double>(i), x.x(), x.y(),
                      u.x(), u.y(), tensions[i]});
    }
  }
  return rows;
}

std::vector<std::string> cell_statements(const Settings& settings) {
  std::vector<std::string> statements = {
      "two-dimensional: forces, moduli and energies are per unit depth; a cell is a cylinder"};
  const std::string& membranes = settings.text("micro.plasma.membranes");
  if (membranes == "implicit") {
    statements.push_back("quasi-steady Stokes flow: no inertia of plasma, cells or membranes");
  }
  if (settings.quantity("micro.cell.viscosity_ratio") == 1) {
    statements.push_back(
        "inside of the cells as viscous as the plasma; that of red cells is about five times as "
        "viscous");
  }
  if (settings.text("micro.plasma.flow") == "unbounded-shear") {
    statements.push_back("unbounded: walls are infinitely far away");
  }
  return statements;
}

}  // namespace hemoscale::coupling
