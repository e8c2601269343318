#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>

#include "coupling/error.hpp"
#include "coupling/report/identity.hpp"
#include "coupling/report/progress.hpp"
#include "coupling/report/series.hpp"
#include "coupling/report/summary.hpp"
#include "coupling/report/timings.hpp"
#include "coupling/scene/coupled_run.hpp"
#include "coupling/scene/hosts.hpp"
#include "coupling/scene/plasma_results.hpp"
#include "coupling/scene/plasma_scene.hpp"
#include "coupling/scene/trajectory_output.hpp"
#include "micro/error.hpp"
#include "micro/snapshot/checkpoint.hpp"

namespace hemoscale::coupling {

namespace {

/// Threads that pay: with fewer particles than this per thread, they wait for each other more than
/// they compute. Any number gives the same bits.
int useful_threads(std::size_t particles) {
  constexpr std::size_t particles_per_thread = 10000;
  return std::clamp(static_cast<int>(particles / particles_per_thread), 1, available_threads());
}

/// One plasma scene from its settings to its results. Files are the root's.
template <int dim>
class PlasmaRun {
 public:
  PlasmaRun(const PreparedRun& run, const std::shared_ptr<const micro::Communicator>& ranks)
      : run_(run),
        ranks_(ranks),
        identity_(state_settings(run.settings.as_text(), settings_free_at_restart())),
        scene_(build_plasma_scene<dim>(run.settings, run.force)),
        model_(scene_.domain, scene_.fluid, scene_.method, scene_.time_step, scene_.sections,
               ranks),
        duration_(run.settings.quantity("micro.duration")),
        interval_(run.settings.quantity("micro.output_interval")) {
    omp_set_num_threads(useful_threads(scene_.domain.particles.size()));
    first_energy_ = model_.observe().kinetic_energy;
  }

  void execute() {
    if (run_.restart) restore();
    begin_files();
    Progress progress("time [s]", done_, duration_);
    auto last_checkpoint = Clock::now();
    const double checkpoint_interval = run_.settings.quantity("output.checkpoint_interval");
    while (done_ < duration_ * (1 - 1e-12)) {
      advance();
      const auto scope = timings_.measure("results");
      record();
      if (ranks_->is_root()) progress.update(done_);
      // By the clock of the root alone: the others have no part in it.
      on_root([&] {
        const std::chrono::duration<double> since = Clock::now() - last_checkpoint;
        if (since.count() < checkpoint_interval) return;
        write_checkpoint();
        last_checkpoint = Clock::now();
      });
    }
    if (ranks_->is_root()) progress.finish();
    finish("finished");
  }

 private:
  using Clock = std::chrono::steady_clock;

  void restore() {
    const micro::RestoredCheckpoint restored = micro::restore_checkpoint(run_.results, identity_);
    model_.restore(restored.checkpoint.slots.at("model"));
    done_ = restored.checkpoint.time;
    first_energy_ = restored.checkpoint.slots.at("run").reals.at("first_energy").at(0);
    warnings_ = restored.warnings;
    for (const std::string& warning : restored.warnings) run_.log("warning: " + warning);
    run_.log(fmt::format("restart from {}: {:.6g} s done", restored.path.string(), done_));
  }

  /// Files are the root's; if it fails, all ranks fail.
  template <typename Action>
  void on_root(const Action& act) {
    std::string failure;
    if (ranks_->is_root()) {
      if (ranks_->size() == 1) return act();  // the error keeps its type
      try {
        act();
      } catch (const std::exception& error) {
        failure = error.what();
      }
    }
    ranks_->agree(failure);
  }

  void begin_files() {
    on_root([&] { open_files(); });
  }

  void open_files() {
    const auto path = run_.results / "series.csv";
    const std::vector<Column> columns = plasma_columns(scene_);
    if (run_.restart) {
      series_.emplace(SeriesWriter::resume(path, columns, done_));
    } else {
      series_.emplace(SeriesWriter::create(path, columns));
    }
    if (run_.settings.boolean("output.trajectory")) {
      trajectory_.emplace(run_.results / "trajectory.h5");
    }
  }

  void advance() {
    const auto scope = timings_.measure("micro model");
    const double next = std::min(duration_, interval_ * (std::round(done_ / interval_) + 1));
    try {
      model_.advance_by(next - done_);
    } catch (const micro::NumericalError& error) {
      // The particles are those of the last good step.
      done_ = model_.time();
      warnings_.push_back(error.what());
      finish(fmt::format("stopped: {}", error.what()));
      throw;
    }
    done_ = next;
  }

  void record() {
    std::vector<double> row = plasma_row(scene_, model_);
    row.front() = done_;  // without the rounding of many steps, which a restart would stumble over
    on_root([&] {
      series_->append(row);
      if (!trajectory_) return;
      trajectory_->append(model_.particles(), scene_.domain.box, std::llround(done_ / interval_),
                          model_.time());
    });
  }

  void write_checkpoint() {
    micro::Checkpoint checkpoint;
    checkpoint.number = std::llround(done_ / interval_);
    checkpoint.time = done_;
    checkpoint.identity = identity_;
    checkpoint.texts["version"] = program_version();
    checkpoint.slots["model"] = model_.snapshot();
    checkpoint.slots["run"].reals["first_energy"] = {first_energy_};
    micro::write_checkpoint(run_.results, checkpoint);
  }

  void finish(const std::string& outcome) {
    const auto scope = timings_.measure("results");
    // Figures are measured by all ranks together.
    const std::vector<Figure> figures =
        plasma_figures(run_.settings, scene_, model_, first_energy_);
    const std::vector<micro::LedgerEntry> entries = ledger();
    on_root([&] { write_results(outcome, figures, entries); });
  }

  void write_results(const std::string& outcome, const std::vector<Figure>& figures,
                     const std::vector<micro::LedgerEntry>& entries) {
    write_checkpoint();
    write_particles(run_.results / "particles.csv", model_.particles());
    if (trajectory_) finish_trajectories(run_.results);
    if (trajectory_ && !trajectory_->gap().empty()) warnings_.push_back(trajectory_->gap());
    Summary summary;
    summary.title = run_.settings.text("case.name");
    summary.outcome = outcome;
    summary.version = program_version();
    summary.seed = static_cast<std::uint64_t>(run_.settings.integer("case.seed"));
    summary.identity = identity_hash(identity_);
    summary.figures = figures;
    summary.settings = run_.settings.as_text();
    summary.settings["linear solvers"] = model_.describe_solver();
    summary.host = this_host(omp_get_max_threads(), ranks_->size());
    summary.ledger = entries;
    summary.warnings = warnings_;
    summary.statements = plasma_statements(run_.settings);
    timings_.add("process", process_timing());
    summary.timings = timings_.parts();
    write_summary(run_.results / "summary.json", summary);
  }

  std::vector<micro::LedgerEntry> ledger() {
    const micro::PlasmaObservation seen = model_.observe();
    std::vector<micro::LedgerEntry> entries;
    if (scene_.sections && seen.flow_rate_upstream != 0) {
      entries.push_back(
          {.name = "flow rate between the sections",
           .deviation = std::abs(seen.flow_rate_downstream / seen.flow_rate_upstream - 1),
           .warn_above = 0.01,
           .stop_above = 0.1});
    }
    const auto start = static_cast<double>(scene_.domain.particles.size());
    entries.push_back({.name = "number of particles",
                       .deviation = std::abs(static_cast<double>(seen.particles) / start - 1),
                       .warn_above = 0.05,
                       .stop_above = 0.5});
    return entries;
  }

  const PreparedRun& run_;
  std::shared_ptr<const micro::Communicator> ranks_;
  std::map<std::string, std::string> identity_;
  PlasmaScene<dim> scene_;
  micro::PlasmaModel<dim> model_;
  double duration_;  // [s]
  double interval_;  // [s] between rows
  double done_ = 0;  // [s]
  double first_energy_ = 0;
  Timings timings_;
  std::vector<std::string> warnings_;
  std::optional<SeriesWriter> series_;
  std::optional<ParticleTrajectory> trajectory_;
};

}  // namespace

void run_plasma(const PreparedRun& run, const std::shared_ptr<const micro::Communicator>& ranks) {
  if (plasma_dimension(run.settings) == 3) {
    PlasmaRun<3>(run, ranks).execute();
  } else {
    PlasmaRun<2>(run, ranks).execute();
  }
}

}  // namespace hemoscale::coupling
