#include "micro/ensemble/regions/region_grid.hpp"

#include <algorithm>
#include <cstddef>

namespace hemoscale::micro::regions {
namespace {

constexpr std::size_t bins = 32;
constexpr int refinements = 8;  // 32^8 = 1e12 places in the domain

/// A coordinate of a cell within its group of cells.
struct Coordinate {
  std::size_t group;
  double value;
  std::int64_t weight;
};

/// A cut that is being searched for.
struct Search {
  double low, high;     // it lies between
  std::int64_t below;   // weight below low
  std::int64_t wanted;  // weight below the cut
};

/// Divides every group into parts of equal weight. Every refinement counts the cells of all ranks
/// in the bins of all intervals at once; numbers are whole, so that all ranks see the same.
std::vector<std::vector<double>> cut_equally(const std::vector<Coordinate>& cells,
                                             std::size_t groups, int parts, double low, double high,
                                             const RankMessages& messages) {
  std::vector<std::int64_t> total(groups, 0);
  for (const Coordinate& cell : cells) total[cell.group] += cell.weight;
  total = messages.sum(std::move(total));
  const auto cuts = static_cast<std::size_t>(parts - 1);
  std::vector<Search> searches;
  for (std::size_t group = 0; group < groups; ++group) {
    for (std::size_t k = 1; k <= cuts; ++k) {
      searches.push_back({low, high, 0, total[group] * static_cast<std::int64_t>(k) / parts});
    }
  }
  for (int refinement = 0; refinement < refinements && cuts > 0; ++refinement) {
    std::vector<std::int64_t> counts(searches.size() * bins, 0);
    for (const Coordinate& cell : cells) {
      for (std::size_t k = cell.group * cuts; k < (cell.group + 1) * cuts; ++k) {
        const Search& s = searches[k];
        if (cell.value < s.low || cell.value >= s.high) continue;
        const double bin = static_cast<double>(bins) * (cell.value - s.low) / (s.high - s.low);
        counts[k * bins + std::min(static_cast<std::size_t>(bin), bins - 1)] += cell.weight;
      }
    }
    counts = messages.sum(std::move(counts));
    for (std::size_t k = 0; k < searches.size(); ++k) {
      Search& s = searches[k];
      std::size_t bin = 0;
      while (bin + 1 < bins && s.below + counts[k * bins + bin] <= s.wanted) {
        s.below += counts[k * bins + bin];
        ++bin;
      }
      const double width = (s.high - s.low) / static_cast<double>(bins);
      s.low += width * static_cast<double>(bin);
      s.high = s.low + width;
    }
  }
  std::vector<std::vector<double>> result(groups);
  for (std::size_t k = 0; k < searches.size(); ++k) result[k / cuts].push_back(searches[k].low);
  return result;
}

std::size_t part_of(const std::vector<double>& cuts, double value) {
  return static_cast<std::size_t>(std::upper_bound(cuts.begin(), cuts.end(), value) - cuts.begin());
}

}  // namespace

int RegionGrid::owner(const Vector<2>& position) const {
  const std::size_t column = part_of(x_cuts, position.x());
  return static_cast<int>(column) * rows + static_cast<int>(part_of(y_cuts[column], position.y()));
}

Vector<2> RegionGrid::middle(int rank, const Vector<2>& lower, const Vector<2>& upper) const {
  const auto centre_of = [](const std::vector<double>& cuts, int part, double low, double high) {
    const auto k = static_cast<std::size_t>(part);
    return 0.5 * ((k == 0 ? low : cuts[k - 1]) + (k == cuts.size() ? high : cuts[k]));
  };
  const int column = rank / rows;
  return {centre_of(x_cuts, column, lower.x(), upper.x()),
          centre_of(y_cuts[static_cast<std::size_t>(column)], rank % rows, lower.y(), upper.y())};
}

std::pair<int, int> choose_grid(int ranks, double length, double height, bool periodic_x,
                                bool periodic_y) {
  std::pair<int, int> best{ranks, 1};
  double shortest = -1;
  for (int rows = 1; rows <= ranks; ++rows) {
    if (ranks % rows != 0) continue;
    const int columns = ranks / rows;
    const auto borders = [](int parts, bool periodic) {
      return parts == 1 ? 0 : parts - (periodic ? 0 : 1);
    };
    const double border =
        borders(columns, periodic_x) * height + borders(rows, periodic_y) * length;
    if (shortest < 0 || border < shortest) {
      shortest = border;
      best = {columns, rows};
    }
  }
  return best;
}

RegionGrid cut_regions(const std::vector<CellPlace>& cells, int columns, int rows,
                       const Vector<2>& lower, const Vector<2>& upper,
                       const RankMessages& messages) {
  RegionGrid grid;
  grid.columns = columns;
  grid.rows = rows;
  std::vector<Coordinate> along;
  for (const CellPlace& cell : cells) along.push_back({0, cell.position.x(), cell.weight});
  grid.x_cuts = cut_equally(along, 1, columns, lower.x(), upper.x(), messages).front();
  std::vector<Coordinate> across;
  for (const CellPlace& cell : cells) {
    across.push_back({part_of(grid.x_cuts, cell.position.x()), cell.position.y(), cell.weight});
  }
  grid.y_cuts =
      cut_equally(across, static_cast<std::size_t>(columns), rows, lower.y(), upper.y(), messages);
  return grid;
}

}  // namespace hemoscale::micro::regions
