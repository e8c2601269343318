#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "coupling/config/settings.hpp"
#include "coupling/report/series.hpp"
#include "coupling/report/summary.hpp"
#include "coupling/report/timings.hpp"
#include "coupling/scheme/coupled_loop.hpp"
#include "micro/parallel/communicator.hpp"
#include "micro/snapshot/checkpoint.hpp"

namespace hemoscale::coupling {

/// The part of a coupled run that both hosts share: the loop, its checkpoints and its results. The
/// host owns the macro flow. Every call is collective; files are written by the root, trajectories
/// by the rank that runs the model.
class CoupledRun {
 public:
  /// A line for the user; called on the root alone, by one thread at a time.
  using Log = std::function<void(const std::string&)>;

  /// @param results       prepared by prepare_results_folder()
  /// @param communicator  must live as long as this object
  /// @throws CaseError, EnvironmentError (restart: no checkpoint, or one of another case)
  CoupledRun(const Settings& settings, std::filesystem::path results, bool restart, bool force,
             const micro::Communicator& communicator, Log log);
  ~CoupledRun();
  CoupledRun(const CoupledRun&) = delete;
  CoupledRun& operator=(const CoupledRun&) = delete;

  CoupledLoop& loop() { return *loop_; }
  Timings& timings() { return timings_; }
  const std::filesystem::path& results() const { return results_; }
  void log(const std::string& line) const;

  /// What the host gave to record() before the run was interrupted; empty in a new run.
  const std::vector<double>& host_state() const { return host_state_; }
  bool is_converged() const { return converged_; }

  /// Writes what a pass gave, and a checkpoint.
  /// @param time        [s] of the macro flow
  /// @param host_state  whatever the host needs to continue after a restart
  void record(const LoopReport& report, double time, std::vector<double> host_state);

  /// Adds a warning to the summary, and to the log.
  void warn(const std::string& warning);

  /// Writes law.csv, samples.csv, the stock OpenFOAM dictionary of the law and summary.json.
  /// @param figures  of the host, shown before those of the loop
  /// @param law      the final law
  void finish(std::vector<Figure> figures, const macro::ViscosityLaw& law);

 private:
  void restore();
  void agree(const std::string& failure) const;     // a failure of the root becomes that of all
  std::pair<double, double> sampled_range() const;  // [1/s]
  void write_openfoam_dictionary(const macro::ViscosityLaw& law) const;
  void write_samples() const;
  void write_law(const macro::ViscosityLaw& law) const;
  void merge_ledger(const std::vector<micro::LedgerEntry>& entries);

  const Settings& settings_;
  std::filesystem::path results_;
  const micro::Communicator& communicator_;
  Log log_;
  std::map<std::string, std::string> identity_;
  Timings timings_;
  std::unique_ptr<CoupledLoop> loop_;
  std::optional<SeriesWriter> series_;
  std::vector<double> host_state_;
  std::vector<micro::LedgerEntry> ledger_;
  std::vector<std::string> warnings_;
  std::int64_t micro_runs_ = 0;
  std::int64_t runs_without_precision_ = 0;
  std::int64_t micro_steps_ = 0;
  bool converged_ = false;
};

/// Threads for micro runs on this rank: as many as OpenMP offers.
int available_threads();

/// Settings that may change between a run and its continuation.
std::vector<std::string> settings_free_at_restart();

/// What the results of an ensemble are not; written into every summary.
std::vector<std::string> model_statements(const Settings& settings);

}  // namespace hemoscale::coupling
