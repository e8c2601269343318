#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <optional>

#include "coupling/error.hpp"
#include "coupling/report/identity.hpp"
#include "coupling/report/progress.hpp"
#include "coupling/report/series.hpp"
#include "coupling/report/summary.hpp"
#include "coupling/report/timings.hpp"
#include "coupling/scene/cell_results.hpp"
#include "coupling/scene/cell_scene.hpp"
#include "coupling/scene/coupled_run.hpp"
#include "coupling/scene/hosts.hpp"
#include "micro/cells/ring_strain.hpp"
#include "micro/error.hpp"
#include "micro/snapshot/checkpoint.hpp"

namespace hemoscale::coupling {

namespace {

/// Threads that pay: any number gives the same bits.
int useful_threads(const CellScene& scene) {
  constexpr std::size_t cells_per_thread = 4;
  return std::clamp(static_cast<int>(scene.cells.size() / cells_per_thread), 1,
                    available_threads());
}

/// One scene of cells in plasma from its settings to its results.
class CellRun {
 public:
  explicit CellRun(const PreparedRun& run)
      : run_(run),
        identity_(state_settings(run.settings.as_text(), settings_free_at_restart())),
        scene_(build_cell_scene(run.settings, run.force)),
        model_((omp_set_num_threads(useful_threads(scene_)),
                build_cells_in_plasma(scene_, run.settings, run.force))),
        duration_(run.settings.quantity("micro.duration")),
        interval_(run.settings.quantity("micro.output_interval")),
        history_(cell_columns(scene_)) {}

  void execute() {
    for (const std::string& warning : cell_warnings(scene_, run_.settings)) warn(warning);
    if (run_.restart) restore();
    open_files();
    if (done_ == 0) record();
    Progress progress("time [s]", done_, duration_);
    auto last_checkpoint = Clock::now();
    const double checkpoint_interval = run_.settings.quantity("output.checkpoint_interval");
    while (done_ < duration_ * (1 - 1e-12)) {
      advance();
      const auto scope = timings_.measure("results");
      record();
      progress.update(done_);
      const std::chrono::duration<double> since = Clock::now() - last_checkpoint;
      if (since.count() < checkpoint_interval) continue;
      write_checkpoint();
      last_checkpoint = Clock::now();
    }
    progress.finish();
    finish("finished");
  }

 private:
  using Clock = std::chrono::steady_clock;

  void warn(const std::string& warning) {
    warnings_.push_back(warning);
    run_.log("warning: " + warning);
  }

  void restore() {
    const micro::RestoredCheckpoint restored = micro::restore_checkpoint(run_.results, identity_);
    model_.restore(restored.checkpoint.slots.at("model"));
    done_ = restored.checkpoint.time;
    smallest_gap_ = restored.checkpoint.slots.at("run").reals.at("smallest_gap").at(0);
    for (const std::string& warning : restored.warnings) warn(warning);
    run_.log(fmt::format("restart from {}: {:.6g} s done", restored.path.string(), done_));
  }

  void open_files() {
    const auto path = run_.results / "series.csv";
    const std::vector<Column> columns = cell_columns(scene_);
    const bool with_cells = run_.settings.boolean("output.trajectory");
    const auto cells = run_.results / "cells.csv";
    if (run_.restart) {
      series_.emplace(SeriesWriter::resume(path, columns, done_));
      for (const auto& row : read_table(path).rows) history_.append(row);
      if (with_cells) cells_.emplace(SeriesWriter::resume(cells, node_columns(), done_));
    } else {
      series_.emplace(SeriesWriter::create(path, columns));
      if (with_cells) cells_.emplace(SeriesWriter::create(cells, node_columns()));
    }
    write_walls(run_.results / "walls.csv", scene_);
  }

  void advance() {
    const auto scope = timings_.measure("micro model");
    const double next = std::min(duration_, interval_ * (std::round(done_ / interval_) + 1));
    try {
      model_.advance_by(next - done_);
    } catch (const micro::NumericalError& error) {
      // The cells are those of the last good step.
      done_ = model_.time();
      warnings_.push_back(error.what());
      finish(fmt::format("stopped: {}", error.what()));
      throw;
    }
    done_ = next;
  }

  void record() {
    std::vector<double> row = cell_row(scene_, model_);
    history_.unwrap(row);
    row.front() = done_;  // without the rounding of many steps, which a restart would stumble over
    series_->append(row);
    history_.append(row);
    for (std::size_t c = 0; c < scene_.cells.size(); ++c) {
      smallest_gap_ =
          std::min(smallest_gap_, history_[fmt::format("cell {}: smallest gap", c)].back());
    }
    if (!cells_) return;
    for (std::vector<double> node : node_rows(model_)) {
      node.front() = done_;
      cells_->append(node);
    }
  }

  void write_checkpoint() {
    micro::Checkpoint checkpoint;
    checkpoint.number = std::llround(done_ / interval_);
    checkpoint.time = done_;
    checkpoint.identity = identity_;
    checkpoint.texts["version"] = program_version();
    checkpoint.slots["model"] = model_.snapshot();
    checkpoint.slots["run"].reals["smallest_gap"] = {smallest_gap_};
    micro::write_checkpoint(run_.results, checkpoint);
  }

  void finish(const std::string& outcome) {
    const auto scope = timings_.measure("results");
    write_checkpoint();
    write_modes(run_.results / "modes.csv", model_);
    write_flow(run_.results / "flow.csv", scene_, model_);
    warn_of_gaps();
    Summary summary;
    summary.title = run_.settings.text("case.name");
    summary.outcome = outcome;
    summary.version = program_version();
    summary.seed = static_cast<std::uint64_t>(run_.settings.integer("case.seed"));
    summary.identity = identity_hash(identity_);
    summary.figures = cell_figures(run_.settings, scene_, model_, history_);
    if (std::isfinite(smallest_gap_)) {
      summary.figures.push_back({"smallest gap of the run", smallest_gap_, "m"});
    }
    summary.settings = run_.settings.as_text();
    summary.host = this_host(omp_get_max_threads(), 1);
    summary.ledger = ledger();
    summary.statements = cell_statements(run_.settings);
    timings_.add("process", process_timing());
    summary.timings = timings_.parts();
    const double cpu = process_timing().cpu;
    summary.figures.push_back(
        {"CPU time per cell", cpu / static_cast<double>(scene_.cells.size()), "s"});
    summary.warnings = warnings_;
    write_summary(run_.results / "summary.json", summary);
  }

  /// Films thinner than the distance of the nodes are not resolved.
  void warn_of_gaps() {
    const double nodes = scene_.cells.front().membrane->mesh().rest_perimeter /
                         static_cast<double>(scene_.cells.front().positions.size());
    const double resolved = scene_.is_unbounded() ? nodes : scene_.plasma.domain.spacing;
    if (!(smallest_gap_ < resolved)) return;
    warn(
        fmt::format("a gap of {:.4g} m between cells, or a cell and a wall, is below the distance "
                    "of the nodes, {:.4g} m: its lubrication is not resolved; reduce "
                    "micro.plasma.spacing below the gap, and give the cells more nodes",
                    smallest_gap_, resolved));
  }

  std::vector<micro::LedgerEntry> ledger() const {
    double area = 0;
    double perimeter = 0;
    for (const micro::Cell& cell : model_.cells()) {
      const micro::RingStrain strain = micro::measure_strain(cell.positions, cell.membrane->mesh());
      area = std::max(area, std::abs(strain.area_error));
      perimeter = std::max(perimeter, std::abs(strain.perimeter_error));
    }
    return {
        {.name = "area of each cell", .deviation = area, .warn_above = 1e-3, .stop_above = 0.05},
        {.name = "perimeter of each cell",
         .deviation = perimeter,
         .warn_above = 0.05,
         .stop_above = 10}};
  }

  const PreparedRun& run_;
  std::map<std::string, std::string> identity_;
  CellScene scene_;
  micro::CellsInPlasma model_;
  double duration_;                                                // [s]
  double interval_;                                                // [s] between rows
  double done_ = 0;                                                // [s]
  double smallest_gap_ = std::numeric_limits<double>::infinity();  // [m]
  Timings timings_;
  std::vector<std::string> warnings_;
  CellHistory history_;
  std::optional<SeriesWriter> series_;
  std::optional<SeriesWriter> cells_;
};

}  // namespace

void run_cells_in_plasma(const PreparedRun& run) {
  CellRun(run).execute();
}

}  // namespace hemoscale::coupling
