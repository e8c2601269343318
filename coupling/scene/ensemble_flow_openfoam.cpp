// An OpenFOAM case as the given flow of an ensemble: solved if asked for, its walls and openings
// read from the boundary of the mesh, its velocity sampled on a grid.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

#include "coupling/error.hpp"
#include "coupling/scene/child_process.hpp"
#include "coupling/scene/ensemble_flow.hpp"
#include "macro/openfoam/loader.hpp"
#include "micro/ensemble/flow/expansion_error.hpp"
#include "micro/ensemble/flow/grid_flow.hpp"
#include "micro/ensemble/flow/interpolation_error.hpp"

namespace hemoscale::coupling {

namespace {

namespace fs = std::filesystem;

using Polyline = std::vector<micro::Vector<2>>;

const std::string prefix = "micro.flow.";
constexpr double largest_imbalance = 1e-2;  // [-] of the fluxes through the openings
constexpr double most_nodes = 2e7;          // of the grid

CaseError fault(const Settings& settings, const std::string& key, const std::string& message) {
  const Location place = settings.location(prefix + key);
  return CaseError({{place.file, place.line, place.column, prefix + key, message}});
}

std::vector<std::string> words(const std::string& text, char separator) {
  std::istringstream stream(text);
  std::vector<std::string> result;
  for (std::string word; std::getline(stream, word, separator);) {
    const std::size_t first = word.find_first_not_of(' ');
    if (first == std::string::npos) continue;
    result.push_back(word.substr(first, word.find_last_not_of(' ') - first + 1));
  }
  return result;
}

/// Runs a program of OpenFOAM in a folder to its end.
void run_program(const fs::path& folder, const fs::path& log, const std::string& command) {
  ChildProcess child;
  child.command = words(command, ' ');
  child.folder = folder;
  child.log = log;
  if (std::getenv("WM_PROJECT_DIR") == nullptr) {
    child.environment["WM_PROJECT_DIR"] = "/usr/share/openfoam";
  }
  std::vector<std::string> last_lines;
  const int status = run_child(child, [&](const std::string& line) {
    last_lines.push_back(line);
    if (last_lines.size() > 30) last_lines.erase(last_lines.begin());
  });
  if (status == 0) return;
  std::string tail;
  for (const std::string& line : last_lines) tail += "\n  | " + line;
  throw EnvironmentError(
      fmt::format("{} ended with status {}; its output is in {}, the last lines:{}", command,
                  status, log.string(), tail));
}

/// The case with its flow: itself, or the copy among the results in which the solver has run.
fs::path solved_case(const Settings& settings, const fs::path& case_folder,
                     const fs::path& results) {
  const fs::path original = case_folder / settings.text(prefix + "case");
  if (!fs::is_regular_file(original / "system" / "controlDict")) {
    throw fault(settings, "case",
                fmt::format("{} is not an OpenFOAM case: it has no system/controlDict; give the "
                            "folder that holds 0, constant and system",
                            original.string()));
  }
  if (!settings.has(prefix + "solver")) return original;
  const fs::path folder = results / "flow";
  // Written last: a run that was interrupted before is made again.
  const fs::path mark = folder / "solved";
  if (fs::exists(mark)) return folder;
  try {
    fs::remove_all(folder);
    fs::create_directories(folder);
    for (const char* part : {"0", "constant", "system"}) {
      fs::copy(original / part, folder / part, fs::copy_options::recursive);
    }
  } catch (const fs::filesystem_error& error) {
    throw EnvironmentError(fmt::format("{}: cannot be copied to {}: {}", original.string(),
                                       folder.string(), error.code().message()));
  }
  run_program(folder, results / "log.flow-mesh", settings.text(prefix + "mesh_command"));
  run_program(folder, results / "log.flow-solver", settings.text(prefix + "solver"));
  std::ofstream(mark) << settings.text(prefix + "solver") << '\n';
  return folder;
}

macro::CaseReading build_reading(const Settings& settings) {
  macro::CaseReading reading;
  if (settings.has(prefix + "time")) reading.time = settings.text(prefix + "time");
  reading.velocity_field = settings.text(prefix + "velocity_field");
  reading.pressure_field = "";  // cells do not feel it
  // Second derivatives of the sampled flow show every jump between cells.
  reading.interpolation = macro::Interpolation::least_squares;
  reading.units.length = settings.quantity(prefix + "length_unit");
  reading.units.time = settings.quantity(prefix + "time_unit");
  reading.units.density = settings.quantity("fluid.density");
  return reading;
}

/// The inlet and the outlets that the case names, as the mesh has them.
std::vector<micro::Opening> find_openings(const Settings& settings,
                                          const macro::MeshOutline& outline) {
  std::string known;
  for (const auto& opening : outline.openings) {
    known += (known.empty() ? "" : ", ") + opening.patch;
  }
  std::vector<micro::Opening> openings;
  const auto add = [&](const std::string& key, const std::string& name) {
    const auto found = std::find_if(outline.openings.begin(), outline.openings.end(),
                                    [&](const auto& opening) { return opening.patch == name; });
    if (found == outline.openings.end()) {
      throw fault(settings, key,
                  fmt::format("the mesh has no opening \"{}\"; it has {}", name,
                              known.empty() ? "none" : known));
    }
    if (std::any_of(openings.begin(), openings.end(),
                    [&](const micro::Opening& opening) { return opening.name == name; })) {
      throw fault(
          settings, key,
          fmt::format("\"{}\" is named twice; the openings of the mesh are {}; name each of "
                      "them once, as the inlet or an outlet",
                      name, known));
    }
    if (found->polylines.size() != 1 || found->polylines.front().size() != 2) {
      throw fault(settings, key,
                  fmt::format("the patch \"{}\" is not one straight line; divide it into patches "
                              "that are",
                              name));
    }
    openings.push_back({name, found->polylines[0][0], found->polylines[0][1]});
  };
  add("inlet", settings.text(prefix + "inlet"));
  for (const std::string& name : words(settings.text(prefix + "outlets"), ',')) {
    add("outlets", name);
  }
  if (openings.size() != outline.openings.size()) {
    throw fault(settings, "outlets",
                fmt::format("the openings of the mesh are {}; each of them must be the inlet or an "
                            "outlet, once; name them all",
                            known));
  }
  return openings;
}

/// Walls that go on beyond the openings where they end.
std::vector<Polyline> continued(const macro::MeshOutline& outline,
                                const std::vector<micro::Opening>& openings, double overhang) {
  std::vector<Polyline> walls;
  for (const macro::MeshOutline::Polyline& wall : outline.walls) {
    Polyline longer = wall;
    for (const micro::Opening& opening : openings) {
      // Around the fluid an opening ends where a wall begins.
      const double margin = 1e-6 * opening.length();
      const micro::Vector<2> beyond = -overhang * opening.inward();
      if ((wall.front() - opening.b).norm() < margin) {
        longer.insert(longer.begin(), wall.front() + beyond);
      }
      if ((wall.back() - opening.a).norm() < margin) longer.push_back(wall.back() + beyond);
    }
    walls.push_back(std::move(longer));
  }
  return walls;
}

/// A grid over the fluid and what lies beyond its openings.
micro::GridSamples lay_grid(const Settings& settings, const std::vector<Polyline>& walls) {
  micro::GridSamples grid;
  grid.spacing = settings.quantity(prefix + "grid_spacing");
  micro::Vector<2> lower = walls.front().front();
  micro::Vector<2> upper = lower;
  for (const Polyline& wall : walls) {
    for (const micro::Vector<2>& x : wall) {
      lower = lower.cwiseMin(x);
      upper = upper.cwiseMax(x);
    }
  }
  const double margin = 4 * grid.spacing;  // for the continuation into the walls
  grid.origin = lower - micro::Vector<2>::Constant(margin);
  const micro::Vector<2> extent = upper - lower + micro::Vector<2>::Constant(2 * margin);
  const micro::Vector<2> counts = extent / grid.spacing;
  if (!(counts[0] * counts[1] < most_nodes)) {
    throw fault(settings, "grid_spacing",
                fmt::format("a grid of {:g} m over {:g} m by {:g} m would have {:.2g} nodes, more "
                            "than {:.2g}; enlarge the spacing",
                            grid.spacing, extent[0], extent[1], counts[0] * counts[1], most_nodes));
  }
  grid.columns = static_cast<std::size_t>(counts[0]) + 2;
  grid.rows = static_cast<std::size_t>(counts[1]) + 2;
  grid.velocities.resize(grid.columns * grid.rows);
  return grid;
}

/// Asks the field for the velocities at places of nodes.
void fill(micro::GridSamples& grid, const macro::FlowField<3>& field, double depth,
          const std::vector<std::size_t>& nodes, const std::vector<micro::Vector<2>>& places) {
  std::vector<macro::Vector<3>> points;
  for (const micro::Vector<2>& x : places) points.push_back({x[0], x[1], depth});
  const auto states = field.sample(points, 0);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (states[k]) grid.velocities[nodes[k]] = states[k]->velocity.head<2>();
  }
}

/// Fills the nodes in the fluid. Beyond an opening the flow is that at the opening.
void sample(micro::GridSamples& grid, const macro::FlowField<3>& field, double depth,
            const micro::WallGeometry& walls, const std::vector<micro::Opening>& openings,
            double overhang) {
  const auto place = [&](std::size_t k) { return grid.place(k % grid.columns, k / grid.columns); };
  std::vector<std::size_t> nodes;
  std::vector<micro::Vector<2>> places;
  for (std::size_t k = 0; k < grid.velocities.size(); ++k) {
    if (!(walls.at(place(k)).distance > 0)) continue;
    nodes.push_back(k);
    places.push_back(place(k));
  }
  fill(grid, field, depth, nodes, places);

  std::vector<std::size_t> beyond;
  places.clear();
  for (const std::size_t k : nodes) {
    if (grid.velocities[k]) continue;
    const micro::Vector<2> x = place(k);
    for (const micro::Opening& opening : openings) {
      if (!micro::has_left(opening, x, overhang + 4 * grid.spacing)) continue;
      const double inside = 1e-6 * opening.length();
      beyond.push_back(k);
      places.push_back(x + (inside - micro::depth(opening, x)) * opening.inward());
      break;
    }
  }
  fill(grid, field, depth, beyond, places);
}

void state_fluxes(EnsembleFlow& result) {
  const double entering = micro::volume_flux(result.openings.front(), *result.flow, 0);
  double sum = 0;
  for (const micro::Opening& opening : result.openings) {
    const double flux = micro::volume_flux(opening, *result.flow, 0);
    result.statements.push_back({fmt::format("flux through {} [m^2/s]", opening.name), flux});
    sum += flux;
  }
  if (!(entering > 0)) {
    throw NumericalError(
        fmt::format("flow of an ensemble: {:.6g} m^2/s enter through the inlet {}; it must be "
                    "positive; exchange inlet and outlet or correct the OpenFOAM case",
                    entering, result.openings.front().name));
  }
  const double imbalance = std::abs(sum) / entering;
  result.statements.push_back({"imbalance of the fluxes over that of the inlet", imbalance});
  if (imbalance <= largest_imbalance) return;
  throw NumericalError(fmt::format(
      "flow of an ensemble: the fluxes through the openings differ by {:.3g} of the one "
      "that enters; at most {:g} is admissible; let the solver converge, or reduce "
      "micro.flow.grid_spacing",
      imbalance, largest_imbalance));
}

/// Places between the openings where the centre of a cell may be, so far from the walls [m].
std::vector<micro::Vector<2>> places_of_cells(const micro::GridSamples& grid,
                                              const micro::WallGeometry& walls,
                                              const std::vector<micro::Opening>& openings,
                                              double distance) {
  std::vector<micro::Vector<2>> places;
  for (std::size_t k = 0; k < grid.velocities.size(); ++k) {
    if (!grid.velocities[k]) continue;
    const micro::Vector<2> x = grid.place(k % grid.columns, k / grid.columns);
    const bool is_beyond =
        std::any_of(openings.begin(), openings.end(), [&](const micro::Opening& opening) {
          return micro::has_left(opening, x, std::numeric_limits<double>::infinity());
        });
    if (!is_beyond && walls.at(x).distance >= distance) places.push_back(x);
  }
  return places;
}

void state_expansion(EnsembleFlow& result, const micro::GridSamples& grid, double cell_radius) {
  double squares = 0;
  double largest = 0;
  const auto places = places_of_cells(grid, *result.walls, result.openings, 0.5 * cell_radius);
  for (const micro::Vector<2>& x : places) {
    const double error = micro::expansion_error(*result.flow, 0, cell_radius, {x});
    squares += error * error;
    largest = std::max(largest, error);
  }
  const double speed = result.flow->largest_speed();
  const double rms = std::sqrt(squares / static_cast<double>(places.size()));
  result.statements.push_back(
      {"rms error of one expansion for a whole cell over the largest speed", rms / speed});
  result.statements.push_back(
      {"largest error of one expansion for a whole cell over the largest speed", largest / speed});
}

}  // namespace

EnsembleFlow build_openfoam_flow(const Settings& settings, const fs::path& case_folder,
                                 const fs::path& results) {
  const double cell_radius = 0.5 * settings.quantity("micro.shape.length");
  EnsembleFlow result;
  result.overhang = settings.quantity(prefix + "overhang");
  if (result.overhang < cell_radius) {
    throw fault(
        settings, "overhang",
        fmt::format("{:g} m is less than half a cell, {:g} m; a cell that leaves would reach "
                    "beyond the end of the walls; enlarge it",
                    result.overhang, cell_radius));
  }
  const macro::OpenFoamLibrary library;  // tells at once what is missing
  const fs::path folder = solved_case(settings, case_folder, results);
  const macro::CaseReading reading = build_reading(settings);
  const macro::MeshOutline outline = library.read_outline(folder, reading);
  const auto field = library.open_case(folder, reading);

  result.openings = find_openings(settings, outline);
  const double reach = 2 * cell_radius + settings.quantity("micro.wall.range");
  result.walls.emplace(continued(outline, result.openings, result.overhang), reach);
  micro::GridSamples grid = lay_grid(settings, result.walls->walls());
  sample(grid, *field, 0.5 * (outline.back + outline.front), *result.walls, result.openings,
         result.overhang);
  const auto flow = std::make_shared<micro::GridFlow>(grid, &*result.walls);
  result.flow = flow;

  const double speed = flow->largest_speed();
  const micro::InterpolationError error = micro::interpolation_error(grid, &*result.walls);
  result.statements = {
      {"rms interpolation error of the velocity over the largest speed", error.rms / speed},
      {"largest interpolation error of the velocity over the largest speed", error.largest / speed},
      {"observed order of the rms interpolation error", error.order_of_rms},
      {"observed order of the largest interpolation error", error.order_of_largest},
      {"rms divergence of the sampled flow over the largest shear rate",
       flow->divergence().rms / flow->largest_shear_rate()}};
  state_expansion(result, grid, cell_radius);
  state_fluxes(result);
  return result;
}

}  // namespace hemoscale::coupling
