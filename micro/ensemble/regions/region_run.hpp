#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "micro/ensemble/blocks/block_stepper.hpp"
#include "micro/ensemble/blocks/block_store.hpp"
#include "micro/ensemble/regions/halo.hpp"
#include "micro/ensemble/regions/rank_messages.hpp"
#include "micro/ensemble/regions/region_grid.hpp"
#include "micro/ensemble/regions/region_settings.hpp"

namespace hemoscale::micro::regions {

struct WatchReduction;

/// The cells of a rank in one precision: dealing them out, and advancing them between.
template <class Real>
class RegionRun {
 public:
  /// @param kinds  all cells of the ensemble
  /// @param options  with an exchange interval of at least 1
  /// @param start  [s] time of step 0
  RegionRun(const blocks::BlockSettings& settings, const std::vector<blocks::CellKind>& kinds,
            const RegionOptions& options, double start, const RankMessages& messages);
  ~RegionRun();
  RegionRun(const RegionRun&) = delete;
  RegionRun& operator=(const RegionRun&) = delete;

  /// Deals cells out that lie anywhere, with their state at a step. Collective.
  void deal(const std::vector<blocks::CellRecord>& cells, std::int64_t step, double image_offset);

  /// Advances; deals cells out anew when copies have become too many.
  blocks::StretchWatch advance(std::int64_t step, std::int64_t count, double start,
                               double& image_offset);

  /// Own cells with their state at a step.
  std::vector<blocks::CellRecord> cells(std::int64_t step) const;

  const blocks::StepCounters& counters() const { return stepper_.counters(); }
  RegionCounters region_counters() const;

 private:
  blocks::Periodicity periodicity(double image_offset) const;
  Vector<2> home_position(const Vector<2>& frame, double image_offset) const;
  void find_copies(std::int64_t step);
  blocks::SharedWatch join(const blocks::SharedWatch& own);

  blocks::BlockSettings settings_;
  std::vector<blocks::CellKind> kinds_;
  RegionOptions options_;
  const RankMessages& messages_;
  blocks::BlockStore<Real> store_;
  blocks::BlockStepper<Real> stepper_;
  Halo<Real> halo_;
  std::unique_ptr<WatchReduction> reduction_;  // of the watches of all ranks
  Vector<2> middle_ = Vector<2>::Zero();       // [um] of the own region
  std::int64_t copies_when_dealt_ = -1;        // of all ranks; -1: not counted since
  std::size_t spread_when_dealt_ = 0;          // [-] of the blocks, see BlockStepper
  bool must_deal_ = false;
  double image_offset_ = 0;  // [m] at first_step_
  double slide_ = 0;         // [m] in a step
  std::int64_t first_step_ = 0;
  RegionCounters counters_;
};

}  // namespace hemoscale::micro::regions
