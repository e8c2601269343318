#include "coupling/scene/ensemble_feed_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numeric>

#include "coupling/error.hpp"
#include "coupling/report/identity.hpp"
#include "coupling/report/progress.hpp"
#include "coupling/report/summary.hpp"
#include "coupling/report/timings.hpp"
#include "coupling/scene/coupled_run.hpp"
#include "coupling/scene/ensemble_results.hpp"
#include "coupling/scene/feed_results.hpp"
#include "coupling/scene/trajectory_output.hpp"
#include "micro/ensemble/packing/state_checks.hpp"
#include "micro/snapshot/checkpoint.hpp"

namespace hemoscale::coupling {

namespace {

using Clock = std::chrono::steady_clock;

// Fewer cells than this leave shares uncertain by more than some 5 %.
constexpr std::uint64_t few_cells = 100;

std::vector<micro::EnsembleState> no_cells(const micro::blocks::BlockSettings& settings) {
  std::vector<micro::EnsembleState> states(settings.kinds.size());
  for (std::size_t k = 0; k < states.size(); ++k) {
    states[k].nodes = static_cast<std::size_t>(settings.kinds[k].mesh.nodes);
  }
  return states;
}

/// "flux [m^2/s]" as name and unit.
Figure figure_of(const std::string& text, double value) {
  const std::size_t bracket = text.rfind(" [");
  if (bracket == std::string::npos) return {text, value, "-"};
  return {text.substr(0, bracket), value, text.substr(bracket + 2, text.size() - bracket - 3)};
}

std::vector<std::string> statements_of(const FeedScene& scene) {
  std::vector<std::string> statements = ensemble_statements({});
  statements.emplace_back(
      "cells enter at random places across the inlet in proportion to the flow: how they divide "
      "depends on that, because without lift none migrates on the way");
  const auto value = [&](const std::string& name) {
    for (const auto& [text, number] : scene.blocks.flow.statements) {
      if (text.rfind(name, 0) == 0) return number;
    }
    throw std::logic_error("the flow states no " + name);
  };
  statements.push_back(fmt::format(
      "errors over the largest speed: interpolation of the flow {:.1e} rms, {:.1e} at most; one "
      "expansion for a whole cell {:.1e} rms, {:.1e} at most",
      value("rms interpolation error"), value("largest interpolation error"),
      value("rms error of one expansion"), value("largest error of one expansion")));
  return statements;
}

class FeedRun {
 public:
  explicit FeedRun(const PreparedRun& run)
      : run_(run),
        settings_(run.settings),
        identity_(state_settings(settings_.as_text(), settings_free_at_restart())),
        duration_(settings_.quantity("micro.duration")),
        interval_(settings_.quantity("micro.output_interval")),
        threads_(std::max(1, available_threads())),
        scene_(make_scene()),
        ensemble_(scene_.blocks.settings, scene_.blocks.precision,
                  no_cells(scene_.blocks.settings)),
        feed_(scene_.plan, scene_.blocks.settings,
              static_cast<std::uint64_t>(settings_.integer("case.seed")), 0),
        settling_step_(step_at(settings_.quantity("micro.flow.settling_time"))) {
    if (run_.restart) restore();
    results_ = std::make_unique<FeedResults>(
        run_.results, scene_, settings_.boolean("output.trajectory"), statements_of(scene_),
        run_.restart ? std::optional<double>(ensemble_.time()) : std::nullopt);
  }

  void go() {
    const double dt = scene_.blocks.settings.time_step;
    const std::int64_t last = std::max<std::int64_t>(1, step_at(duration_));
    const double checkpoint_interval = settings_.quantity("output.checkpoint_interval");
    auto last_checkpoint = Clock::now();
    Progress progress("time [s]", ensemble_.time(), duration_);
    if (!run_.restart) output();
    while (ensemble_.step() < last) {
      const double next = interval_ * static_cast<double>(intervals() + 1);
      const std::int64_t target = std::min(last, step_at(next));
      advance_to(std::max(target, ensemble_.step() + 1));
      output();
      progress.update(dt * static_cast<double>(ensemble_.step()));
      if (std::chrono::duration<double>(Clock::now() - last_checkpoint).count() >=
          checkpoint_interval) {
        write_checkpoint();
        last_checkpoint = Clock::now();
      }
    }
    write_checkpoint();
    progress.finish();
    summarise();
  }

 private:
  FeedScene make_scene() {
    const auto scope = timings_.measure("flow");
    return build_feed(settings_, threads_, run_.force, run_.case_folder, run_.results);
  }

  std::int64_t step_at(double time) const {
    return std::llround(time / scene_.blocks.settings.time_step);
  }

  /// Whole intervals that have passed; outputs are at the steps nearest to their ends.
  std::int64_t intervals() const {
    const double margin = 0.75 * scene_.blocks.settings.time_step;
    return static_cast<std::int64_t>((ensemble_.time() + margin) / interval_);
  }

  /// Of the present output, from 0; the last one may end a part of an interval.
  std::int64_t output_number() const {
    const double rest = ensemble_.time() - interval_ * static_cast<double>(intervals());
    return intervals() + (rest > 0.75 * scene_.blocks.settings.time_step ? 1 : 0);
  }

  void advance_to(std::int64_t step) {
    const auto scope = timings_.measure("micro model");
    if (!tally_.has_begun && settling_step_ <= step) {
      feed_.advance(ensemble_, settling_step_ - ensemble_.step());
      tally_.begin(ensemble_.time(), feed_.counts());
    }
    feed_.advance(ensemble_, step - ensemble_.step());
  }

  void output() {
    const auto scope = timings_.measure("results");
    results_->append(output_number(), ensemble_, feed_, tally_);
  }

  void restore() {
    const micro::RestoredCheckpoint restored = micro::restore_checkpoint(run_.results, identity_);
    const auto& slots = restored.checkpoint.slots;
    ensemble_.restore(slots.at("model"));
    feed_.restore(slots.at("feed"));
    tally_.restore(slots.at("tally"), scene_.blocks.names.size(), scene_.plan.outlets.size());
    summary_.warnings = restored.warnings;
    for (const std::string& warning : restored.warnings) run_.log("warning: " + warning);
    run_.log(
        fmt::format("restart from {}: {:.6g} s done", restored.path.string(), ensemble_.time()));
  }

  void write_checkpoint() {
    const auto scope = timings_.measure("results");
    micro::Checkpoint checkpoint;
    checkpoint.number = output_number();
    checkpoint.time = ensemble_.time();
    checkpoint.identity = identity_;
    checkpoint.texts["version"] = program_version();
    checkpoint.slots["model"] = ensemble_.snapshot();
    checkpoint.slots["feed"] = feed_.snapshot();
    checkpoint.slots["tally"] = tally_.snapshot();
    micro::write_checkpoint(run_.results, checkpoint);
  }

  void add_figures() {
    auto& figures = summary_.figures;
    figures = results_->figures(ensemble_, feed_, tally_);
    figures.push_back({"time from which cells are counted", tally_.since, "s"});
    figures.push_back({"area of the fluid", scene_.fluid_area, "m^2"});
    figures.push_back({"time step", scene_.blocks.settings.time_step, "s"});
    figures.push_back({"steps", static_cast<double>(ensemble_.step()), "-"});
    figures.push_back({"steps between looks for cells that come and go",
                       static_cast<double>(feed_.interval()), "-"});
    for (const auto& [text, value] : scene_.blocks.flow.statements) {
      figures.push_back(figure_of(text, value));
    }
  }

  void add_warnings() {
    auto& warnings = summary_.warnings;
    const auto overlapping = micro::overlaps(ensemble_.states(), scene_.plan.room);
    summary_.figures.push_back(
        {"overlapping pairs of cells at the end", static_cast<double>(overlapping.size()), "-"});
    if (!overlapping.empty()) {
      warnings.push_back(fmt::format(
          "{} pairs of cells overlap at the end; stiffen the contacts or shorten the step",
          overlapping.size()));
    }
    for (std::size_t k = 0; k < scene_.blocks.names.size(); ++k) {
      const FeedDivision d = divide(scene_, tally_, feed_.counts(), k, ensemble_.time());
      const auto counted = std::accumulate(d.counted.begin(), d.counted.end(), std::uint64_t{0});
      if (counted >= few_cells) continue;
      warnings.push_back(
          fmt::format("{} {} were counted at the outlets: their shares are uncertain; lengthen "
                      "micro.duration or shorten micro.flow.settling_time",
                      counted, scene_.blocks.names[k]));
    }
  }

  void summarise() {
    const auto scope = timings_.measure("results");
    finish_trajectories(run_.results);
    if (settings_.boolean("output.trajectory")) finish_trajectories(run_.results / "frames");
    summary_.title = settings_.text("case.name");
    summary_.version = program_version();
    summary_.seed = static_cast<std::uint64_t>(settings_.integer("case.seed"));
    summary_.identity = identity_hash(identity_);
    add_figures();
    add_warnings();
    summary_.settings = settings_.as_text();
    summary_.host = this_host(threads_, 1);
    summary_.statements = statements_of(scene_);
    summary_.statements.push_back(fmt::format("vector kernels: {}", ensemble_.kernel_version()));
    timings_.add("process", process_timing());
    summary_.timings = timings_.parts();
    write_summary(run_.results / "summary.json", summary_);
  }

  const PreparedRun& run_;
  const Settings& settings_;
  std::map<std::string, std::string> identity_;
  double duration_ = 0;  // [s]
  double interval_ = 0;  // [s] between outputs
  int threads_ = 1;
  Timings timings_;
  Summary summary_;
  FeedScene scene_;
  micro::BlockEnsemble ensemble_;
  micro::CellFeed feed_;
  std::int64_t settling_step_ = 0;
  FeedTally tally_;
  std::unique_ptr<FeedResults> results_;
};

}  // namespace

void run_ensemble_feed(const PreparedRun& run, const micro::Communicator& communicator) {
  if (communicator.size() > 1) {
    throw CaseError({{run.case_file.string(), 0, 0, "micro.domain",
                      fmt::format("\"geometry\" runs on one process, but {} were started; run it "
                                  "without mpirun, it uses threads (OMP_NUM_THREADS)",
                                  communicator.size())}});
  }
  FeedRun(run).go();
}

}  // namespace hemoscale::coupling
