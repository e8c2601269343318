#include "coupling/scene/build_blocks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "coupling/error.hpp"
#include "coupling/report/series.hpp"
#include "coupling/scene/ensemble_kinds.hpp"
#include "micro/ensemble/blocks/block_limits.hpp"
#include "micro/ensemble/packing/insertion.hpp"
#include "micro/ensemble/packing/lattice_packing.hpp"
#include "micro/ensemble/packing/random_packing.hpp"
#include "micro/ensemble/packing/state_checks.hpp"
#include "micro/error.hpp"

namespace hemoscale::coupling {

namespace {

using micro::blocks::BlockSettings;
using micro::blocks::KindSettings;

// Platelets get random numbers of their own.
constexpr std::uint64_t platelet_stream = 1U << 20U;

// Share of the limit that is taken unless a step is given.
constexpr double default_share = 0.8;

double default_step(const Settings& settings, const BlockSettings& blocks) {
  const double most = default_share * micro::blocks::block_limit(blocks).time_step;
  if (has_explicit_limit(settings)) return most;
  return std::min(most, micro::blocks::default_step(*blocks.flow));
}

/// Contacts that keep cells apart while they are packed: a polynomial as stiff and as wide.
micro::PairPotential packing_contact(const micro::ContactLaw& law) {
  if (const auto* polynomial = std::get_if<micro::PairPotential>(&law)) return *polynomial;
  return micro::make_pair_potential(micro::stiffness_at_rest(law), micro::rest_distance_of(law),
                                    micro::cutoff_of(law), 0);
}

/// Packing is overdamped, with isotropic drag.
KindSettings packed_kind(KindSettings kind) {
  kind.normal_drag = 1;
  kind.node_mass = 0;
  kind.momentum_drag = 0;
  return kind;
}

micro::EnsembleState pack_lattice(const Settings& settings, const BlockScene& scene,
                                  std::uint64_t seed) {
  micro::LatticeOptions options;
  options.cells = static_cast<std::size_t>(settings.integer("micro.cells"));
  options.tilt = settings.quantity("micro.packing.tilt");
  options.orientation = settings.quantity("micro.packing.orientation");
  options.wall_gap = scene.settings.plane_walls->range;
  if (settings.has("micro.packing.rows")) {
    const auto rows = static_cast<std::size_t>(settings.integer("micro.packing.rows"));
    options.shape = micro::LatticeShape{rows, (options.cells + rows - 1) / rows};
  }
  return micro::pack_on_lattice(scene.outlines.front(), scene.box, options, seed, 0).state;
}

/// Cells where a table puts them; whether they can be there is checked afterwards.
micro::EnsembleState place_by_table(const Settings& settings, const BlockScene& scene) {
  const std::string key = "micro.packing.table";
  const Location at = settings.location(key);
  std::filesystem::path path = settings.text(key);
  if (path.is_relative()) path = std::filesystem::path(at.file).parent_path() / path;
  const Table table = read_table(path);
  const auto cells = static_cast<std::size_t>(settings.integer("micro.cells"));
  const bool has_columns = table.columns.size() == 3 && table.columns[0].unit == "m" &&
                           table.columns[1].unit == "m" && table.columns[2].unit == "rad";
  if (!has_columns || table.rows.size() != cells) {
    throw CaseError({{at.file, at.line, at.column, key,
                      fmt::format("{} has {} columns and {} rows; three columns, \"x [m],y "
                                  "[m],angle [rad]\", are needed, and a row for each of the {} "
                                  "cells (micro.cells)",
                                  path.string(), table.columns.size(), table.rows.size(), cells)}});
  }
  micro::EnsembleState state;
  for (const std::vector<double>& row : table.rows) {
    micro::append_cell(micro::placed(scene.outlines.front(), {row[0], row[1]}, row[2]), state);
  }
  return state;
}

micro::EnsembleState pack_red_cells(const Settings& settings, const BlockScene& scene,
                                    std::uint64_t seed) {
  const std::string& kind = settings.text("micro.packing.kind");
  if (kind == "lattice") return pack_lattice(settings, scene, seed);
  if (kind == "table") return place_by_table(settings, scene);
  micro::RandomPacking packing;
  packing.kind = packed_kind(scene.settings.kinds.front());
  packing.outline = scene.outlines.front();
  packing.contact = packing_contact(scene.settings.contact);
  packing.wall = *scene.settings.plane_walls;
  packing.cells = static_cast<std::size_t>(settings.integer("micro.cells"));
  packing.box = scene.box;
  packing.threads = scene.settings.threads;
  return micro::pack_at_random(packing, seed, 0);
}

micro::EnsembleState place_platelets(const Settings& settings, const BlockScene& scene,
                                     const micro::EnsembleState& red, std::uint64_t seed) {
  const std::size_t count = platelet_count(settings);
  micro::Occupancy occupancy(micro::room_of(scene.box), {.cells = 0, .walls = 0},
                             settings.quantity("micro.shape.length"));
  occupancy.add(red);
  micro::Draws draws(seed, platelet_stream);
  micro::EnsembleState state = micro::insert_at_random(
      occupancy, scene.outlines[1], count,
      {.left = 0, .right = scene.box.length, .lower = 0, .upper = scene.box.height}, draws);
  if (state.cells < count) {
    throw micro::ParameterError(
        fmt::format("packing: only {} of {} platelets found a place between the red cells; lower "
                    "micro.platelets.per_cell or fluid.hematocrit",
                    state.cells, count));
  }
  return state;
}

}  // namespace

bool runs_on_vectors(const Settings& settings) {
  return settings.text("micro.model") == "ensemble" &&
         integrator_name(settings) != "explicit-reference";
}

bool has_explicit_limit(const Settings& settings) {
  const std::string name = integrator_name(settings);
  return name == "explicit-reference" || name == "explicit" || name == "inertial" ||
         name == "chebyshev";
}

BlockScene build_blocks(const Settings& settings, int threads, bool force,
                        const std::filesystem::path& case_folder,
                        const std::filesystem::path& results) {
  BlockScene scene;
  scene.flow = build_ensemble_flow(settings, case_folder, results);
  scene.precision = settings.text("micro.precision") == "double" ? micro::Precision::twofold
                                                                 : micro::Precision::single;
  EnsembleKinds kinds = build_kinds(settings);
  scene.names = std::move(kinds.names);
  scene.outlines = std::move(kinds.outlines);
  BlockSettings& blocks = scene.settings;
  blocks.kinds = std::move(kinds.kinds);
  const micro::RingMesh& red = blocks.kinds.front().mesh;
  blocks.contact = contact_law(settings);
  const micro::WallPotential wall{settings.quantity("micro.wall.stiffness"),
                                  settings.quantity("micro.wall.range")};
  if (scene.flow.walls) {
    blocks.parallel_flow = false;
    blocks.geometry = std::make_shared<const micro::WallGeometry>(*scene.flow.walls);
    blocks.geometry_wall = wall;
  } else {
    blocks.plane_walls = wall;
    blocks.height = settings.quantity("micro.channel.height");
    blocks.length = static_cast<double>(settings.integer("micro.cells")) * red.rest_area /
                    (settings.quantity("fluid.hematocrit") * blocks.height);
    scene.box = {.length = blocks.length, .height = blocks.height, .walls = true};
  }
  blocks.flow = scene.flow.flow;
  blocks.integrator = block_integrator(settings);
  if (settings.has("micro.chebyshev.stages")) {
    blocks.stages = static_cast<int>(settings.integer("micro.chebyshev.stages"));
  }
  blocks.migration = build_migration(settings, red, blocks.flow->largest_shear_rate());
  blocks.skin = settings.quantity("micro.list_skin");
  blocks.threads = threads;
  blocks.force = force || settings.boolean("micro.force");
  blocks.time_step = settings.has("micro.time_step") ? settings.quantity("micro.time_step")
                                                     : default_step(settings, blocks);
  return scene;
}

std::vector<micro::EnsembleState> pack_blocks(const Settings& settings, const BlockScene& scene) {
  const auto seed = static_cast<std::uint64_t>(settings.integer("case.seed"));
  const auto fault = [&](const char* key, const micro::ParameterError& error) {
    const Location place = settings.location(key);
    return CaseError({{place.file, place.line, place.column, key, error.what()}});
  };
  std::vector<micro::EnsembleState> states;
  try {
    states.push_back(pack_red_cells(settings, scene, seed));
  } catch (const micro::ParameterError& error) {
    throw fault("micro.packing.kind", error);
  }
  try {
    if (scene.settings.kinds.size() > 1) {
      states.push_back(place_platelets(settings, scene, states.front(), seed));
    }
  } catch (const micro::ParameterError& error) {
    throw fault("micro.platelets.per_cell", error);
  }
  try {
    micro::require_sound(states, micro::room_of(scene.box));
  } catch (const micro::ParameterError& error) {
    const bool by_table = settings.has("micro.packing.table");
    throw fault(by_table ? "micro.packing.table" : "micro.packing.kind", error);
  }
  return states;
}

}  // namespace hemoscale::coupling
