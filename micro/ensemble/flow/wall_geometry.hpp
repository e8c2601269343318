#pragma once

#include <cstddef>
#include <vector>

#include "micro/vector.hpp"

namespace hemoscale::micro {

/// Distance from the nearest wall and the direction away from it.
struct WallDistance {
  double distance = 0;                   // [m] positive in the fluid, negative beyond the wall
  Vector<2> normal = Vector<2>::Zero();  // [-] gradient of the distance, a unit vector
};

/// The walls of a general two-dimensional channel as polylines with the fluid on their left, and
/// the signed distance from them. Immutable: it may be asked from several threads at once.
///
/// The sign is that of the nearest point of a wall: the side of its segment, or at a vertex the
/// side of the sum of the normals of both segments, which is right at convex and concave corners
/// [Baerentzen and Aanaes 2005]. A polyline whose last point is its first is closed; beyond the end
/// of an open one the sign is that of its last segment, continued.
class WallGeometry {
 public:
  /// @param walls  polylines [m]; the fluid lies on the left of the direction of travel
  /// @param reach  [m] distances up to this one are exact; `at` beyond it returns at least `reach`
  /// @throws ParameterError for fewer than two points, coincident neighbours, crossing walls
  WallGeometry(std::vector<std::vector<Vector<2>>> walls, double reach);

  /// Beyond the reach the magnitude is `reach` or more, the sign is right, and the normal may be
  /// zero.
  WallDistance at(const Vector<2>& x) const;

  const std::vector<std::vector<Vector<2>>>& walls() const { return walls_; }
  double reach() const { return reach_; }

 private:
  struct Segment {
    Vector<2> begin, end;        // [m]
    Vector<2> tangent;           // [-]
    Vector<2> at_begin, at_end;  // [-] sums of the normals of the segments that meet there
    double length = 0;           // [m]
    std::size_t wall = 0;
    std::size_t number = 0;  // within its wall
  };
  struct Nearest {
    std::size_t segment = 0;
    double squared = 0;  // [m^2] distance
    double along = 0;    // [m] from the beginning of the segment, from 0 to its length
  };
  /// A block of bins, from the first up to before the last.
  struct Block {
    std::size_t first_column, last_column, first_row, last_row;
  };

  void add_segments(std::size_t wall);
  void lay_bins();
  void fill(const Block& block, const std::vector<std::size_t>& candidates);
  void refuse_crossings() const;
  Nearest nearest(const Vector<2>& x, const std::size_t* first, const std::size_t* last) const;
  WallDistance seen_from(const Vector<2>& x, const Nearest& nearest) const;

  std::vector<std::vector<Vector<2>>> walls_;
  double reach_ = 0;
  std::vector<Segment> segments_;
  std::vector<std::size_t> all_;         // the numbers of all segments
  Vector<2> lower_ = Vector<2>::Zero();  // [m] corner of the bins
  double size_ = 0;                      // [m] edge of a bin
  std::size_t columns_ = 0, rows_ = 0;
  /// Of each bin: the segments that are the nearest of some of its points; none if all its points
  /// lie beyond the reach, then on that side of the walls.
  std::vector<std::vector<std::size_t>> bins_;
  std::vector<bool> is_in_fluid_;
};

}  // namespace hemoscale::micro
