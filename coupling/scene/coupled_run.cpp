#include "coupling/scene/coupled_run.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "coupling/error.hpp"
#include "coupling/report/identity.hpp"
#include "coupling/rheology/openfoam_dictionary.hpp"
#include "coupling/scene/build_law.hpp"
#include "coupling/scene/build_loop.hpp"
#include "coupling/scene/build_micro.hpp"
#include "coupling/scene/cell_results.hpp"
#include "coupling/scene/plasma_results.hpp"
#include "coupling/scene/trajectory_output.hpp"
#include "micro/snapshot/durable_file.hpp"

namespace hemoscale::coupling {

namespace {

std::vector<Column> series_columns() {
  return {{"pass", "-"},
          {"time", "s"},
          {"change of log viscosity", "-"},
          {"change explained by sampling error", "-"},
          {"relaxation factor", "-"},
          {"micro runs", "-"},
          {"lowest viscosity", "Pa s"},
          {"highest viscosity", "Pa s"},
          {"converged", "-"}};
}

double as_number(bool value) {
  return value ? 1.0 : 0.0;
}

}  // namespace

int available_threads() {
  return omp_get_max_threads();
}

std::vector<std::string> settings_free_at_restart() {
  return {"case.description", "coupling.maximum_passes", "coupling.tolerance", "output.",
          "micro.duration",   "macro.openfoam.ranks",    "micro.force"};
}

std::vector<std::string> model_statements(const Settings& settings) {
  if (settings.text("micro.model") == "synthetic") {
    return {"synthetic micro model: its rheology was put in, not found"};
  }
  if (settings.text("micro.model") == "plasma") {
    return has_cells_in_plasma(settings) ? cell_statements(settings) : plasma_statements(settings);
  }
  return {
      "two-dimensional cells: stresses and viscosities are those of a suspension of infinitely "
      "long "
      "cylinders, and the hematocrit is an area fraction; not to be read as three-dimensional "
      "values",
      "prescribed flow: no hydrodynamic interaction, no lift",
      fmt::format("drag convention: {}, coefficient {:g} times the plasma viscosity",
                  settings.text("micro.drag.convention"),
                  settings.quantity("micro.drag.coefficient"))};
}

CoupledRun::CoupledRun(const Settings& settings, std::filesystem::path results, bool restart,
                       bool force, const micro::Communicator& communicator, Log log)
    : settings_(settings),
      results_(std::move(results)),
      communicator_(communicator),
      log_(std::move(log)),
      identity_(state_settings(settings.as_text(), settings_free_at_restart())) {
  EnsembleHook hook;
  if (settings.boolean("output.trajectory")) {
    hook = trajectory_hook(results_, settings.quantity("output.trajectory_interval"));
  }
  loop_ = std::make_unique<CoupledLoop>(
      build_law(settings, "law.initial", "law"), build_loop_options(settings, available_threads()),
      build_micro_factory(settings, force, std::move(hook)), communicator_);
  loop_->notify_runs([this](const FinishedRun& run, const micro::MicroModel<2>&) {
    this->log(fmt::format(
        "  micro run at {:.4g} 1/s: viscosity {:.4g} +- {:.1g} mPa s, {} in {:.1f} s",
        run.shear_rate, 1e3 * run.observation.shear_stress.mean / run.shear_rate,
        1e3 * run.observation.shear_stress.standard_error / run.shear_rate,
        run.observation.termination == micro::Termination::precision_reached ? "precision reached"
                                                                             : "allowance spent",
        run.wall_time));
  });
  if (restart) restore();
  if (communicator_.is_root()) {
    series_ = restart
                  ? SeriesWriter::resume(results_ / "series.csv", series_columns(), loop_->passes())
                  : SeriesWriter::create(results_ / "series.csv", series_columns());
  }
}

CoupledRun::~CoupledRun() = default;

void CoupledRun::log(const std::string& line) const {
  if (log_) log_(line);
}

void CoupledRun::warn(const std::string& warning) {
  if (std::find(warnings_.begin(), warnings_.end(), warning) != warnings_.end()) return;
  warnings_.push_back(warning);
  log("warning: " + warning);
}

void CoupledRun::agree(const std::string& failure) const {
  // A single process has no rank to name.
  if (communicator_.size() == 1 && !failure.empty()) throw EnvironmentError(failure);
  communicator_.agree(failure);
}

void CoupledRun::restore() {
  const auto scope = timings_.measure("restart");
  // Every rank reads the file: it is small, and all of them need all of it.
  std::string failure;
  micro::RestoredCheckpoint restored;
  try {
    restored = micro::restore_checkpoint(results_, identity_);
    loop_->restore(restored.checkpoint.slots.at("loop"));
    const micro::Snapshot& host = restored.checkpoint.slots.at("host");
    host_state_ = host.reals.at("state");
    micro_runs_ = host.integers.at("counts").at(0);
    runs_without_precision_ = host.integers.at("counts").at(1);
    micro_steps_ = host.integers.at("counts").at(2);
    converged_ = host.integers.at("counts").at(3) != 0;
  } catch (const std::exception& error) {
    failure = error.what();
  }
  agree(failure);
  for (const std::string& warning : restored.warnings) warn(warning);
  log(fmt::format("restart from {}: {} passes done", restored.path.string(), loop_->passes()));
}

void CoupledRun::merge_ledger(const std::vector<micro::LedgerEntry>& entries) {
  for (const micro::LedgerEntry& entry : entries) {
    const auto known =
        std::find_if(ledger_.begin(), ledger_.end(),
                     [&](const micro::LedgerEntry& e) { return e.name == entry.name; });
    if (known == ledger_.end()) {
      ledger_.push_back(entry);
    } else {
      known->deviation = std::max(known->deviation, entry.deviation);
    }
    if (entry.deviation > entry.warn_above) {
      warn(fmt::format("conservation: {} deviates by {:.2g}, more than {:.2g}", entry.name,
                       entry.deviation, entry.warn_above));
    }
  }
}

void CoupledRun::record(const LoopReport& report, double time, std::vector<double> host_state) {
  const auto scope = timings_.measure("results");
  converged_ = report.converged;
  micro_runs_ += report.micro_runs;
  runs_without_precision_ += report.runs_without_precision;
  double micro_wall = 0;
  for (const FinishedRun& run : report.runs) {
    micro_steps_ += run.observation.steps;
    micro_wall += run.wall_time;
    merge_ledger(run.observation.ledger);
  }
  if (report.micro_runs > 0) {
    timings_.add("micro runs, all threads and ranks added",
                 {micro_wall, micro_wall, report.micro_runs});
  }
  host_state_ = std::move(host_state);
  if (report.runs_without_precision > 0) {
    warn(fmt::format(
        "{} of {} micro runs of pass {} spent their allowance before the wanted standard "
        "error was reached; raise micro.run.maximum_strain or accept the error bars",
        report.runs_without_precision, report.micro_runs, report.pass));
  }
  if (std::abs(report.worst_flow_type) > 0.1) {
    warn(fmt::format(
        "the flow at a sample point is no simple shear (flow type {:.2f}); its viscosity "
        "is that of a simple shear of the same rate",
        report.worst_flow_type));
  }
  if (report.knots_moved_by_bounds > 0) {
    warn(fmt::format("{} knots of the law of pass {} were moved to the bounds of the fit",
                     report.knots_moved_by_bounds, report.pass));
  }

  std::string failure;
  if (communicator_.is_root()) {
    try {
      const std::vector<double> row = {static_cast<double>(report.pass),
                                       time,
                                       report.change,
                                       report.noise,
                                       report.relaxation_factor,
                                       static_cast<double>(report.micro_runs),
                                       report.lowest_viscosity,
                                       report.highest_viscosity,
                                       as_number(report.converged)};
      series_->append(row);
      write_samples();
      micro::Checkpoint checkpoint;
      checkpoint.number = report.pass;
      checkpoint.time = time;
      checkpoint.identity = identity_;
      checkpoint.texts["version"] = program_version();
      checkpoint.slots["loop"] = loop_->snapshot();
      micro::Snapshot& host = checkpoint.slots["host"];
      host.reals["state"] = host_state_;
      host.integers["counts"] = {micro_runs_, runs_without_precision_, micro_steps_,
                                 converged_ ? 1 : 0};
      micro::write_checkpoint(results_, checkpoint);
    } catch (const std::exception& error) {
      failure = error.what();
    }
  }
  agree(failure);
  log(fmt::format(
      "pass {}: {} micro runs, change of log viscosity {:.3g} (sampling error explains "
      "{:.3g}), viscosity {:.4g} to {:.4g} mPa s{}",
      report.pass, report.micro_runs, report.change, report.noise, 1e3 * report.lowest_viscosity,
      1e3 * report.highest_viscosity, report.converged ? ", converged" : ""));
}

void CoupledRun::write_samples() const {
  std::vector<std::vector<double>> rows;
  for (const RheologySample& s : loop_->samples()) {
    rows.push_back({s.shear_rate, s.hematocrit, s.viscosity, s.viscosity_error, s.shear_stress,
                    s.first_normal_difference, s.first_normal_error, s.effective_samples,
                    s.averaging_time, as_number(s.precision_reached),
                    static_cast<double>(s.dimension)});
  }
  write_table(results_ / "samples.csv",
              {{"shear rate", "1/s"},
               {"hematocrit", "-"},
               {"viscosity", "Pa s"},
               {"standard error", "Pa s"},
               {"shear stress", "Pa"},
               {"first normal stress difference", "Pa"},
               {"standard error of it", "Pa"},
               {"effective samples", "-"},
               {"averaging time", "s"},
               {"precision reached", "-"},
               {"dimension", "-"}},
              rows);
}

std::pair<double, double> CoupledRun::sampled_range() const {
  const double lowest = settings_.quantity("sampling.lowest_shear_rate");
  if (loop_->samples().empty()) return {lowest, 1e3 * lowest};
  const auto [low, high] = std::minmax_element(
      loop_->samples().begin(), loop_->samples().end(),
      [](const RheologySample& a, const RheologySample& b) { return a.shear_rate < b.shear_rate; });
  return {low->shear_rate, high->shear_rate};
}

void CoupledRun::write_openfoam_dictionary(const macro::ViscosityLaw& law) const {
  const auto [low, high] = sampled_range();
  DictionaryRange range;
  range.lowest_shear_rate = low / 10;
  range.highest_shear_rate = high * 10;
  micro::write_durably(
      results_ / "transportProperties.hemoscale",
      openfoam_dictionary(
          law, settings_.quantity("fluid.hematocrit"), settings_.quantity("fluid.density"), range,
          fmt::format("case {}, two-dimensional micro model, samples from {:.4g} to "
                      "{:.4g} 1/s; held outside",
                      settings_.text("case.name"), low, high)));
}

void CoupledRun::write_law(const macro::ViscosityLaw& law) const {
  const double hematocrit = settings_.quantity("fluid.hematocrit");
  const auto [low, high] = sampled_range();
  // A decade beyond the samples on both sides shows how the law is held there.
  const int count = 241;
  const double first = std::log(low / 10);
  const double last = std::log(high * 10);
  std::vector<std::vector<double>> rows;
  for (int k = 0; k < count; ++k) {
    const double rate = std::exp(first + (last - first) * k / (count - 1));
    const double mu = law.viscosity(rate, hematocrit);
    const bool trusted = loop_->candidate() && loop_->candidate()->is_trusted(rate, hematocrit);
    const double width =
        trusted ? loop_->candidate()->log_half_width(rate, hematocrit) : std::nan("");
    rows.push_back(
        {rate, hematocrit, mu, mu * std::exp(-width), mu * std::exp(width), as_number(trusted)});
  }
  write_table(results_ / "law.csv",
              {{"shear rate", "1/s"},
               {"hematocrit", "-"},
               {"viscosity", "Pa s"},
               {"lower end of 95 % band", "Pa s"},
               {"upper end of 95 % band", "Pa s"},
               {"inside the sampled range", "-"}},
              rows);
}

void CoupledRun::finish(std::vector<Figure> figures, const macro::ViscosityLaw& law) {
  std::string failure;
  if (communicator_.is_root()) {
    try {
      Summary summary;
      summary.title = settings_.text("case.name");
      summary.outcome = converged_ ? "converged" : "finished, not converged";
      if (settings_.text("coupling.scheme") == "one-way") summary.outcome = "finished, one-way";
      summary.version = program_version();
      summary.seed = static_cast<std::uint64_t>(settings_.integer("case.seed"));
      summary.identity = identity_hash(identity_);
      summary.figures = std::move(figures);
      summary.figures.push_back(
          {"passes of the coupled loop", static_cast<double>(loop_->passes()), "-"});
      summary.figures.push_back({"micro runs", static_cast<double>(micro_runs_), "-"});
      summary.figures.push_back({"micro runs that spent their allowance",
                                 static_cast<double>(runs_without_precision_), "-"});
      summary.figures.push_back({"micro steps", static_cast<double>(micro_steps_), "-"});
      for (const RheologySample& s : loop_->samples()) {
        summary.figures.push_back({fmt::format("viscosity at {:.4g} 1/s", s.shear_rate),
                                   s.viscosity, "Pa s", s.viscosity_error});
      }
      summary.settings = settings_.as_text();
      summary.host = this_host(available_threads(), communicator_.size());
      summary.ledger = ledger_;
      summary.statements = model_statements(settings_);
      if (!converged_ && settings_.text("coupling.scheme") != "one-way") {
        warn(
            "the coupled loop has not converged; raise coupling.maximum_passes, or the precision "
            "of "
            "the micro runs");
      }
      {
        const auto scope = timings_.measure("results");
        write_samples();
        write_law(law);
        if (!loop_->samples().empty()) {
          write_openfoam_dictionary(law);
        }
        finish_trajectories(results_);
      }
      summary.warnings = warnings_;
      summary.timings = timings_.parts();
      write_summary(results_ / "summary.json", summary);
    } catch (const std::exception& error) {
      failure = error.what();
    }
  }
  agree(failure);
}

}  // namespace hemoscale::coupling
