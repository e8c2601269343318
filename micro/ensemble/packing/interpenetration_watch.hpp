#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "micro/ensemble/packing/cell_room.hpp"
#include "micro/ensemble/state.hpp"

namespace hemoscale::micro {

/// Looks every so many steps of a run whether nodes have entered other cells: contacts are forces
/// between nodes, and a step that is too long, or a contact that is too soft, lets them pass. One
/// look costs as much as 20 to 30 steps (0.15 us per node), so every 1000 steps it is not felt.
class InterpenetrationWatch {
 public:
  /// @throws ParameterError unless the interval is positive
  explicit InterpenetrationWatch(std::int64_t interval);

  /// Whether a step is one of those that are looked at, counted from step 0.
  bool is_due(std::int64_t step) const { return step % interval_ == 0; }

  /// Counts, and keeps the largest count with its step.
  /// @returns nodes inside other cells now
  std::size_t look(std::int64_t step, std::span<const EnsembleState> kinds, const CellRoom& room);

  std::int64_t looks() const { return looks_; }
  std::size_t largest() const { return largest_; }  // nodes inside other cells
  std::int64_t step_of_largest() const { return step_of_largest_; }

 private:
  std::int64_t interval_ = 0;
  std::int64_t looks_ = 0;
  std::size_t largest_ = 0;
  std::int64_t step_of_largest_ = 0;
};

}  // namespace hemoscale::micro
