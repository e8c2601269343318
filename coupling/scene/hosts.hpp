#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "coupling/config/settings.hpp"
#include "micro/parallel/communicator.hpp"

namespace hemoscale::coupling {

/// A checked case with its places, ready to be run.
struct PreparedRun {
  const Settings& settings;
  std::filesystem::path case_folder;
  std::filesystem::path case_file;
  std::string variant;
  std::filesystem::path results;  // made by prepare_results_folder()
  bool restart = false;
  bool force = false;
  std::function<void(const std::string&)> log;  // on the root
};

/// The coupled loop on the analytic channel flow. Collective.
void run_channel(const PreparedRun& run, const micro::Communicator& communicator);

/// The coupled loop inside a stock solver of OpenFOAM, which is started as a child process with the
/// plug-in in it; then the flow it left is read back along macro.openfoam.profile, and compared
/// with the channel flow by quadrature if the case gives its mean velocity. One process.
void run_openfoam(const PreparedRun& run);

/// A micro scene alone: an ensemble in a shear box or a channel. One process.
void run_micro(const PreparedRun& run);

/// An ensemble on vectors alone, in a channel. Collective: cells are shared among the ranks. In a
/// geometry one process, see run_ensemble_feed.
void run_ensemble(const PreparedRun& run, const micro::Communicator& communicator);

/// A plasma scene alone. Collective; the least-squares method shares its work among the ranks.
void run_plasma(const PreparedRun& run, const std::shared_ptr<const micro::Communicator>& ranks);

/// Red cells in plasma alone. One process.
void run_cells_in_plasma(const PreparedRun& run);

}  // namespace hemoscale::coupling
