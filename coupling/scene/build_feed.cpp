#include "coupling/scene/build_feed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "coupling/error.hpp"

namespace hemoscale::coupling {

namespace {

CaseError fault(const Settings& settings, const std::string& key, const std::string& message) {
  const Location place = settings.location(key);
  return CaseError({{place.file, place.line, place.column, key, message}});
}

/// Half the thickness of an outline [m].
double half_thickness(const std::vector<micro::Vector<2>>& outline) {
  micro::Vector<2> extent = micro::Vector<2>::Zero();
  for (const micro::Vector<2>& node : outline) extent = extent.cwiseMax(node.cwiseAbs());
  return extent.minCoeff();
}

double twice_sector(const micro::Vector<2>& a, const micro::Vector<2>& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Area between walls and openings [m^2], by the theorem of Green: the fluid is on the left of all
/// of them. Walls are continued beyond the openings; the strips there are rectangles.
double area_of(const EnsembleFlow& flow) {
  double area = 0;
  for (const auto& wall : flow.walls->walls()) {
    for (std::size_t k = 0; k + 1 < wall.size(); ++k) {
      area += 0.5 * twice_sector(wall[k], wall[k + 1]);
    }
  }
  for (const micro::Opening& opening : flow.openings) {
    const micro::Vector<2> beyond = -flow.overhang * opening.inward();
    area += 0.5 * twice_sector(opening.a + beyond, opening.b + beyond);
    area -= flow.overhang * opening.length();
  }
  return area;
}

micro::FeedPlan plan_of(const Settings& settings, const BlockScene& scene) {
  micro::FeedPlan plan;
  const micro::Opening& inlet = scene.flow.openings.front();
  const double wall_range = settings.quantity("micro.wall.range");
  const double hematocrit = settings.quantity("fluid.hematocrit");
  const double red_area = scene.settings.kinds.front().mesh.rest_area;
  for (std::size_t k = 0; k < scene.settings.kinds.size(); ++k) {
    micro::FedKind fed;
    fed.kind = k;
    fed.outline = scene.outlines[k];
    fed.inlet = inlet;
    fed.feed.hematocrit = hematocrit;
    if (k > 0) {
      fed.feed.hematocrit *= settings.quantity("micro.platelets.per_cell") *
                             scene.settings.kinds[k].mesh.rest_area / red_area;
    }
    // A centre cannot come nearer to a wall, however the cell is turned. The layer is that of red
    // cells: platelets are found everywhere.
    fed.feed.clearance = wall_range + half_thickness(fed.outline);
    if (k == 0) fed.feed.clearance += settings.quantity("micro.flow.cell_free_layer");
    if (2 * fed.feed.clearance >= inlet.length()) {
      throw fault(settings, "micro.flow.inlet",
                  fmt::format("\"{}\" is {:.4g} m wide; {} have their centres {:.4g} m from its "
                              "ends or more, so that none can enter; widen it, or reduce "
                              "micro.flow.cell_free_layer or micro.wall.range",
                              inlet.name, inlet.length(), scene.names[k], fed.feed.clearance));
    }
    plan.inlets.push_back(std::move(fed));
  }
  plan.outlets.assign(scene.flow.openings.begin() + 1, scene.flow.openings.end());
  plan.overhang = scene.flow.overhang;
  plan.room.geometry = scene.settings.geometry;
  plan.clearance = {.cells = settings.quantity("micro.contact.rest_distance"), .walls = wall_range};
  return plan;
}

}  // namespace

bool FeedScene::is_inside(const micro::Vector<2>& place) const {
  const auto& openings = blocks.flow.openings;
  return std::none_of(openings.begin(), openings.end(), [&](const micro::Opening& opening) {
    return micro::has_left(opening, place, plan.overhang);
  });
}

std::vector<std::pair<std::string, std::string>> feed_faults(const Settings& settings) {
  std::vector<std::pair<std::string, std::string>> faults;
  const std::string& kind = settings.text("micro.flow.kind");
  if (kind != "openfoam") {
    faults.emplace_back(
        "micro.flow.kind",
        fmt::format("\"{}\" has no inlet and outlets, which micro.domain = \"geometry\" needs; "
                    "choose \"openfoam\", or micro.domain = \"channel\"",
                    kind));
    return faults;  // the other keys do not apply
  }
  if (!runs_on_vectors(settings)) {
    faults.emplace_back("micro.integrator",
                        "\"explicit-reference\" knows no walls of any shape, and no cells that "
                        "come and go; leave the key out, or choose \"constant-operator-2\"");
  }
  const double radius = 0.5 * settings.quantity("micro.shape.length");
  const double overhang = settings.quantity("micro.flow.overhang");
  if (overhang < radius) {
    faults.emplace_back(
        "micro.flow.overhang",
        fmt::format("{:.4g} m is less than half a cell, {:.4g} m; a cell that enters or leaves "
                    "would reach beyond the end of the walls; give about a cell and a half",
                    overhang, radius));
  }
  const double settling = settings.quantity("micro.flow.settling_time");
  const double duration = settings.quantity("micro.duration");
  if (settling >= duration) {
    faults.emplace_back("micro.flow.settling_time",
                        fmt::format("{:.4g} s leaves nothing of micro.duration, {:.4g} s, for "
                                    "counting cells; shorten it, or lengthen the run",
                                    settling, duration));
  }
  return faults;
}

FeedScene build_feed(const Settings& settings, int threads, bool force,
                     const std::filesystem::path& case_folder,
                     const std::filesystem::path& results) {
  FeedScene scene;
  scene.blocks = build_blocks(settings, threads, force, case_folder, results);
  const EnsembleFlow& flow = scene.blocks.flow;
  scene.plan = plan_of(settings, scene.blocks);
  const double way = flow.flow->largest_speed() * scene.blocks.settings.time_step;
  // What CellFeed asks for, with the key.
  if (way > flow.overhang / 16) {
    throw fault(settings, "micro.time_step",
                fmt::format("{:.4g} s: cells would move by up to {:.4g} m in a step, and at most a "
                            "sixteenth of micro.flow.overhang, {:.4g} m, is admissible; reduce it",
                            scene.blocks.settings.time_step, way, flow.overhang / 16));
  }
  scene.inflow = micro::volume_flux(flow.openings.front(), *flow.flow, 0);
  for (const micro::Opening& outlet : scene.plan.outlets) {
    scene.flow_shares.push_back(-micro::volume_flux(outlet, *flow.flow, 0) / scene.inflow);
  }
  scene.fluid_area = area_of(flow);
  return scene;
}

}  // namespace hemoscale::coupling
