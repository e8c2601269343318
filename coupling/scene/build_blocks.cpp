#include "coupling/scene/build_blocks.hpp"

#include <cmath>
#include <span>
#include <utility>

#include "coupling/scene/build_micro.hpp"
#include "micro/ensemble/packing/insertion.hpp"
#include "micro/ensemble/packing/lattice_packing.hpp"
#include "micro/ensemble/packing/random_packing.hpp"
#include "micro/ensemble/packing/state_checks.hpp"
#include "micro/ensemble/step_limit.hpp"
#include "micro/error.hpp"

namespace hemoscale::coupling {

namespace {

using micro::blocks::BlockSettings;
using micro::blocks::Integrator;
using micro::blocks::KindSettings;

// Shear in one step of the implicit schemes unless a step is given: the error of the second order
// scheme in the vessel of the paper is then below 1e-4 um, see cases/vessel-ensemble.
constexpr double default_shear_per_step = 3e-4;

// Platelets get random numbers of their own.
constexpr std::uint64_t platelet_stream = 1U << 20U;

std::string integrator_name(const Settings& settings) {
  if (settings.has("micro.integrator")) return settings.text("micro.integrator");
  return settings.text("micro.domain") == "shear-box" ? "explicit-reference"
                                                      : "constant-operator-2";
}

Integrator integrator_of(const std::string& name) {
  if (name == "explicit") return Integrator::explicit_euler;
  if (name == "linearly-implicit") return Integrator::linearly_implicit;
  if (name == "constant-operator") return Integrator::constant_operator;
  return Integrator::constant_operator_second_order;
}

micro::PairPotential contact_of(const micro::EnsembleParameters& p) {
  return micro::make_pair_potential(p.contact.stiffness, p.contact.rest_distance, p.contact.cutoff,
                                    p.contact.attraction);
}

micro::OutlineParameters platelet_outline(const Settings& settings) {
  micro::OutlineParameters outline;
  outline.outline = micro::Outline::ellipse;
  outline.length = settings.quantity("micro.platelets.length");
  outline.aspect = settings.quantity("micro.platelets.aspect");
  return outline;
}

KindSettings platelets(const Settings& settings, const micro::EnsembleParameters& p) {
  const int nodes = static_cast<int>(settings.integer("micro.platelets.nodes"));
  micro::MembraneParameters membrane = p.membrane;
  membrane.stretch_modulus = settings.quantity("micro.platelets.stretch_modulus");
  membrane.bending_modulus = settings.quantity("micro.platelets.bending_modulus");
  membrane.natural_shape = micro::NaturalShape::outline;
  KindSettings kind;
  kind.mesh = micro::make_ring_mesh(micro::outline_nodes(platelet_outline(settings), nodes),
                                    membrane.natural_shape);
  kind.laws = micro::make_membrane_laws(membrane);
  kind.node_drag =
      settings.quantity("micro.platelets.drag_coefficient") * p.plasma_viscosity / nodes;
  return kind;
}

std::size_t platelet_count(const Settings& settings) {
  return static_cast<std::size_t>(
      std::llround(settings.quantity("micro.platelets.per_cell") *
                   static_cast<double>(settings.integer("micro.cells"))));
}

/// Where cells come and go, platelets do so in proportion.
bool has_platelets(const Settings& settings) {
  return settings.has("micro.cells") ? platelet_count(settings) > 0
                                     : settings.quantity("micro.platelets.per_cell") > 0;
}

}  // namespace

bool runs_on_vectors(const Settings& settings) {
  return settings.text("micro.model") == "ensemble" &&
         integrator_name(settings) != "explicit-reference";
}

bool has_explicit_limit(const Settings& settings) {
  const std::string name = integrator_name(settings);
  return name == "explicit-reference" || name == "explicit";
}

BlockScene build_blocks(const Settings& settings, int threads, bool force,
                        const std::filesystem::path& case_folder,
                        const std::filesystem::path& results) {
  const micro::EnsembleParameters p = build_ensemble_parameters(settings, threads, true);
  const micro::StepLimit limit = micro::step_limit(p);
  BlockScene scene;
  scene.flow = build_ensemble_flow(settings, case_folder, results);
  scene.precision = settings.text("micro.precision") == "double" ? micro::Precision::twofold
                                                                 : micro::Precision::single;
  BlockSettings& blocks = scene.settings;
  KindSettings red;
  red.mesh =
      micro::make_ring_mesh(micro::outline_nodes(p.outline, p.nodes), p.membrane.natural_shape);
  red.laws = micro::make_membrane_laws(p.membrane);
  red.node_drag = limit.drag;
  blocks.kinds = {red};
  scene.names = {"red cells"};
  scene.outlines = {micro::outline_nodes(p.outline, p.nodes)};
  if (has_platelets(settings)) {
    blocks.kinds.push_back(platelets(settings, p));
    scene.names.emplace_back("platelets");
    scene.outlines.push_back(
        micro::outline_nodes(platelet_outline(settings), blocks.kinds.back().mesh.nodes));
  }
  blocks.contact = contact_of(p);
  if (scene.flow.walls) {
    blocks.parallel_flow = false;
    blocks.geometry = std::make_shared<const micro::WallGeometry>(*scene.flow.walls);
    blocks.geometry_wall = {p.wall.stiffness, p.wall.range};
  } else {
    blocks.plane_walls = micro::WallPotential{p.wall.stiffness, p.wall.range};
    blocks.height = settings.quantity("micro.channel.height");
    blocks.length = p.cells * red.mesh.rest_area / (p.hematocrit * blocks.height);
    scene.box = {.length = blocks.length, .height = blocks.height, .walls = true};
  }
  blocks.flow = scene.flow.flow;
  blocks.integrator = integrator_of(integrator_name(settings));
  blocks.skin = settings.quantity("micro.list_skin");
  blocks.threads = threads;
  const bool is_explicit = has_explicit_limit(settings);
  blocks.time_step = p.time_step.value_or(is_explicit ? 0.8 * limit.time_step
                                                      : default_shear_per_step /
                                                            blocks.flow->largest_shear_rate());
  if (is_explicit && blocks.time_step > limit.time_step && !p.force && !force) {
    throw micro::ParameterError(
        "micro.time_step exceeds the limit of the explicit scheme; see hemoscale check");
  }
  return scene;
}

std::vector<micro::EnsembleState> pack_blocks(const Settings& settings, const BlockScene& scene) {
  const micro::EnsembleParameters p = build_ensemble_parameters(settings, 1, true);
  const auto seed = static_cast<std::uint64_t>(settings.integer("case.seed"));
  const auto outline = micro::outline_nodes(p.outline, p.nodes);
  std::vector<micro::EnsembleState> states;
  if (settings.text("micro.packing.kind") == "lattice") {
    micro::LatticeOptions options;
    options.cells = static_cast<std::size_t>(p.cells);
    options.tilt = settings.quantity("micro.packing.tilt");
    options.orientation = settings.quantity("micro.packing.orientation");
    options.wall_gap = scene.settings.plane_walls->range;
    if (settings.has("micro.packing.rows")) {
      const auto rows = static_cast<std::size_t>(settings.integer("micro.packing.rows"));
      options.shape = micro::LatticeShape{rows, (options.cells + rows - 1) / rows};
    }
    states.push_back(micro::pack_on_lattice(outline, scene.box, options, seed, 0).state);
  } else {
    micro::RandomPacking packing;
    packing.kind = scene.settings.kinds.front();
    packing.outline = outline;
    packing.contact = contact_of(p);
    packing.wall = *scene.settings.plane_walls;
    packing.cells = static_cast<std::size_t>(p.cells);
    packing.box = scene.box;
    packing.threads = scene.settings.threads;
    states.push_back(micro::pack_at_random(packing, seed, 0));
  }
  const micro::CellRoom room = micro::room_of(scene.box);
  if (scene.settings.kinds.size() > 1) {
    const std::size_t count = platelet_count(settings);
    micro::Occupancy occupancy(room, {.cells = 0, .walls = 0}, p.outline.length);
    occupancy.add(states.front());
    micro::Draws draws(seed, platelet_stream);
    const auto small =
        micro::outline_nodes(platelet_outline(settings), scene.settings.kinds[1].mesh.nodes);
    states.push_back(micro::insert_at_random(
        occupancy, small, count,
        {.left = 0, .right = scene.box.length, .lower = 0, .upper = scene.box.height}, draws));
    if (states.back().cells < count) {
      throw micro::ParameterError(
          "packing: only " + std::to_string(states.back().cells) + " of " + std::to_string(count) +
          " platelets found a place between the red cells; lower micro.platelets.per_cell or "
          "fluid.hematocrit");
    }
  }
  micro::require_sound(states, room);
  return states;
}

}  // namespace hemoscale::coupling
