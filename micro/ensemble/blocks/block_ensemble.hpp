#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "micro/ensemble/blocks/block_settings.hpp"
#include "micro/ensemble/blocks/block_stepper.hpp"
#include "micro/ensemble/state.hpp"
#include "micro/model.hpp"

namespace hemoscale::micro {

/// Precision of the offsets of nodes from the frames of their cells; frames are always double.
enum class Precision { single, twofold };

/// Many deformable cells in a given flow [Tsubota2006, section 3.3], a cell per lane of the vector
/// units: the fast counterpart of EnsembleModel, which solves the same equations by explicit steps
/// in double precision. See micro/ensemble/blocks/README.md.
///
/// Prescribed flow: no hydrodynamic interaction, no lift.
///
/// Bits depend on settings and initial state, and on the version of the kernels (the instruction
/// set); not on threads, lists, nor on when a snapshot was taken.
class BlockEnsemble {
 public:
  /// @param initial  one state per kind of cell, in the order of settings.kinds; nodes as its mesh
  /// @throws ParameterError if sizes or settings do not fit, all faults at once
  BlockEnsemble(const blocks::BlockSettings& settings, Precision precision,
                const std::vector<EnsembleState>& initial);
  ~BlockEnsemble();
  BlockEnsemble(BlockEnsemble&&) noexcept;
  BlockEnsemble& operator=(BlockEnsemble&&) noexcept;

  /// @throws NumericalError with step, time, cell, value, limit and remedy if a segment is
  /// stretched or
  ///         compressed beyond `segment_strain_limit`, or a number is not finite
  void advance(std::int64_t steps);

  /// Positions of every kind, cells in the order of their numbers, whole, in the unwrapped
  /// coordinates in which they move: the period is not subtracted.
  std::vector<EnsembleState> states() const;

  /// Numbers of the cells of states(), kind after kind, ascending. A number is never given twice.
  std::vector<std::vector<blocks::CellId>> identities() const;

  /// A point within half a micrometre of the mean of the nodes, for each of these cells [m].
  std::vector<std::vector<Vector<2>>> frames() const;

  /// Nodes of one cell [m].
  /// @throws ParameterError if it is not there
  std::vector<Vector<2>> nodes_of(blocks::CellId cell) const;

  /// Takes cells out and puts others in, between two steps; nothing changes for those that stay.
  /// Costs as much as a few steps.
  /// @param leaving   numbers of cells that are there
  /// @param entering  one state per kind, as at construction; they begin to move with the flow
  /// @returns numbers of those that entered, kind after kind: the next that were never given
  /// @throws ParameterError for numbers that are not there, states that do not fit
  std::vector<blocks::CellId> exchange(const std::vector<blocks::CellId>& leaving,
                                       const std::vector<EnsembleState>& entering);

  double time() const;                    // [s]
  std::int64_t step() const;              // [-]
  double image_offset() const;            // [m] of the image above; periodic_y only
  double largest_segment_strain() const;  // [-] in the last stretch
  double segment_strain_limit = 1;        // [-]

  /// Everything that continues with the same bits.
  Snapshot snapshot() const;
  /// @throws ParameterError if the snapshot is not one of such an ensemble
  void restore(const Snapshot& snapshot);

  const blocks::BlockSettings& settings() const;
  const blocks::StepCounters& counters() const;
  const char* kernel_version() const;  // plain, v3 or v4

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace hemoscale::micro
