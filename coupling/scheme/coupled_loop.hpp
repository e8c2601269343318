#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "coupling/rheology/rheology_table.hpp"
#include "coupling/scheme/convergence.hpp"
#include "coupling/scheme/micro_runs.hpp"
#include "coupling/scheme/relaxation.hpp"
#include "macro/viscosity/viscosity_law.hpp"

namespace hemoscale::coupling {

/// From which samples the law is made: those of all passes, or those of the last pass alone.
enum class Memory { accumulate, latest };

/// Everything the loop is told once.
struct LoopOptions {
  micro::Run run;    // of each micro model, in each pass
  FitBounds bounds;  // of the fitted law
  Relaxation relaxation;
  Memory memory = Memory::accumulate;
  double tolerance = 0.005;      // [-] rms change of log viscosity that counts as converged
  bool stop_at_noise = true;     // a change that sampling error explains counts as converged
  double distinct_ratio = 1.05;  // [-] shear rates closer than this factor share a run
  double lowest_shear_rate = 1;  // [1/s] points below are not run; the law is held there
  DivergenceLimits divergence;
  int threads = 1;  // micro runs at a time on each rank
};

/// What one pass did.
struct LoopReport {
  int pass = 0;                   // 1-based, over the whole run
  double change = 0;              // [-] weighted rms of log(candidate) - log(law) at the knots
  double noise = 0;               // [-] the change that sampling error alone would cause
  bool converged = false;         // change <= tolerance, or <= noise if stop_at_noise
  bool limited_by_noise = false;  // converged, though the change exceeds the tolerance
  double relaxation_factor = 0;   // [-] that was used; 0 without feedback
  bool factor_was_bounded = false;
  int micro_runs = 0;                      // [-] made in this pass
  int runs_without_precision = 0;          // [-] of these: the allowance was spent first
  int shear_rates_covered = 0;             // [-] not run: earlier samples are good enough
  int points_below_lowest_shear_rate = 0;  // [-] not run: the law is held there
  double worst_flow_type = 0;     // [-] of largest magnitude over the points that count; 0: shear
  int knots_moved_by_bounds = 0;  // [-] of the candidate
  int knots_pooled_by_monotonicity = 0;    // [-] of the candidate
  int knots_merged_for_rising_stress = 0;  // [-] of the candidate
  double lowest_viscosity = 0;    // [Pa s] of the new law over the knots of the candidate; over the
  double highest_viscosity = 0;   // [Pa s] sampled flows if there is no candidate
  std::vector<FinishedRun> runs;  // of this pass, by rising shear rate
  std::vector<RheologySample> samples;  // made from them, in the same order
};

/// The micro half of the coupling: flow in, law out. It does not know where the flow comes from.
///
/// State: the law, the samples, the states of the micro models, the history of the relaxation.
/// Every call is collective over the communicator, with the same arguments and results on every
/// rank; neither the number of ranks nor that of threads changes a bit of the law.
class CoupledLoop {
 public:
  /// @param initial_law   before any micro run
  /// @param communicator  must live as long as this object
  /// @throws CaseError naming the options that are out of range, all at once
  CoupledLoop(macro::ViscosityLaw initial_law, LoopOptions options, MicroFactory factory,
              const micro::Communicator& communicator);

  /// One pass with feedback: micro runs in the sampled flows, candidate table, relaxation, new law.
  /// If no point has a shear rate above the lowest one and no sample is known, the law stays, and
  /// the pass is not converged.
  ///
  /// @param flows  flows[i] is the flow at sample point i; as many in every pass
  /// @throws NumericalError if a micro run fails or the iteration diverges, EnvironmentError (MPI,
  ///         files); the loop is then as before the call
  LoopReport pass(const std::vector<ShearForcing>& flows);

  /// The same without feedback: the law stays, the candidate can be asked for.
  LoopReport measure(const std::vector<ShearForcing>& flows);

  const macro::ViscosityLaw& law() const { return state_.law; }

  /// The table made from the samples in the last pass; empty before the first one.
  const std::optional<RheologyTable>& candidate() const { return state_.candidate; }
  const std::vector<RheologySample>& samples() const { return state_.samples; }
  int passes() const { return state_.passes; }

  /// Passes since the last call of end_window(). An implicit scheme repeats a window until it has
  /// converged; the history of relaxation and divergence is that of one window.
  int passes_in_window() const { return static_cast<int>(state_.changes.size()); }
  bool window_has_converged() const { return state_.has_converged; }
  void end_window();

  /// Called after each micro run; see RunCallback.
  void notify_runs(RunCallback on_run) { on_run_ = std::move(on_run); }

  /// The complete state: a loop made with the same arguments continues from it with the same bits,
  /// on any number of ranks.
  micro::Snapshot snapshot() const;

  /// @throws EnvironmentError if the snapshot is not one of such a loop
  void restore(const micro::Snapshot& snapshot);

 private:
  struct History {                  // of the relaxation: the pass before
    macro::ViscosityLaw law;        // x(n-1)
    bool law_is_table;              // else it is the initial law
    macro::ViscosityLaw candidate;  // its candidate, a table
    double factor = 1;              // [-] that was used with them
  };
  struct State {
    macro::ViscosityLaw law;
    bool law_is_table;                    // else it is the initial law
    std::vector<RheologySample> samples;  // that the candidate is made from
    std::optional<RheologyTable> candidate;
    std::vector<double> changes;  // [-] of the passes in this window
    std::optional<History> history;
    int passes = 0;
    bool has_converged = false;  // the last pass in this window
  };

  LoopReport advance(const std::vector<ShearForcing>& flows, bool feedback);
  std::vector<PlannedRun> plan(const std::vector<ShearForcing>& flows, LoopReport& report) const;
  void digest(State& next, LoopReport& report, bool feedback) const;
  void relax(State& next, const std::vector<double>& residual, const std::vector<double>& weights,
             LoopReport& report) const;
  RheologyTable table_of(std::vector<RheologySample> samples) const;

  macro::ViscosityLaw initial_law_;
  LoopOptions options_;
  MicroRuns micro_runs_;
  RunCallback on_run_;
  State state_;
};

}  // namespace hemoscale::coupling
