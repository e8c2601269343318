#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "coupling/config/settings.hpp"
#include "macro/macro_model.hpp"
#include "macro/viscosity/viscosity_law.hpp"
#include "micro/parallel/communicator.hpp"

namespace hemoscale::coupling {

/// What happened in one pass of the coupled loop.
struct PassReport {
  int pass = 0;                  // 1-based, over the whole run
  double time = 0;               // [s] of the macro flow
  double change = 0;             // [-] convergence measure: weighted rms change of log viscosity
  double relaxation = 0;         // [-] factor that was used
  int micro_runs = 0;            // [-] in this pass
  double lowest_viscosity = 0;   // [Pa s] of the law over its knots
  double highest_viscosity = 0;  // [Pa s]
  bool converged = false;
};

/// The coupled loop as a host inside a flow solver sees it: the host owns the macro flow and calls
/// advance() once per window; the session samples, runs the micro models, fits, relaxes, and
/// returns the law to use from now on. It writes results and checkpoints of its own.
///
/// C++17-clean: the OpenFOAM plug-in includes it. Every call is collective over the communicator.
class CoupledSession {
 public:
  /// @param settings      a checked case
  /// @param results       folder that results are written to; made if missing
  /// @param restart       continue from the newest checkpoint in `results`
  /// @throws CaseError, EnvironmentError
  CoupledSession(const Settings& settings, const std::filesystem::path& results, bool restart,
                 micro::Communicator communicator);
  ~CoupledSession();
  CoupledSession(const CoupledSession&) = delete;
  CoupledSession& operator=(const CoupledSession&) = delete;

  /// The law that holds now: that of the checkpoint, or the case's initial law.
  const macro::ViscosityLaw& law() const;
  double hematocrit() const;               // [-]
  double density() const;                  // [kg/m^3] of blood, for kinematic quantities
  const Settings::Points& points() const;  // [m] where the flow is sampled

  /// One window of the explicit scheme on the flow of the host.
  PassReport advance(const macro::FlowField<3>& flow, const macro::Window& window);
  bool is_converged() const;

  /// Writes summary.json with the host's own figures beside those of the session.
  void finish(const std::map<std::string, double>& host_figures);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace hemoscale::coupling
