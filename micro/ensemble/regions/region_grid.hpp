#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "micro/ensemble/regions/rank_messages.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro::regions {

/// A point that decides where a cell belongs, with the work that the cell makes.
struct CellPlace {
  Vector<2> position = Vector<2>::Zero();  // [um] inside the domain
  std::int64_t weight = 1;                 // nodes
};

/// Columns along the channel, each divided into rows across it: rank = column * rows + row. All
/// columns have the same number of rows, but cut where the cells of the column are halved, so that
/// every rank has the same work to within a cell.
struct RegionGrid {
  int columns = 1;
  int rows = 1;
  std::vector<double> x_cuts;               // [um] columns - 1, rising
  std::vector<std::vector<double>> y_cuts;  // [um] rows - 1 of every column

  int owner(const Vector<2>& position) const;

  /// Middle of the region of a rank, in a domain of this extent [um].
  Vector<2> middle(int rank, const Vector<2>& lower, const Vector<2>& upper) const;
};

/// Columns and rows of as many regions as there are ranks whose borders are shortest together,
/// hence whose copies are fewest: columns alone in a channel that is narrow compared with them.
/// @param periodic_x, periodic_y  whether the last region along x, or y, borders on the first
std::pair<int, int> choose_grid(int ranks, double length, double height, bool periodic_x,
                                bool periodic_y);

/// Cuts where the cells of all ranks, wherever they are now, are divided equally. Collective; the
/// same result on every rank.
RegionGrid cut_regions(const std::vector<CellPlace>& cells, int columns, int rows,
                       const Vector<2>& lower, const Vector<2>& upper,
                       const RankMessages& messages);

}  // namespace hemoscale::micro::regions
