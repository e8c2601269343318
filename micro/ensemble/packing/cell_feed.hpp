#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "micro/ensemble/blocks/block_ensemble.hpp"
#include "micro/ensemble/flow/inflow_queue.hpp"
#include "micro/ensemble/packing/insertion.hpp"
#include "micro/model.hpp"

namespace hemoscale::micro {

/// One kind of cells that enters through an opening.
struct FedKind {
  std::size_t kind = 0;            // of the ensemble
  std::vector<Vector<2>> outline;  // [m] of a cell that enters, centred on the origin
  Opening inlet;
  Feed feed;
};

/// What enters and leaves an ensemble in a channel with openings.
struct FeedPlan {
  std::vector<FedKind> inlets;
  std::vector<Opening> outlets;  // cells whose centres pass them are taken out
  double overhang =
      0;          // [m] for how far the channel is continued beyond its openings; cells come in
                  // at most so far before an inlet, and have left at most so far behind an outlet
  CellRoom room;  // walls alone; its openings are not looked at
  Clearance clearance;                 // of entering cells
  std::uint64_t largest_backlog = 50;  // cells that may wait for a free place at an inlet
};

/// Exact counts of cells of one kind.
struct FeedCounts {
  std::uint64_t entered = 0;
  std::uint64_t waiting = 0;             // due, but no place is free
  std::vector<std::uint64_t> left = {};  // per outlet
};

/// Lets cells enter and leave while an ensemble is advanced: whoever is due at an inlet is put to
/// the free place nearest to the one that was drawn, at the opening or before it; if there is none,
/// it waits. Cells that have passed an outlet are taken out.
///
/// It looks so often that nothing moves by more than a sixteenth of the overhang in between, at
/// steps counted from step 0: results do not depend on how a run is divided into calls.
class CellFeed {
 public:
  /// @param steps  of the ensemble, and its flow: for the time between two looks
  /// @throws ParameterError for openings, feeds or kinds that do not fit
  CellFeed(FeedPlan plan, const blocks::BlockSettings& settings, std::uint64_t seed,
           std::uint64_t stream);

  /// Advances the ensemble by so many steps.
  /// @throws NumericalError if more cells than the backlog wait at an inlet: hematocrit and remedy
  void advance(BlockEnsemble& ensemble, std::int64_t steps);

  std::int64_t interval() const { return interval_; }  // [-] steps between looks

  /// By kind of the ensemble.
  const std::vector<FeedCounts>& counts() const { return counts_; }

  Snapshot snapshot() const;
  /// @throws ParameterError if the snapshot is not one of such a feed
  void restore(const Snapshot& snapshot);

 private:
  struct Inlet {
    FedKind fed;
    double cell_area = 0;  // [m^2]
    double radius = 0;     // [m] of the outline
    InflowQueue queue;
    std::vector<Arrival> waiting;
  };
  void look(BlockEnsemble& ensemble, double since);
  std::vector<blocks::CellId> leaving(const BlockEnsemble& ensemble);
  /// Puts whoever waits at an inlet into the ensemble's future, where there is a place.
  void admit(Inlet& inlet, const BlockEnsemble& ensemble, std::vector<EnsembleState>& entering);

  FeedPlan plan_;
  std::vector<Inlet> inlets_;
  std::vector<FeedCounts> counts_;
  std::int64_t interval_ = 1;
  double time_step_ = 0;  // [s]
};

}  // namespace hemoscale::micro
