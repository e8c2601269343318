#pragma once

#include <condition_variable>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>

#include "coupling/report/summary.hpp"
#include "coupling/study/plan.hpp"
#include "coupling/study/run_record.hpp"

namespace hemoscale::coupling {

struct RunnerOptions {
  std::filesystem::path program;  // this program: every run is a process of its own
  int jobs = 1;                   // [-] runs at once
  bool fresh = false;             // do not use what earlier commands have finished
};

/// Makes the runs of a study, each as a child process with a folder of its own in
/// results/STUDY/runs/, and remembers them there: a run that is finished is not made again. A run
/// that was interrupted leaves no record and starts anew.
///
/// run() may be called from several threads.
class Runner {
 public:
  /// Takes the results of the study for itself until it goes.
  /// @throws EnvironmentError if another process has them, or they cannot be written
  Runner(const Study& study, RunnerOptions options);
  ~Runner();
  Runner(const Runner&) = delete;
  Runner& operator=(const Runner&) = delete;

  const std::filesystem::path& results() const { return results_; }
  std::filesystem::path folder_of(const PlannedRun& run);

  /// The record of the run if it is finished: nothing needs to be run.
  std::optional<RunRecord> finished(const PlannedRun& run);

  /// Runs it unless it is finished.
  /// @throws EnvironmentError if it ends otherwise than well, by failed numerics (exit code 4) or
  ///         by its time limit
  RunRecord run(const PlannedRun& run);

  Summary summary_of(const PlannedRun& run);

  /// What the user should know of the runs that run() returned, one line each; may be empty.
  /// @param times_matter  whether their CPU times are part of the answer
  std::string notes(bool times_matter) const;

 private:
  RunRecord make(const PlannedRun& run, const std::filesystem::path& folder) const;

  const Study& study_;
  RunnerOptions options_;
  std::filesystem::path results_;
  int lock_ = -1;  // file descriptor
  std::mutex mutex_;
  std::condition_variable freed_;
  std::set<std::string> busy_;                            // identities that are being run
  std::set<std::string> made_;                            // by this object
  int of_other_build_ = 0;                                // [-] runs
  int beside_others_ = 0;                                 // [-] runs
  std::map<std::string, std::filesystem::path> folders_;  // by the end of their names
};

/// The folder of the results of a study.
std::filesystem::path results_of(const Study& study);

/// Calls action(0) ... action(count - 1), at most `jobs` at once. The first exception ends it, once
/// the actions that have begun are over.
void for_each_at_once(std::size_t count, int jobs, const std::function<void(std::size_t)>& action);

}  // namespace hemoscale::coupling
