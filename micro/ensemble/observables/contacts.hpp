#pragma once

#include <cstddef>
#include <limits>

#include "micro/ensemble/box.hpp"
#include "micro/ensemble/neighbour_list.hpp"
#include "micro/ensemble/observables/node_forces.hpp"
#include "micro/ensemble/state.hpp"

namespace hemoscale::micro {

/// How close the cells of one kind are to each other. Images of a cell count as other cells.
struct Contacts {
  std::size_t pairs_within_cutoff = 0;  // of nodes of different cells, every pair once
  std::size_t pairs_within_rest = 0;    // of these, those that repel each other
  std::size_t cells_in_contact = 0;     // with a node within the rest distance of another cell
  double coordination = 0;              // [-] mean number of cells within the cutoff of a cell
  double closest = std::numeric_limits<double>::infinity();  // [m] smallest distance of nodes of
                                                             // different cells; infinite beyond the
                                                             // range of the list
  std::size_t nodes_inside = 0;                              // nodes inside another cell: overlap
};

/// Longest segment of the rings [m].
double longest_segment(const EnsembleState& state);

/// Overlap is looked for between cells that the list joins. Outlines that cross have nodes closer
/// than their longest segment; a cell wholly inside another, farther than the range from its
/// outline, is not found.
/// @param list  built for these positions with a range of at least the cutoff and the longest
///              segment
Contacts count_contacts(const EnsembleState& state, const Box& box, const NeighbourList& list,
                        const PairLaw& law);

}  // namespace hemoscale::micro
