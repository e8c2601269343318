#pragma once

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "coupling/config/read_case.hpp"
#include "coupling/config/settings.hpp"
#include "micro/parallel/communicator.hpp"

namespace hemoscale::coupling {

/// What the command line says of a run.
struct RunOptions {
  std::filesystem::path case_folder;  // or its case.toml
  std::string variant;                // empty: the case's own
  std::filesystem::path results;      // empty: results/ in the case, results/VARIANT of a variant
  bool restart = false;
  bool force = false;  // beyond a stability limit
  std::vector<Override> overrides = {};
};

/// The folder of a case and its case file.
struct CasePlace {
  std::filesystem::path folder;
  std::filesystem::path file;
};

/// @param named  a case folder, or the case file in it
/// @throws CaseError telling what was looked for
CasePlace find_case(const std::filesystem::path& named);

/// Reads, interprets and checks a case: values, combinations of keys, limits of the methods.
/// @throws CaseError with all faults, EnvironmentError
Settings load_case(const std::filesystem::path& case_folder, const std::string& variant,
                   bool force = false, const std::vector<Override>& overrides = {});

/// What a run would do, as text: SI values that matter, limits and margins.
std::string describe_case(const Settings& settings);

/// Runs a case to its end and writes its results. Collective.
/// @param log  lines for the user; used on the root alone
/// @throws CaseError, EnvironmentError, NumericalError of any of the libraries
void run_case(const RunOptions& options, micro::Communicator&& communicator, std::ostream& log);

}  // namespace hemoscale::coupling
