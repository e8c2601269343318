#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "coupling/error.hpp"
#include "coupling/report/identity.hpp"
#include "coupling/report/progress.hpp"
#include "coupling/report/series.hpp"
#include "coupling/report/summary.hpp"
#include "coupling/report/timings.hpp"
#include "coupling/scene/build_micro.hpp"
#include "coupling/scene/coupled_run.hpp"
#include "coupling/scene/hosts.hpp"
#include "coupling/scene/trajectory_output.hpp"
#include "micro/ensemble/ensemble_model.hpp"
#include "micro/snapshot/checkpoint.hpp"

namespace hemoscale::coupling {

namespace {

/// Plane Poiseuille flow u = 6 U y (H - y) / H^2 of mean velocity U, tabulated from wall to wall;
/// the model's cubic interpolation returns the parabola exactly.
micro::Forcing<2> channel_forcing(const Settings& settings) {
  micro::VelocityProfile profile;
  profile.height = settings.quantity("micro.channel.height");
  const double mean = settings.quantity("micro.mean_velocity");
  const int intervals = 16;
  for (int k = 0; k <= intervals; ++k) {
    const double s = static_cast<double>(k) / intervals;
    profile.velocities.push_back(6 * mean * s * (1 - s));
  }
  micro::Forcing<2> forcing;
  forcing.hematocrit = settings.quantity("fluid.hematocrit");
  forcing.profile = profile;
  return forcing;
}

micro::Forcing<2> shear_forcing(const Settings& settings) {
  micro::Forcing<2> forcing;
  forcing.hematocrit = settings.quantity("fluid.hematocrit");
  forcing.velocity_gradient(0, 1) = settings.quantity("micro.shear_rate");
  return forcing;
}

/// Threads that pay: with fewer nodes than this per thread, they wait for each other more than they
/// compute. Any number gives the same bits.
int useful_threads(const Settings& settings) {
  constexpr std::int64_t nodes_per_thread = 20000;
  const std::int64_t nodes = settings.integer("micro.cells") * settings.integer("micro.nodes");
  return static_cast<int>(
      std::clamp<std::int64_t>(nodes / nodes_per_thread, 1, available_threads()));
}

std::vector<Column> columns(bool is_channel) {
  if (is_channel) {
    return {{"time", "s"},
            {"cell-free layer", "m"},
            {"mean distance of the cells from the axis over half height", "-"},
            {"mean cell velocity", "m/s"},
            {"wall pressure of the cells", "Pa"}};
  }
  return {{"time", "s"},
          {"shear stress", "Pa"},
          {"standard error of shear stress", "Pa"},
          {"relative viscosity", "-"},
          {"first normal stress difference", "Pa"}};
}

std::vector<double> channel_row(const micro::SceneObservation& seen, double height) {
  const micro::LateralProfile& profile = *seen.profile;
  double weight = 0;
  double distance = 0;
  double velocity = 0;
  for (std::size_t k = 0; k < profile.y.size(); ++k) {
    weight += profile.area_fraction[k];
    distance += profile.area_fraction[k] * std::abs(2 * profile.y[k] / height - 1);
    velocity += profile.area_fraction[k] * profile.cell_velocity[k];
  }
  return {seen.time, profile.cell_free_layer, distance / weight, velocity / weight,
          profile.wall_pressure};
}

std::vector<double> shear_row(const Settings& settings, const micro::SceneObservation& seen) {
  const double plasma_stress =
      settings.quantity("fluid.plasma_viscosity") * settings.quantity("micro.shear_rate");
  return {seen.time, seen.shear_stress.mean, seen.shear_stress.standard_error,
          seen.shear_stress.mean / plasma_stress, seen.first_normal_difference.mean};
}

}  // namespace

void run_micro(const PreparedRun& run) {
  const Settings& settings = run.settings;
  const auto identity = state_settings(settings.as_text(), settings_free_at_restart());
  const bool is_channel = settings.text("micro.domain") == "channel";
  const micro::Forcing<2> forcing =
      is_channel ? channel_forcing(settings) : shear_forcing(settings);
  const double duration = settings.quantity("micro.duration");
  const double interval = settings.quantity("micro.output_interval");
  const double height = is_channel ? settings.quantity("micro.channel.height") : 0;

  Timings timings;
  Summary summary;
  micro::EnsembleModel model = [&] {
    const auto scope = timings.measure("packing");
    return micro::EnsembleModel(
        build_ensemble_parameters(settings, useful_threads(settings), run.force),
        static_cast<std::uint64_t>(settings.integer("case.seed")));
  }();
  double done = 0;
  if (run.restart) {
    const micro::RestoredCheckpoint restored = micro::restore_checkpoint(run.results, identity);
    model.restore(restored.checkpoint.slots.at("model"));
    done = restored.checkpoint.time;
    summary.warnings = restored.warnings;
    for (const std::string& warning : restored.warnings) run.log("warning: " + warning);
    run.log(fmt::format("restart from {}: {:.6g} s done", restored.path.string(), done));
  }
  if (settings.boolean("output.trajectory")) {
    model.observe(micro::FrameClock::time, interval,
                  trajectory_writer(run.results / "trajectory.h5", std::make_shared<std::mutex>()));
  }
  const auto series_path = run.results / "series.csv";
  SeriesWriter series = run.restart ? SeriesWriter::resume(series_path, columns(is_channel), done)
                                    : SeriesWriter::create(series_path, columns(is_channel));

  const auto write_checkpoint = [&] {
    const auto scope = timings.measure("results");
    micro::Checkpoint checkpoint;
    checkpoint.number = std::llround(done / interval);
    checkpoint.time = done;
    checkpoint.identity = identity;
    checkpoint.texts["version"] = program_version();
    checkpoint.slots["model"] = model.snapshot();
    micro::write_checkpoint(run.results, checkpoint);
  };

  using Clock = std::chrono::steady_clock;
  auto last_checkpoint = Clock::now();
  const double checkpoint_interval = settings.quantity("output.checkpoint_interval");
  Progress progress("time [s]", done, duration);
  micro::SceneObservation seen;
  while (done + model.time_step() / 2 < duration) {
    {
      const auto scope = timings.measure("micro model");
      // The stretch ends at the next multiple of the interval. Stretches are rounded to whole
      // steps, far shorter than an interval, so the nearest multiple is the one just reached.
      const double next = std::min(duration, interval * (std::round(done / interval) + 1));
      seen = model.advance_by(forcing, next - done);
    }
    done = seen.time;
    const auto scope = timings.measure("results");
    series.append(is_channel ? channel_row(seen, height) : shear_row(settings, seen));
    progress.update(done);
    const std::chrono::duration<double> since = Clock::now() - last_checkpoint;
    if (since.count() >= checkpoint_interval) {
      write_checkpoint();
      last_checkpoint = Clock::now();
    }
  }
  write_checkpoint();
  progress.finish();

  const auto scope = timings.measure("results");
  if (is_channel && seen.profile) {
    std::vector<std::vector<double>> rows;
    for (std::size_t k = 0; k < seen.profile->y.size(); ++k) {
      rows.push_back(
          {seen.profile->y[k], seen.profile->area_fraction[k], seen.profile->cell_velocity[k]});
    }
    write_table(run.results / "profile.csv",
                {{"y", "m"}, {"area fraction", "-"}, {"cell velocity", "m/s"}}, rows);
  }
  finish_trajectories(run.results);
  const Table table = read_table(series_path);
  summary.title = settings.text("case.name");
  summary.version = program_version();
  summary.seed = static_cast<std::uint64_t>(settings.integer("case.seed"));
  summary.identity = identity_hash(identity);
  for (std::size_t k = 1; k < table.columns.size() && !table.rows.empty(); ++k) {
    summary.figures.push_back({table.columns[k].name + " in the last interval",
                               table.rows.back()[k], table.columns[k].unit});
  }
  summary.figures.push_back({"limit of the time step", model.step_limit().time_step, "s"});
  summary.figures.push_back({"time step", model.time_step(), "s"});
  summary.figures.push_back({"steps", std::round(done / model.time_step()), "-"});
  summary.settings = settings.as_text();
  summary.host = this_host(useful_threads(settings), 1);
  summary.ledger = seen.ledger;
  summary.statements = model_statements(settings);
  timings.add("process", process_timing());
  summary.timings = timings.parts();
  write_summary(run.results / "summary.json", summary);
}

}  // namespace hemoscale::coupling
