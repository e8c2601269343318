#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "micro/ensemble/blocks/block_ensemble.hpp"
#include "micro/ensemble/regions/region_settings.hpp"
#include "micro/parallel/communicator.hpp"

namespace hemoscale::micro {

/// The block ensemble spread over ranks: every cell is advanced, whole, by the rank in whose region
/// of the channel it was when cells were last dealt out; other ranks have copies of it where it may
/// touch cells of theirs. See micro/ensemble/regions/README.md.
///
/// Prescribed flow: no hydrodynamic interaction, no lift.
///
/// All methods are collective unless they say otherwise. With exchange in every step the bits are
/// those of one rank, for any number of ranks and threads; with fewer exchanges results differ by
/// the error of the copies.
class RegionEnsemble {
 public:
  /// @param part  one state per kind of cell: the cells that this rank brings along. Numbers count
  /// the
  ///              cells of rank 0 first, then those of rank 1, ...; see `part_of_rank`
  /// @throws ParameterError on all ranks if sizes or settings do not fit, all faults at once
  RegionEnsemble(const blocks::BlockSettings& settings, Precision precision,
                 const std::vector<EnsembleState>& part, const Communicator& communicator,
                 const RegionOptions& options = {});
  ~RegionEnsemble();
  RegionEnsemble(RegionEnsemble&&) noexcept;
  RegionEnsemble& operator=(RegionEnsemble&&) noexcept;

  /// @throws NumericalError on all ranks, with the same message, if a segment is stretched or
  ///         compressed beyond `segment_strain_limit`, or a number is not finite, on any of them
  void advance(std::int64_t steps);

  /// Positions of every kind, as BlockEnsemble::states: of all cells on the root or, if
  /// `everywhere`, on every rank; elsewhere states without cells.
  std::vector<EnsembleState> states(bool everywhere = false) const;

  double time() const;                    // [s] not collective, like all up to segment_strain_limit
  std::int64_t step() const;              // [-]
  double image_offset() const;            // [m] of the image above; periodic_y only
  double largest_segment_strain() const;  // [-] in the last stretch, on any rank
  double segment_strain_limit = 1;        // [-]

  /// Everything that continues with the same bits, on any number of ranks if copies are exchanged
  /// in every step; complete on the root, empty elsewhere.
  Snapshot snapshot() const;
  /// @param snapshot  of the root; those of other ranks are not looked at
  /// @throws ParameterError on all ranks if the snapshot is not one of such an ensemble
  void restore(const Snapshot& snapshot);

  const blocks::BlockSettings& settings() const;  // not collective, like all below
  std::int64_t exchange_interval() const;         // [steps]
  const blocks::StepCounters& counters() const;   // of this rank
  RegionCounters region_counters() const;         // of this rank
  const char* kernel_version() const;

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

/// The share of a rank in states that all ranks know: consecutive cells of every kind.
std::vector<EnsembleState> part_of_rank(const std::vector<EnsembleState>& whole,
                                        const Communicator& communicator);

}  // namespace hemoscale::micro
