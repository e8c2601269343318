#include "micro/particles/neighbour_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "micro/error.hpp"

namespace hemoscale::micro {

namespace {

/// A particle, or the image of one that lies within the range of a periodic face.
template <int dim>
struct Placed {
  Vector<dim> x;
  std::int32_t particle;
};

template <int dim>
void check_finite(const std::vector<Vector<dim>>& positions) {
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (!positions[i].allFinite()) {
      throw NumericalError(
          fmt::format("the position of particle {} is not finite; the run is unstable: reduce the "
                      "time step",
                      i));
    }
  }
}

/// Particles in the box and, along periodic axes, their images within `range` of the faces.
template <int dim>
std::vector<Placed<dim>> place(const std::vector<Vector<dim>>& positions,
                               const PeriodicBox<dim>& box, double range) {
  std::vector<Placed<dim>> placed;
  placed.reserve(positions.size() + positions.size() / 8);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    placed.push_back({wrapped(box, positions[i]), static_cast<std::int32_t>(i)});
  }
  // Images along the first axis are made last: those of a sheared box are shifted along it.
  for (int axis = dim - 1; axis >= 0; --axis) {
    if (!box.periodic[static_cast<std::size_t>(axis)]) continue;
    const double extent = box.upper[axis] - box.lower[axis];
    const std::size_t count = placed.size();
    for (std::size_t k = 0; k < count; ++k) {
      for (const double turn : {-1.0, 1.0}) {
        Placed<dim> image = placed[k];
        image.x[axis] += turn * extent;
        if (image.x[axis] < box.lower[axis] - range || image.x[axis] > box.upper[axis] + range) {
          continue;
        }
        if (axis == 1 && box.slide != 0) {
          // The shifted image may leave the box along the first axis.
          image.x[0] += turn * box.slide;
          const double along = box.upper[0] - box.lower[0];
          image.x[0] -= std::floor((image.x[0] - box.lower[0]) / along) * along;
        }
        placed.push_back(image);
      }
    }
  }
  return placed;
}

/// Cells of an edge of at least the range; all that is near a point lies in its cell or the
/// adjacent ones.
template <int dim>
class Grid {
 public:
  Grid(const std::vector<Placed<dim>>& placed, double range) : edge_(range) {
    Vector<dim> upper = placed.front().x;
    lower_ = upper;
    for (const Placed<dim>& p : placed) {
      lower_ = lower_.cwiseMin(p.x);
      upper = upper.cwiseMax(p.x);
    }
    // A few far particles must not make the grid larger than the set.
    for (;;) {
      double cells = 1;
      for (int axis = 0; axis < dim; ++axis) {
        counts_[static_cast<std::size_t>(axis)] =
            static_cast<std::int64_t>((upper[axis] - lower_[axis]) / edge_) + 1;
        cells *= static_cast<double>(counts_[static_cast<std::size_t>(axis)]);
      }
      if (cells <= 4 * static_cast<double>(placed.size()) + 64) break;
      edge_ *= 1.5;
    }
    sort(placed);
  }

  /// Calls visit(first, last) for the runs of sorted particles that hold everything near x: one run
  /// for each row of cells.
  template <typename Visit>
  void visit_rows(const Vector<dim>& x, const Visit& visit) const {
    std::array<std::int64_t, 3> at = {};
    for (int axis = 0; axis < dim; ++axis) at[static_cast<std::size_t>(axis)] = cell(x, axis);
    const std::int64_t z_first = dim == 3 ? std::max<std::int64_t>(at[2] - 1, 0) : 0;
    const std::int64_t z_last = dim == 3 ? std::min(at[2] + 1, counts_[2] - 1) : 0;
    for (std::int64_t z = z_first; z <= z_last; ++z) {
      for (std::int64_t y = std::max<std::int64_t>(at[1] - 1, 0);
           y <= std::min(at[1] + 1, counts_[1] - 1); ++y) {
        const std::int64_t row = (z * counts_[1] + y) * counts_[0];
        const auto from = static_cast<std::size_t>(row + std::max<std::int64_t>(at[0] - 1, 0));
        const auto to = static_cast<std::size_t>(row + std::min(at[0] + 1, counts_[0] - 1));
        visit(first_[from], first_[to + 1]);
      }
    }
  }

  const Placed<dim>& operator[](std::size_t k) const { return sorted_[k]; }

 private:
  std::int64_t cell(const Vector<dim>& x, int axis) const {
    return static_cast<std::int64_t>((x[axis] - lower_[axis]) / edge_);
  }

  void sort(const std::vector<Placed<dim>>& placed) {
    std::size_t cells = 1;
    for (int axis = 0; axis < dim; ++axis) {
      cells *= static_cast<std::size_t>(counts_[static_cast<std::size_t>(axis)]);
    }
    first_.assign(cells + 1, 0);
    std::vector<std::size_t> cell_of(placed.size());
    for (std::size_t k = 0; k < placed.size(); ++k) {
      std::int64_t index = 0;
      for (int axis = dim - 1; axis >= 0; --axis) {
        index = index * counts_[static_cast<std::size_t>(axis)] + cell(placed[k].x, axis);
      }
      cell_of[k] = static_cast<std::size_t>(index);
      ++first_[cell_of[k] + 1];
    }
    for (std::size_t c = 0; c < cells; ++c) first_[c + 1] += first_[c];
    sorted_.resize(placed.size());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t k = 0; k < placed.size(); ++k) sorted_[next[cell_of[k]]++] = placed[k];
  }

  double edge_;
  Vector<dim> lower_;
  std::array<std::int64_t, 3> counts_ = {1, 1, 1};
  std::vector<std::size_t> first_;
  std::vector<Placed<dim>> sorted_;
};

}  // namespace

template <int dim>
void NeighbourTable::build(const std::vector<Vector<dim>>& positions, const PeriodicBox<dim>& box,
                           double radius, double skin) {
  const double range = radius + skin;
  for (int axis = 0; axis < dim; ++axis) {
    if (box.periodic[static_cast<std::size_t>(axis)] && box.extent()[axis] < 2 * range) {
      throw ParameterError(fmt::format(
          "the periodic extent {:.4g} m along axis {} is less than twice the range {:.4g} m of the "
          "particles; enlarge the domain or reduce the spacing or the kernel radius",
          box.extent()[axis], axis, range));
    }
  }
  check_finite(positions);
  skin_ = skin;
  const std::size_t count = positions.size();
  first_.assign(count + 1, 0);
  neighbours_.clear();
  if (count == 0) return;
  const std::vector<Placed<dim>> placed = place(positions, box, range);
  const Grid<dim> grid(placed, range);

  // Blocks of particles are searched one by one, each into an array of its own; the arrays are
  // joined in the order of the blocks, whichever thread has filled them.
  constexpr std::size_t block_length = 2048;
  const std::size_t blocks = (count + block_length - 1) / block_length;
  std::vector<std::vector<std::int32_t>> found(blocks);
  const double range_squared = range * range;
#pragma omp parallel for schedule(dynamic)
  for (std::size_t block = 0; block < blocks; ++block) {
    std::vector<std::int32_t>& mine = found[block];
    const std::size_t last = std::min(count, (block + 1) * block_length);
    for (std::size_t i = block * block_length; i < last; ++i) {
      const Vector<dim> x = placed[i].x;
      const std::size_t start = mine.size();
      grid.visit_rows(x, [&](std::size_t from, std::size_t to) {
        for (std::size_t k = from; k < to; ++k) {
          if ((grid[k].x - x).squaredNorm() < range_squared &&
              grid[k].particle != static_cast<std::int32_t>(i)) {
            mine.push_back(grid[k].particle);
          }
        }
      });
      const auto mine_first = mine.begin() + static_cast<std::ptrdiff_t>(start);
      if (!std::is_sorted(mine_first, mine.end())) std::sort(mine_first, mine.end());
      first_[i + 1] = static_cast<std::int64_t>(mine.size() - start);
    }
  }
  for (std::size_t i = 0; i < count; ++i) first_[i + 1] += first_[i];
  neighbours_.reserve(static_cast<std::size_t>(first_[count]));
  for (const std::vector<std::int32_t>& part : found) {
    neighbours_.insert(neighbours_.end(), part.begin(), part.end());
  }
}

template <int dim>
bool NeighbourTable::is_complete(const std::vector<Vector<dim>>& then,
                                 const std::vector<Vector<dim>>& now,
                                 const PeriodicBox<dim>& box) const {
  if (then.size() != now.size() || now.size() != size()) return false;
  const double allowed = skin_ / 2;
  for (std::size_t i = 0; i < now.size(); ++i) {
    // Written so that a position that is not finite counts as moved.
    if (!(separation(box, then[i], now[i]).squaredNorm() <= allowed * allowed)) return false;
  }
  return true;
}

template void NeighbourTable::build<2>(const std::vector<Vector<2>>&, const PeriodicBox<2>&, double,
                                       double);
template void NeighbourTable::build<3>(const std::vector<Vector<3>>&, const PeriodicBox<3>&, double,
                                       double);
template bool NeighbourTable::is_complete<2>(const std::vector<Vector<2>>&,
                                             const std::vector<Vector<2>>&,
                                             const PeriodicBox<2>&) const;
template bool NeighbourTable::is_complete<3>(const std::vector<Vector<3>>&,
                                             const std::vector<Vector<3>>&,
                                             const PeriodicBox<3>&) const;

}  // namespace hemoscale::micro
