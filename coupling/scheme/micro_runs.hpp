#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "coupling/transfer/to_forcing.hpp"
#include "micro/model.hpp"
#include "micro/parallel/communicator.hpp"

namespace hemoscale::coupling {

/// Makes the micro model of a sample slot. Called on any rank and from any thread (one call at a
/// time), and must give the same model for a slot wherever it is called: the seed follows from the
/// slot, never from the rank.
using MicroFactory = std::function<std::unique_ptr<micro::MicroModel<2>>(int slot)>;

/// A micro run to be made: which model, in which flow.
struct PlannedRun {
  int slot = 0;
  ShearForcing flow;
};

/// A micro run that was made. The same on every rank and for any number of ranks and threads,
/// wall_time and rank excepted.
struct FinishedRun {
  int slot = 0;
  double shear_rate = 0;  // [1/s]
  micro::Observation<2> observation;
  int rank = 0;          // that made it
  double wall_time = 0;  // [s]
};

/// Called after each micro run on the rank that made it, one call at a time on a rank, from any
/// thread, in order of completion; for progress and for results that need the model. An exception
/// from it counts as failure of the run.
using RunCallback = std::function<void(const FinishedRun&, const micro::MicroModel<2>&)>;

/// The micro models behind the sample slots. Each is made when its slot is first run and continues
/// from its last state afterwards, on whichever rank it runs next.
class MicroRuns {
 public:
  /// @param communicator  must live as long as this object
  MicroRuns(MicroFactory factory, const micro::Communicator& communicator, int threads);

  /// Makes the runs, spread over the ranks (longest predicted run first, to the least loaded rank;
  /// the predicted cost of a run is 1 / shear rate: a given strain at a fixed time step) and over
  /// OpenMP threads within a rank. Collective; every rank passes the same plan.
  ///
  /// @returns  the finished runs in the order of the plan, on every rank
  /// @throws   the same exception on every rank if a run failed on any of them: NumericalError if a
  ///           model failed numerically, else EnvironmentError; the message lists rank, slot, shear
  ///           rate and reason of every failed run. The models are then as before the call.
  std::vector<FinishedRun> advance(const std::vector<PlannedRun>& plan, const micro::Run& run,
                                   const RunCallback& on_run);

  /// The states of all models that have run, by slot; the same on every rank.
  const std::map<int, micro::Snapshot>& states() const { return states_; }
  void restore(std::map<int, micro::Snapshot> states);

 private:
  using Model = std::unique_ptr<micro::MicroModel<2>>;
  struct Outcome;
  struct Turns;
  Outcome make_run(const PlannedRun& planned, Model model, const micro::Run& run,
                   const RunCallback& on_run, Turns& turns) const;
  std::vector<Outcome> make_own_runs(const std::vector<PlannedRun>& plan,
                                     const std::vector<std::size_t>& own, const micro::Run& run,
                                     const RunCallback& on_run);

  MicroFactory factory_;
  const micro::Communicator& communicator_;
  int threads_ = 1;
  std::map<int, micro::Snapshot> states_;  // after the last run of each slot
  std::map<int, Model> live_models_;       // in these states; of the slots last run on this rank
};

/// Which rank makes which run: result[i] is the rank of plan[i].
std::vector<int> spread_over_ranks(const std::vector<PlannedRun>& plan, int ranks);

}  // namespace hemoscale::coupling
