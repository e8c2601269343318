#include "coupling/scene/cell_scene.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numbers>

#include "coupling/error.hpp"
#include "coupling/report/series.hpp"
#include "micro/cells/outline.hpp"
#include "micro/cells/outline_checks.hpp"
#include "micro/cells/rest_shape.hpp"
#include "micro/error.hpp"
#include "micro/mps/node_domains.hpp"

namespace hemoscale::coupling {

namespace {

const std::string prefix = "micro.cell.";
using Points = std::vector<micro::Vector<2>>;

class KeyFaults {
 public:
  explicit KeyFaults(const Settings& settings) : settings_(settings) {}

  void add(const std::string& key, const std::string& message) {
    const Location place = settings_.location(key);
    faults_.push_back({place.file, place.line, place.column, key, message});
  }
  void finish() const {
    if (!faults_.empty()) throw CaseError(faults_);
  }

 private:
  const Settings& settings_;
  std::vector<Fault> faults_;
};

/// Nodes from a file beside the case.
Points tabulated_outline(const Settings& settings) {
  const std::string key = prefix + "outline_table";
  std::filesystem::path path = settings.text(key);
  const std::filesystem::path folder =
      std::filesystem::path(settings.location(key).file).parent_path();
  if (path.is_relative()) path = folder / path;
  const Table table = read_table(path);
  KeyFaults faults(settings);
  const bool has_columns =
      table.columns.size() == 2 && table.columns[0].unit == "m" && table.columns[1].unit == "m";
  if (!has_columns || table.rows.size() < 16) {
    faults.add(key, fmt::format("{} has {} columns and {} rows; two columns, \"x [m],y [m]\", and "
                                "at least 16 rows are needed",
                                path.string(), table.columns.size(), table.rows.size()));
    faults.finish();
  }
  Points nodes;
  for (const std::vector<double>& row : table.rows) nodes.emplace_back(row[0], row[1]);
  for (const std::string& line : micro::outline_faults(std::vector<Points>{nodes}, {})) {
    faults.add(key, path.string() + ": " + line);
  }
  faults.finish();
  return nodes;
}

Points rest_outline(const Settings& settings) {
  const std::string& outline = settings.text(prefix + "outline");
  if (outline == "table") return tabulated_outline(settings);
  const auto nodes = static_cast<int>(settings.integer(prefix + "nodes"));
  if (outline == "deflated") {
    micro::Deflation deflation;
    deflation.perimeter = settings.quantity(prefix + "perimeter");
    deflation.reduced_area = settings.quantity(prefix + "reduced_area");
    deflation.bending_law = settings.text(prefix + "bending_law") == "half-angle-tangent"
                                ? micro::BendingLaw::half_angle_tangent
                                : micro::BendingLaw::turning_angle;
    deflation.seed = static_cast<std::uint64_t>(settings.integer("case.seed"));
    return micro::deflate(deflation, nodes).nodes;
  }
  micro::OutlineParameters parameters;
  parameters.length = settings.quantity(prefix + "length");
  if (outline == "ellipse") {
    parameters.outline = micro::Outline::ellipse;
    parameters.aspect = settings.quantity(prefix + "aspect");
  }
  return micro::outline_nodes(parameters, nodes);
}

micro::MembraneParameters membrane_parameters(const Settings& settings) {
  micro::MembraneParameters p;
  const std::string& stretch = settings.text(prefix + "stretch_law");
  p.stretch_law = stretch == "linear"         ? micro::StretchLaw::linear
                  : stretch == "line-element" ? micro::StretchLaw::line_element
                                              : micro::StretchLaw::inextensible;
  p.stretch_modulus =
      settings.has(prefix + "stretch_modulus") ? settings.quantity(prefix + "stretch_modulus") : 0;
  p.bending_modulus = settings.quantity(prefix + "bending_modulus");
  p.bending_law = settings.text(prefix + "bending_law") == "half-angle-tangent"
                      ? micro::BendingLaw::half_angle_tangent
                      : micro::BendingLaw::turning_angle;
  const std::string& natural = settings.text(prefix + "natural_shape");
  p.natural_shape = natural == "outline"     ? micro::NaturalShape::outline
                    : natural == "curvature" ? micro::NaturalShape::curvature
                                             : micro::NaturalShape::flat;
  if (settings.has(prefix + "spontaneous_curvature")) {
    p.spontaneous_curvature = settings.quantity(prefix + "spontaneous_curvature");
  }
  p.area_law = settings.text(prefix + "area_law") == "penalty" ? micro::AreaLaw::penalty
                                                               : micro::AreaLaw::exact;
  p.area_modulus =
      settings.has(prefix + "area_modulus") ? settings.quantity(prefix + "area_modulus") : 0;
  return p;
}

/// Where the centres of the cells are at the start.
Points centres(const Settings& settings, const CellScene& scene, KeyFaults& faults) {
  const auto count = static_cast<std::size_t>(settings.integer(prefix + "count"));
  if (settings.has(prefix + "centres")) {
    Points result;
    for (const Eigen::Vector3d& point : settings.points(prefix + "centres")) {
      result.emplace_back(point.head<2>());
    }
    if (result.size() != count) {
      faults.add(prefix + "centres", fmt::format("holds {} points for {} cells; give one for each",
                                                 result.size(), count));
    }
    for (const char* key : {"x", "y", "distance"}) {
      if (settings.has(prefix + key)) {
        faults.add(prefix + key, "is given beside the centres; remove one of them");
      }
    }
    return result;
  }
  micro::Vector<2> first = micro::Vector<2>::Zero();
  if (!scene.is_unbounded()) {
    const double length = settings.quantity("micro.plasma.length");
    first = {scene.period() > 0 ? length / 4 : 1.5 * scene.plasma.size, scene.plasma.size / 2};
  }
  if (settings.has(prefix + "x")) first.x() = settings.quantity(prefix + "x");
  if (settings.has(prefix + "y")) first.y() = settings.quantity(prefix + "y");
  double distance = 0;
  if (settings.has(prefix + "distance")) {
    distance = settings.quantity(prefix + "distance");
  } else if (count > 1) {
    faults.add(prefix + "distance", "is missing; more than one cell needs it, or centres");
  }
  Points result;
  for (std::size_t c = 0; c < count; ++c) {
    result.emplace_back(first.x() + static_cast<double>(c) * distance, first.y());
  }
  return result;
}

/// Lines along the walls, in the order of their nodes; straight ones of periodic channels go on for
/// a period on both sides.
std::vector<Points> wall_lines(const PlasmaScene<2>& plasma) {
  const micro::FlowDomain<2>& domain = plasma.domain;
  std::vector<Points> lines;
  if (std::holds_alternative<micro::SemiImplicitOptions>(plasma.method)) {
    // Wall particles lie behind the walls of the straight channels that this method has.
    double length = 0;
    for (const auto& x : domain.particles.positions) length = std::max(length, x.x());
    return {{{0, 0}, {length, 0}}, {{0, plasma.size}, {length, plasma.size}}};
  }
  for (std::size_t patch = 0; patch < domain.patches.size(); ++patch) {
    if (domain.patches[patch].kind != micro::ParticleKind::wall) continue;
    Points line;
    for (std::size_t i = 0; i < domain.particles.size(); ++i) {
      if (domain.particles.patches[i] == static_cast<std::int32_t>(patch)) {
        line.push_back(domain.particles.positions[i]);
      }
    }
    const bool is_channel_wall = patch <= micro::upper_wall;
    if (is_channel_wall) {
      std::sort(line.begin(), line.end(),
                [](const auto& a, const auto& b) { return a.x() < b.x(); });
      if (domain.box.periodic[0]) {
        const double period = domain.box.extent()[0];
        line.insert(line.begin(), line.front() - micro::Vector<2>(period, 0));
        line.push_back(line.back() + micro::Vector<2>(period, 0));
      }
    } else if (!line.empty() && (line.front() - line.back()).norm() < 2 * domain.spacing) {
      line.push_back(line.front());  // around an obstacle
    }
    if (line.size() > 1) lines.push_back(std::move(line));
  }
  return lines;
}

void check_places(const Settings& settings, const CellScene& scene, KeyFaults& faults) {
  std::vector<Points> rings;
  for (const micro::Cell& cell : scene.cells) rings.push_back(cell.positions);
  std::vector<micro::Chain> chains;
  for (const Points& wall : scene.walls) chains.push_back({.nodes = wall, .closed = false});
  const std::string key = prefix + (settings.has(prefix + "centres") ? "centres"
                                    : settings.has(prefix + "y")     ? "y"
                                                                     : "x");
  const std::vector<std::string> lines = micro::outline_faults(rings, chains);
  for (const std::string& line : lines) faults.add(key, line);
  if (!lines.empty() || scene.is_unbounded()) return;
  // What touches nothing may still lie outside altogether, or in an opening.
  const micro::MembraneBounds bounds(scene.plasma.domain, 0, scene.plasma.domain.spacing);
  for (std::size_t c = 0; c < rings.size(); ++c) {
    for (std::size_t i = 0; i < rings[c].size(); ++i) {
      const std::string fault = bounds.fault_at(rings[c][i]);
      if (fault.empty()) continue;
      faults.add(key, fmt::format("cell {}: node {} {}; move the cell", c, i, fault));
      break;
    }
  }
}

micro::Surroundings::Flow surroundings(const CellScene& scene, const Settings& settings) {
  if (scene.is_unbounded()) {
    micro::UnboundedFlow flow;
    flow.viscosity = scene.plasma.fluid.viscosity();
    flow.gradient(0, 1) = scene.rate;
    return flow;
  }
  micro::BoundedFlow flow;
  flow.nodes = std::make_shared<micro::StokesNodes>(
      scene.plasma.domain, scene.plasma.fluid, std::get<micro::StageOptions>(scene.plasma.method));
  if (settings.text("micro.plasma.flow") == "periodic-channel") {
    flow.kept_flow_rate = scene.plasma.mean_speed * scene.plasma.size;
  }
  return flow;
}

}  // namespace

double CellScene::period() const {
  const micro::PeriodicBox<2>& box = plasma.domain.box;
  return !is_unbounded() && box.periodic[0] ? box.extent()[0] : 0;
}

bool has_cells_in_plasma(const Settings& settings) {
  return settings.text("micro.model") == "plasma" &&
         settings.text("micro.plasma.membranes") != "none";
}

CellScene build_cell_scene(const Settings& settings, bool force) {
  KeyFaults faults(settings);
  CellScene scene;
  const std::string& flow = settings.text("micro.plasma.flow");
  const std::string& membranes = settings.text("micro.plasma.membranes");
  scene.plasma = build_plasma_scene<2>(settings, force);
  if (flow == "unbounded-shear") {
    scene.rate = settings.quantity("micro.plasma.rate");
    if (membranes != "implicit") {
      faults.add("micro.plasma.membranes",
                 fmt::format("\"{}\" needs particles of plasma, and unbounded shear has none; "
                             "choose implicit",
                             membranes));
    }
  }
  const bool by_particles = std::holds_alternative<micro::SemiImplicitOptions>(scene.plasma.method);
  if ((membranes == "direct") != by_particles) {
    faults.add("micro.plasma.membranes",
               by_particles ? fmt::format("\"{}\" needs the operators lsmps2; choose scheme = "
                                          "\"best\", or direct",
                                          membranes)
                            : "\"direct\" needs the particle method; choose scheme = \"paper\" or "
                              "\"repaired\"");
  }
  faults.finish();

  const Points outline = rest_outline(settings);
  const micro::MembraneParameters parameters = membrane_parameters(settings);
  const auto membrane = std::make_shared<const micro::RingMembrane>(
      micro::make_ring_mesh(outline, parameters.natural_shape, parameters.spontaneous_curvature),
      parameters);
  scene.radius = membrane->mesh().rest_perimeter / (2 * std::numbers::pi);
  const Eigen::Rotation2D<double> turn(settings.quantity(prefix + "angle"));
  for (const micro::Vector<2>& centre : centres(settings, scene, faults)) {
    micro::Cell cell;
    cell.membrane = membrane;
    cell.viscosity_ratio = settings.quantity(prefix + "viscosity_ratio");
    for (const micro::Vector<2>& x : outline) cell.positions.emplace_back(centre + turn * x);
    scene.cells.push_back(std::move(cell));
  }
  if (!scene.is_unbounded()) scene.walls = wall_lines(scene.plasma);
  check_places(settings, scene, faults);
  faults.finish();

  if (scene.is_unbounded()) {
    scene.plasma.speed = scene.plasma.mean_speed = scene.rate * scene.radius;
    scene.plasma.size = 2 * scene.radius;
  }
  if (settings.has("micro.plasma.time_step")) {
    scene.time_step = settings.quantity("micro.plasma.time_step");
  } else if (membranes == "implicit") {
    // The accuracy of the steps is their own affair.
    scene.time_step = settings.quantity("micro.output_interval");
  } else {
    // Four fifths of the limit of the membranes, or a fifth of a spacing on the way of the plasma.
    scene.time_step = 0.2 * scene.plasma.domain.spacing / scene.plasma.speed;
    const micro::CellsInPlasma trial = build_cells_in_plasma(scene, settings, true);
    scene.time_step =
        std::min(scene.time_step, 0.8 * longest_step(trial.limits(), scene.time_step));
  }
  scene.plasma.time_step = scene.time_step;
  return scene;
}

micro::CellsInPlasma build_cells_in_plasma(const CellScene& scene, const Settings& settings,
                                           bool force) {
  const std::string& membranes = settings.text("micro.plasma.membranes");
  const double strain = settings.quantity(prefix + "largest_strain");
  if (membranes == "implicit") {
    micro::ImplicitOptions options;
    options.longest_step = scene.time_step;
    options.step_tolerance = settings.quantity(prefix + "step_tolerance");
    options.sweep_tolerance = settings.quantity(prefix + "sweep_tolerance");
    options.thresholds.strain = strain;
    return {std::make_unique<micro::ImplicitMembranes>(
                std::make_shared<const micro::Surroundings>(surroundings(scene, settings)),
                scene.cells, options),
            scene.time_step};
  }
  micro::MembraneThresholds thresholds;
  thresholds.strain = strain;
  if (membranes == "immersed") {
    micro::ImmersedOptions options;
    options.flow = std::get<micro::StageOptions>(scene.plasma.method);
    options.kernel = settings.text(prefix + "kernel") == "three-point"
                         ? micro::TransferKernel::three_point
                         : micro::TransferKernel::four_point;
    options.stepping = settings.text(prefix + "stepping") == "adams-bashforth"
                           ? micro::NodeStepping::adams_bashforth
                           : micro::NodeStepping::forward_euler;
    options.thresholds = thresholds;
    options.speed = scene.plasma.speed;
    options.force = force;
    return {std::make_unique<micro::ImmersedMembranes>(scene.plasma.domain, scene.plasma.fluid,
                                                       options, scene.cells),
            scene.time_step};
  }
  return {std::make_unique<micro::DirectMembranes>(
              scene.plasma.domain, scene.plasma.fluid,
              std::get<micro::SemiImplicitOptions>(scene.plasma.method), scene.cells,
              micro::DirectInsertion{}, thresholds),
          scene.time_step};
}

micro::CellInFlow cell_in_flow(const CellScene& scene, const Settings& settings) {
  const micro::MembraneParameters p = membrane_parameters(settings);
  const bool stretches = p.stretch_law != micro::StretchLaw::inextensible;
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  return {.viscosity = scene.plasma.fluid.viscosity(),
          .density = scene.plasma.fluid.density,
          .speed = scene.plasma.mean_speed,
          .radius = scene.radius,
          .gap_width = scene.is_unbounded() ? unlimited : scene.plasma.size,
          .stretch_modulus = stretches ? p.stretch_modulus : unlimited,
          .bending_modulus = p.bending_modulus};
}

std::vector<std::string> cell_warnings(const CellScene& scene, const Settings& settings) {
  const std::string stretch = micro::unbounded_stretch(cell_in_flow(scene, settings));
  return stretch.empty() ? std::vector<std::string>() : std::vector<std::string>{stretch};
}

std::string describe_cells_in_plasma(const Settings& settings) {
  const CellScene scene = build_cell_scene(settings, true);
  const micro::CellsInPlasma model = build_cells_in_plasma(scene, settings, true);
  const micro::CellNumbers numbers = micro::cell_numbers(cell_in_flow(scene, settings));
  std::string text = fmt::format(
      "cells in plasma: {} of {} nodes, coupling {}, flow {}, {} particles of plasma\n"
      "  Ca_b {:.4g} (mu U R0^2 / kappa), Ca_s {:.4g} (mu U / E_l), Re {:.4g}, confinement {:.4g}, "
      "R0 {:.4g} m\n"
      "  longest step {:.4g} s\n",
      scene.cells.size(), scene.cells.front().positions.size(),
      settings.text("micro.plasma.membranes"), settings.text("micro.plasma.flow"),
      scene.plasma.domain.particles.size(), numbers.bending_capillary, numbers.stretch_capillary,
      numbers.reynolds, numbers.confinement, scene.radius, scene.time_step);
  for (const micro::Limit& limit : model.limits()) {
    text += fmt::format("  {}: {:.4g} of {:.4g} {}\n", limit.name, limit.value, limit.limit,
                        limit.unit);
  }
  for (const std::string& warning : cell_warnings(scene, settings)) {
    text += "  warning: " + warning + "\n";
  }
  return text;
}

}  // namespace hemoscale::coupling
