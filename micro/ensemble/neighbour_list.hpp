#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "micro/ensemble/box.hpp"
#include "micro/ensemble/state.hpp"

namespace hemoscale::micro {

struct Neighbour {
  std::int32_t node = 0;
  std::int32_t image = 0;  // see Image
};

/// Full neighbour list: for every node, the nodes of other cells, or of other images of its own
/// cell, within a range. Each node owns its sum, hence threads never write to the same place. The
/// partners of a node are in the order of their numbers: partners beyond the cutoff add exact
/// zeros, so the sum does not depend on when, or with which range, the list was built. Threads
/// share the search; the list does not depend on their number.
class NeighbourList {
 public:
  /// Rebuild for the present positions; a grid of bins makes the cost proportional to the nodes.
  /// @pre the range is less than half the length and height of the box
  /// @throws NumericalError with step, time, cell and node if a cell has been torn apart
  void build(const EnsembleState& state, const Box& box, double range);

  std::span<const Neighbour> of(std::size_t node) const {
    return {entries_.data() + first_[node], entries_.data() + first_[node + 1]};
  }
  std::size_t size() const { return entries_.size(); }

 private:
  void place_nodes(const EnsembleState& state, const Box& box, double range);
  void find_partners(std::size_t node, const EnsembleState& state, const Box& box, double range,
                     std::vector<Neighbour>& found) const;

  std::vector<std::size_t> first_;
  std::vector<Neighbour> entries_;
  std::vector<std::vector<Neighbour>> found_;  // by parts of the nodes

  // Scratch: nodes moved into the box and sorted into bins.
  struct Placed {
    double x, y;  // [m] in the box
    std::int32_t node;
    std::int32_t column, row;  // the node lies at (x + column length + row offset, y + row height)
  };
  std::vector<Placed> placed_;  // by node
  std::vector<Placed> sorted_;  // by bin
  std::vector<std::size_t> bin_first_;
  std::vector<std::size_t> bin_of_;
  int columns_ = 1;
  int rows_ = 1;
};

}  // namespace hemoscale::micro
