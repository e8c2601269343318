#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace hemoscale::coupling {

/// What is left of one run of a study beside its results: record.json in its folder. It is written
/// last, so that a folder without it is that of a run that was interrupted.
struct RunRecord {
  enum class Status { finished, failed, timed_out };
  std::string identity;  // PlannedRun::identity
  Status status = Status::finished;
  std::string message;  // why it failed; or how it ended, if there is more to say than "finished"
  double cpu = 0;       // [s] user and system, of all its processes; least of the repeats
  double wall = 0;      // [s] least of the repeats
  int repeats = 1;      // [-]
  int jobs = 1;         // [-] runs that shared the machine
  double longest = 0;   // [s] that it was allowed to take
  std::string build;    // this_build() of the program that made it
};

std::string status_text(RunRecord::Status status);

/// Written aside, then renamed.
/// @throws EnvironmentError
void write_record(const std::filesystem::path& file, const RunRecord& record);

/// @returns nothing if there is no such file
/// @throws EnvironmentError if the file is not a whole record
std::optional<RunRecord> read_record(const std::filesystem::path& file);

}  // namespace hemoscale::coupling
