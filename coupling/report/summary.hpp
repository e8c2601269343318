#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "coupling/report/timings.hpp"
#include "micro/observation.hpp"

namespace hemoscale::coupling {

/// One result of a run.
struct Figure {
  std::string name;                                     // e.g. "flow rate per depth"
  double value = 0;                                     // not finite: written as null
  std::string unit;                                     // e.g. "m^2/s"; "-" for a pure number
  std::optional<double> standard_error = std::nullopt;  // in the same unit
};

/// The machine and the processes of a run.
struct Host {
  std::string name;       // of the machine
  std::string processor;  // as the system names it; empty if unknown
  int processors = 0;     // [-] logical ones that this process may use
  int threads = 1;        // [-] per rank
  int ranks = 1;          // [-]
};

/// What is left of a run: summary.json.
struct Summary {
  std::string title;                            // name of the case
  std::string outcome = "finished";             // or e.g. "stopped: numerical error in pass 3"
  std::string version;                          // of the program; see program_version()
  std::uint64_t seed = 0;                       // of every random number
  std::string identity;                         // see identity_hash()
  std::vector<Figure> figures;                  // results, in the order to be shown
  std::map<std::string, std::string> settings;  // every key with its value in SI, as text
  Host host;                                    //
  std::map<std::string, PartTiming> timings;    // by part
  std::vector<micro::LedgerEntry> ledger;       // conservation
  std::vector<std::string> warnings;            // what the user should look at
  std::vector<std::string> statements;          // what the model is, e.g. "2-D", "no lift"
};

/// Written aside, then renamed.
/// @throws EnvironmentError with path and the system's reason
void write_summary(const std::filesystem::path& path, const Summary& summary);

/// @throws EnvironmentError if the file is missing, not JSON, or not a summary
Summary read_summary(const std::filesystem::path& path);

/// Version of the program: that of the source tree when it was configured (git describe), or that
/// of the release.
std::string program_version();

/// @param threads, ranks  [-] as the run uses them
Host this_host(int threads, int ranks);

}  // namespace hemoscale::coupling
