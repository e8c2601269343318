#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "micro/ensemble/packing/cell_room.hpp"
#include "micro/ensemble/packing/draws.hpp"
#include "micro/ensemble/packing/near_cells.hpp"
#include "micro/ensemble/state.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// An outline turned by an angle [rad] about its origin and put to a place.
std::vector<Vector<2>> placed(std::span<const Vector<2>> outline, const Vector<2>& place,
                              double angle);

/// Adds a cell to a state of cells with as many nodes.
void append_cell(std::span<const Vector<2>> ring, EnsembleState& state);

/// How near to each other cells may be put.
struct Clearance {
  double cells = 0;  // [m] between nodes; never less than the spacing of nodes
  double walls = 0;  // [m] of nodes
};

/// Cells that stand where they are, and whether one more fits between them.
///
/// Two outlines whose nodes are all farther apart than the mean of their largest segments cannot
/// cross: at a crossing, an end of either segment lies within half its length. So nodes alone are
/// compared, at the clearance or at this distance if it is larger, and one node of each is looked
/// for inside the other.
class Occupancy {
 public:
  /// @param largest_cell  [m] about the largest extent of the cells: size of the bins
  /// @throws ParameterError for a size or clearance that is negative or not finite
  Occupancy(const CellRoom& room, const Clearance& clearance, double largest_cell);

  void add(std::span<const Vector<2>> ring);
  void add(const EnsembleState& state);

  /// Whether a cell could stand there: in the fluid, before the openings and apart from all others.
  bool admits(std::span<const Vector<2>> ring) const;

  std::size_t cells() const { return cells_.size(); }

 private:
  struct Cell {
    Bounds bounds;
    std::size_t first = 0, nodes = 0;  // in nodes_
    double spacing = 0;                // [m] largest segment
  };
  bool lies_in_fluid(std::span<const Vector<2>> ring) const;
  bool is_apart(std::span<const Vector<2>> ring, const Cell& mine, const Cell& other,
                const Vector<2>& displacement) const;
  Cell measured(std::span<const Vector<2>> ring) const;
  /// The bin of a place, and the displacement [m] that brings what is stored in it to that place.
  struct Bin {
    std::uint64_t key = 0;
    Vector<2> displacement = Vector<2>::Zero();
  };
  Bin bin(std::int64_t column, std::int64_t row) const;
  std::int64_t row_of(double y) const;
  std::int64_t column_of(double x, std::int64_t row) const;

  CellRoom room_;
  Clearance clearance_;
  Vector<2> size_ = Vector<2>::Ones();   // [m] of a bin
  std::int64_t columns_ = 0, rows_ = 0;  // that repeat; 0: none do
  Vector<2> reach_ = Vector<2>::Zero();  // [m] half the largest cell so far
  double spacing_ = 0;                   // [m] largest segment so far
  std::vector<Cell> cells_;
  std::vector<Vector<2>> nodes_;  // [m]
  std::unordered_map<std::uint64_t, std::vector<std::size_t>> bins_;
};

/// Puts cells of one outline to random places at random angles, one after the other, where they
/// fit.
/// @param region    where centres may lie
/// @param attempts  places that are tried in vain for one cell before giving up
/// @returns as many as were placed, at most `cells`; they are in the occupancy too
EnsembleState insert_at_random(Occupancy& occupancy, std::span<const Vector<2>> outline,
                               std::size_t cells, const Bounds& region, Draws& draws,
                               int attempts = 1000);

/// Where a place for a cell is looked for.
struct Search {
  Vector<2> place = Vector<2>::Zero();  // [m] wanted
  double angle = 0;                     // [rad] wanted
  Vector<2> along = Vector<2>(1, 0);    // unit vector; tried to either side
  double reach_along = 0;               // [m]
  Vector<2> back = Vector<2>(0, 1);     // unit vector; tried to one side
  double reach_back = 0;                // [m]
  double step = 0.25e-6;                // [m]
  int angles = 6;                       // evenly over half a turn
};

/// The free place nearest to the wanted one, at the wanted angle if that is free.
/// @returns the nodes of the cell there, or nothing if no place is free
std::optional<std::vector<Vector<2>>> free_place(const Occupancy& occupancy,
                                                 std::span<const Vector<2>> outline,
                                                 const Search& search);

}  // namespace hemoscale::micro
