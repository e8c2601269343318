#include "coupling/scene/feed_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numeric>
#include <utility>

#include "coupling/error.hpp"
#include "micro/cells/outline_checks.hpp"
#include "micro/error.hpp"
#include "micro/snapshot/trajectory_file.hpp"

namespace hemoscale::coupling {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::string prefix_of(const FeedScene& scene, std::size_t kind) {
  return kind == 0 ? std::string() : scene.blocks.names[kind] + ": ";
}

SeriesWriter open(const std::filesystem::path& path, const std::vector<Column>& columns,
                  std::optional<double> restarted_at) {
  return restarted_at ? SeriesWriter::resume(path, columns, *restarted_at)
                      : SeriesWriter::create(path, columns);
}

std::vector<Column> place_columns() {
  return {{"time", "s"}, {"cell", "-"}, {"kind", "-"}, {"x", "m"}, {"y", "m"}};
}

/// What the state of one kind of cells is.
struct Population {
  double inside = 0;       // [-] cells with their centre between the openings
  double area_inside = 0;  // [m^2] of these
  double area_strain = 0;  // [-] largest magnitude
};

Population population(const FeedScene& scene, const micro::EnsembleState& state,
                      const std::vector<micro::Vector<2>>& places, double rest_area) {
  Population all;
  std::vector<micro::Vector<2>> ring(state.nodes);
  for (std::size_t c = 0; c < state.cells; ++c) {
    for (std::size_t i = 0; i < state.nodes; ++i) {
      ring[i] = {state.x[c * state.nodes + i], state.y[c * state.nodes + i]};
    }
    const double area = micro::enclosed_area(ring);
    all.area_strain = std::max(all.area_strain, std::abs(area / rest_area - 1));
    if (!scene.is_inside(places[c])) continue;
    ++all.inside;
    all.area_inside += area;
  }
  return all;
}

void write_walls(const std::filesystem::path& path, const EnsembleFlow& flow) {
  std::vector<std::vector<double>> rows;
  double piece = 0;
  for (const auto& wall : flow.walls->walls()) {
    for (const micro::Vector<2>& x : wall) rows.push_back({piece, x.x(), x.y()});
    ++piece;
  }
  write_table(path, {{"piece", "-"}, {"x", "m"}, {"y", "m"}}, rows);
}

void write_notes(const std::filesystem::path& path, const FeedScene& scene,
                 const std::vector<std::string>& statements) {
  std::ofstream file(path);
  file << "What the tables of this folder are not:\n";
  for (const std::string& statement : statements) file << "  " << statement << "\n";
  file << fmt::format(
      "\nQuantities of {} have plain names; those of other kinds begin with the kind.\n"
      "Cells: all that are there; those between the openings have their centre there, the others\n"
      "are about to enter or to leave. Tube hematocrit: area of the cells between the openings\n"
      "over that of the fluid, {:.6g} m^2. Entered = cells + left, exactly.\n"
      "Shares and discharge hematocrits count cells from the settling time on.\n"
      "Flow share: of an outlet in the flux through the inlet. Cell share: cells that left "
      "through\n"
      "an outlet over all that left. Their quotient is 1 where cells follow the plasma.\n"
      "frames/cells-NNNNNN.h5 holds the outlines at output NNNNNN (from 0), in the order of\n"
      "places.csv; .xdmf beside them is for ParaView.\n",
      scene.blocks.names.front(), scene.fluid_area);
  file.close();
  if (!file) {
    throw EnvironmentError(fmt::format(
        "{}: not written; the disk may be full or the folder closed to writing; make room",
        path.string()));
  }
}

}  // namespace

void FeedTally::begin(double time, const std::vector<micro::FeedCounts>& counts) {
  has_begun = true;
  since = time;
  before.clear();
  for (const micro::FeedCounts& kind : counts) before.push_back(kind.left);
}

micro::Snapshot FeedTally::snapshot() const {
  micro::Snapshot s;
  s.reals["tally.since"] = {since};
  auto& counts = s.integers["tally.before"];
  for (const auto& kind : before) {
    for (const std::uint64_t n : kind) counts.push_back(static_cast<std::int64_t>(n));
  }
  return s;
}

void FeedTally::restore(const micro::Snapshot& snapshot, std::size_t kinds, std::size_t outlets) {
  const auto reals = snapshot.reals.find("tally.since");
  const auto integers = snapshot.integers.find("tally.before");
  const bool is_there = reals != snapshot.reals.end() && reals->second.size() == 1 &&
                        integers != snapshot.integers.end();
  if (!is_there || (!integers->second.empty() && integers->second.size() != kinds * outlets)) {
    throw micro::ParameterError(
        fmt::format("snapshot: it holds no counts of {} kinds of cells at {} outlets; restore it "
                    "into the case that wrote it",
                    kinds, outlets));
  }
  has_begun = !integers->second.empty();
  since = reals->second.front();
  before.clear();
  for (std::size_t n = 0; n < integers->second.size(); ++n) {
    if (n % outlets == 0) before.emplace_back();
    before.back().push_back(static_cast<std::uint64_t>(integers->second[n]));
  }
}

FeedDivision divide(const FeedScene& scene, const FeedTally& tally,
                    const std::vector<micro::FeedCounts>& counts, std::size_t kind, double time) {
  const std::size_t outlets = scene.flow_shares.size();
  FeedDivision d;
  d.counted.assign(outlets, 0);
  for (std::size_t o = 0; o < outlets && tally.has_begun; ++o) {
    d.counted[o] = counts[kind].left[o] - tally.before[kind][o];
  }
  const auto all =
      static_cast<double>(std::accumulate(d.counted.begin(), d.counted.end(), std::uint64_t{0}));
  const double cell_area = scene.blocks.settings.kinds[kind].mesh.rest_area;
  const double blood = scene.inflow * (time - tally.since);  // [m^2] that has passed
  for (std::size_t o = 0; o < outlets; ++o) {
    const auto n = static_cast<double>(d.counted[o]);
    const double share = all > 0 ? n / all : nan;
    d.cell_share.push_back(share);
    d.standard_error.push_back(all > 0 ? std::sqrt(share * (1 - share) / all) : nan);
    d.partition.push_back(share / scene.flow_shares[o]);
    d.discharge.push_back(
        tally.has_begun && blood > 0 ? n * cell_area / (blood * scene.flow_shares[o]) : nan);
  }
  return d;
}

FeedResults::FeedResults(std::filesystem::path results, const FeedScene& scene, bool with_frames,
                         const std::vector<std::string>& statements,
                         std::optional<double> restarted_at)
    : results_(std::move(results)),
      scene_(scene),
      with_frames_(with_frames),
      series_(open(results_ / "series.csv", columns(), restarted_at)),
      places_(open(results_ / "places.csv", place_columns(), restarted_at)) {
  write_walls(results_ / "walls.csv", scene_.blocks.flow);
  write_notes(results_ / "tables.txt", scene_, statements);
  if (!with_frames_) return;
  std::error_code failure;
  std::filesystem::create_directories(results_ / "frames", failure);
  if (failure) {
    throw EnvironmentError(
        fmt::format("{}: cannot be made: {}", (results_ / "frames").string(), failure.message()));
  }
}

std::vector<Column> FeedResults::columns() const {
  std::vector<Column> all = {{"time", "s"}};
  const auto add = [&](const std::string& name) { all.push_back({name, "-"}); };
  for (const micro::Opening& o : scene_.plan.outlets) add("flow share of " + o.name);
  for (std::size_t k = 0; k < scene_.blocks.names.size(); ++k) {
    const std::string prefix = prefix_of(scene_, k);
    for (const char* name : {"cells", "cells between the openings", "tube hematocrit", "entered",
                             "waiting", "largest area strain"}) {
      add(prefix + name);
    }
    for (const char* name : {"left through ", "cell share of ", "cell share over flow share of ",
                             "discharge hematocrit of "}) {
      for (const micro::Opening& o : scene_.plan.outlets) add(prefix + name + o.name);
    }
  }
  return all;
}

std::vector<double> FeedResults::row(const micro::BlockEnsemble& ensemble,
                                     const micro::CellFeed& feed, const FeedTally& tally) const {
  const auto states = ensemble.states();
  const auto frames = ensemble.frames();
  std::vector<double> row = {ensemble.time()};
  row.insert(row.end(), scene_.flow_shares.begin(), scene_.flow_shares.end());
  for (std::size_t k = 0; k < states.size(); ++k) {
    const double rest_area = scene_.blocks.settings.kinds[k].mesh.rest_area;
    const Population there = population(scene_, states[k], frames[k], rest_area);
    const micro::FeedCounts& counts = feed.counts()[k];
    row.insert(row.end(),
               {static_cast<double>(states[k].cells), there.inside,
                there.area_inside / scene_.fluid_area, static_cast<double>(counts.entered),
                static_cast<double>(counts.waiting), there.area_strain});
    for (const std::uint64_t n : counts.left) row.push_back(static_cast<double>(n));
    const FeedDivision d = divide(scene_, tally, feed.counts(), k, ensemble.time());
    for (const auto* part : {&d.cell_share, &d.partition, &d.discharge}) {
      row.insert(row.end(), part->begin(), part->end());
    }
  }
  return row;
}

void FeedResults::append(std::int64_t number, const micro::BlockEnsemble& ensemble,
                         const micro::CellFeed& feed, const FeedTally& tally) {
  series_.append(row(ensemble, feed, tally));
  append_places(ensemble);
  if (with_frames_) write_frame(number, ensemble);
}

void FeedResults::append_places(const micro::BlockEnsemble& ensemble) {
  const auto frames = ensemble.frames();
  const auto ids = ensemble.identities();
  for (std::size_t k = 0; k < frames.size(); ++k) {
    for (std::size_t c = 0; c < frames[k].size(); ++c) {
      const std::vector<double> row = {ensemble.time(), static_cast<double>(ids[k][c]),
                                       static_cast<double>(k), frames[k][c].x(), frames[k][c].y()};
      places_.append(row);
    }
  }
}

void FeedResults::write_frame(std::int64_t number, const micro::BlockEnsemble& ensemble) const {
  micro::TrajectoryLayout layout;
  layout.creator_version = program_version();
  layout.single_precision = true;
  std::vector<double> positions;
  for (const micro::EnsembleState& state : ensemble.states()) {
    layout.nodes_per_ring.insert(layout.nodes_per_ring.end(), state.cells,
                                 static_cast<std::int64_t>(state.nodes));
    for (std::size_t i = 0; i < state.x.size(); ++i) {
      positions.insert(positions.end(), {state.x[i], state.y[i]});
    }
  }
  if (positions.empty()) return;  // an empty vessel has no outlines
  micro::Vector<2> extent = micro::Vector<2>::Zero();
  for (const auto& wall : scene_.blocks.flow.walls->walls()) {
    for (const micro::Vector<2>& x : wall) extent = extent.cwiseMax(x.cwiseAbs());
  }
  layout.box_edges = {extent.x(), extent.y()};
  layout.is_periodic = {false, false};
  auto writer = micro::TrajectoryWriter::create(
      results_ / "frames" / fmt::format("cells-{:06d}.h5", number), layout);
  micro::TrajectoryFrame frame;
  frame.step = ensemble.step();
  frame.time = ensemble.time();
  frame.positions = positions;
  writer.append(frame);
}

std::vector<Figure> FeedResults::figures(const micro::BlockEnsemble& ensemble,
                                         const micro::CellFeed& feed,
                                         const FeedTally& tally) const {
  std::vector<Figure> figures;
  const std::vector<Column> names = columns();
  const std::vector<double> values = row(ensemble, feed, tally);
  for (std::size_t n = 1; n < names.size(); ++n) {
    figures.push_back({names[n].name, values[n], names[n].unit});
  }
  for (std::size_t k = 0; k < scene_.blocks.names.size(); ++k) {
    const FeedDivision d = divide(scene_, tally, feed.counts(), k, ensemble.time());
    for (std::size_t o = 0; o < d.counted.size(); ++o) {
      const std::string& name = scene_.plan.outlets[o].name;
      const std::string prefix = prefix_of(scene_, k);
      figures.push_back(
          {prefix + "cells counted at " + name, static_cast<double>(d.counted[o]), "-"});
      for (Figure& figure : figures) {
        if (figure.name == prefix + "cell share of " + name) {
          figure.standard_error = d.standard_error[o];
        }
        if (figure.name == prefix + "cell share over flow share of " + name) {
          figure.standard_error = d.standard_error[o] / scene_.flow_shares[o];
        }
      }
    }
  }
  return figures;
}

}  // namespace hemoscale::coupling
