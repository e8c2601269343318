#include "micro/ensemble/flow/wall_geometry.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

constexpr double most_bins = 4e4;

double cross(const Vector<2>& a, const Vector<2>& b) {
  return a[0] * b[1] - a[1] * b[0];
}

Vector<2> left_of(const Vector<2>& direction) {
  return {-direction[1], direction[0]};
}

std::string written(const Vector<2>& x) {
  return fmt::format("({:.9g}, {:.9g}) m", x[0], x[1]);
}

/// Whether two segments have a point in common, to rounding.
bool meet(const Vector<2>& a, const Vector<2>& b, const Vector<2>& c, const Vector<2>& d) {
  const double scale = std::max((b - a).norm(), (d - c).norm());
  const double margin = 1e-9 * scale * scale;
  if (std::max(a[0], b[0]) + 1e-9 * scale < std::min(c[0], d[0]) ||
      std::max(c[0], d[0]) + 1e-9 * scale < std::min(a[0], b[0]) ||
      std::max(a[1], b[1]) + 1e-9 * scale < std::min(c[1], d[1]) ||
      std::max(c[1], d[1]) + 1e-9 * scale < std::min(a[1], b[1])) {
    return false;
  }
  const double c_side = cross(b - a, c - a);
  const double d_side = cross(b - a, d - a);
  const double a_side = cross(d - c, a - c);
  const double b_side = cross(d - c, b - c);
  const bool splits_cd = std::min(c_side, d_side) <= margin && std::max(c_side, d_side) >= -margin;
  const bool splits_ab = std::min(a_side, b_side) <= margin && std::max(a_side, b_side) >= -margin;
  return splits_cd && splits_ab;
}

}  // namespace

WallGeometry::WallGeometry(std::vector<std::vector<Vector<2>>> walls, double reach)
    : walls_(std::move(walls)), reach_(reach) {
  if (!(reach > 0) || !std::isfinite(reach)) {
    throw ParameterError(
        fmt::format("walls: reach {} m; it must be finite and positive; give the distance within "
                    "which walls are felt",
                    reach));
  }
  if (walls_.empty()) throw ParameterError("walls: there are none; give a polyline at least");
  for (std::size_t wall = 0; wall < walls_.size(); ++wall) add_segments(wall);
  for (std::size_t k = 0; k < segments_.size(); ++k) all_.push_back(k);
  lay_bins();
  refuse_crossings();
}

void WallGeometry::add_segments(std::size_t wall) {
  const std::vector<Vector<2>>& points = walls_[wall];
  if (points.size() < 2) {
    throw ParameterError(fmt::format(
        "walls: wall {} has {} points; a polyline has at least two; add some or leave it out", wall,
        points.size()));
  }
  const std::size_t first = segments_.size();
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    Segment s;
    s.begin = points[k];
    s.end = points[k + 1];
    s.length = (s.end - s.begin).norm();
    if (!(s.length > 0) || !std::isfinite(s.length)) {
      throw ParameterError(
          fmt::format("walls: points {} and {} of wall {} coincide or are not finite, at {}; leave "
                      "one of them out",
                      k, k + 1, wall, written(s.begin)));
    }
    s.tangent = (s.end - s.begin) / s.length;
    s.at_begin = s.at_end = left_of(s.tangent);
    s.wall = wall;
    s.number = k;
    segments_.push_back(s);
  }
  const std::size_t count = segments_.size() - first;
  const bool is_closed = points.front() == points.back();
  for (std::size_t k = 0; k < count; ++k) {
    if (k + 1 == count && !is_closed) break;
    Segment& a = segments_[first + k];
    Segment& b = segments_[first + (k + 1) % count];
    const Vector<2> sum = left_of(a.tangent) + left_of(b.tangent);
    if (sum.norm() < 1e-6) {
      throw ParameterError(
          fmt::format("walls: wall {} folds back upon itself at {}; round its tip by two corners",
                      wall, written(a.end)));
    }
    a.at_end = b.at_begin = sum;
  }
}

void WallGeometry::lay_bins() {
  Vector<2> lower = segments_.front().begin;
  Vector<2> upper = lower;
  for (const Segment& s : segments_) {
    lower = lower.cwiseMin(s.begin).cwiseMin(s.end);
    upper = upper.cwiseMax(s.begin).cwiseMax(s.end);
  }
  lower_ = lower - Vector<2>::Constant(reach_);
  const Vector<2> extent = upper - lower + Vector<2>::Constant(2 * reach_);
  size_ = std::max(0.5 * reach_, std::sqrt(extent[0] * extent[1] / most_bins));
  columns_ = static_cast<std::size_t>(std::ceil(extent[0] / size_));
  rows_ = static_cast<std::size_t>(std::ceil(extent[1] / size_));
  bins_.resize(columns_ * rows_);
  is_in_fluid_.resize(bins_.size(), false);
  fill({0, columns_, 0, rows_}, all_);
}

/// Blocks are halved until they are bins. The nearest segment of any point of a block is no further
/// from the centre of the block than that of the centre plus the diagonal; the others are dropped
/// on the way.
void WallGeometry::fill(const Block& block, const std::vector<std::size_t>& candidates) {
  const std::size_t width = block.last_column - block.first_column;
  const std::size_t height = block.last_row - block.first_row;
  const Vector<2> extent =
      size_ * Vector<2>(static_cast<double>(width), static_cast<double>(height));
  const Vector<2> corner = lower_ + size_ * Vector<2>(static_cast<double>(block.first_column),
                                                      static_cast<double>(block.first_row));
  const Vector<2> centre = corner + 0.5 * extent;
  const double diagonal = extent.norm();
  const Nearest least = nearest(centre, candidates.data(), candidates.data() + candidates.size());
  const double distance = std::sqrt(least.squared);
  // No wall comes near: the whole block lies on one side.
  if (distance > reach_ + 0.5 * diagonal) {
    const bool is_in_fluid = seen_from(centre, least).distance > 0;
    for (std::size_t row = block.first_row; row < block.last_row; ++row) {
      for (std::size_t column = block.first_column; column < block.last_column; ++column) {
        is_in_fluid_[row * columns_ + column] = is_in_fluid;
      }
    }
    return;
  }
  std::vector<std::size_t> near;
  const double furthest = (distance + diagonal) * (1 + 1e-12);
  for (const std::size_t k : candidates) {
    if (nearest(centre, &k, &k + 1).squared <= furthest * furthest) near.push_back(k);
  }
  if (width == 1 && height == 1) {
    bins_[block.first_row * columns_ + block.first_column] = std::move(near);
    return;
  }
  Block one = block;
  Block other = block;
  if (width >= height) {
    one.last_column = other.first_column = block.first_column + width / 2;
  } else {
    one.last_row = other.first_row = block.first_row + height / 2;
  }
  fill(one, near);
  fill(other, near);
}

void WallGeometry::refuse_crossings() const {
  for (const std::vector<std::size_t>& bin : bins_) {
    for (std::size_t i = 0; i < bin.size(); ++i) {
      for (std::size_t j = i + 1; j < bin.size(); ++j) {
        const Segment& a = segments_[bin[i]];
        const Segment& b = segments_[bin[j]];
        const bool are_neighbours = a.wall == b.wall && (a.end == b.begin || b.end == a.begin);
        if (are_neighbours || !meet(a.begin, a.end, b.begin, b.end)) continue;
        throw ParameterError(
            fmt::format("walls: segment {} of wall {} (from {} to {}) and segment {} of wall {} "
                        "(from {} to {}) "
                        "cross or touch; separate them, or join walls that meet into one polyline",
                        a.number, a.wall, written(a.begin), written(a.end), b.number, b.wall,
                        written(b.begin), written(b.end)));
      }
    }
  }
}

WallGeometry::Nearest WallGeometry::nearest(const Vector<2>& x, const std::size_t* first,
                                            const std::size_t* last) const {
  Nearest result;
  result.squared = std::numeric_limits<double>::infinity();
  for (const std::size_t* k = first; k != last; ++k) {
    const Segment& s = segments_[*k];
    const Vector<2> d = x - s.begin;
    const double along = d.dot(s.tangent);
    double squared = 0;
    double place = along;
    if (along <= 0) {
      place = 0;
      squared = d.squaredNorm();
    } else if (along >= s.length) {
      place = s.length;
      squared = (x - s.end).squaredNorm();
    } else {
      const double across = cross(s.tangent, d);
      squared = across * across;
    }
    if (squared < result.squared) result = {*k, squared, place};
  }
  return result;
}

WallDistance WallGeometry::seen_from(const Vector<2>& x, const Nearest& nearest) const {
  const Segment& s = segments_[nearest.segment];
  const bool is_at_begin = nearest.along <= 0;
  if (!is_at_begin && nearest.along < s.length) {
    return {cross(s.tangent, x - s.begin), left_of(s.tangent)};
  }
  const Vector<2> d = x - (is_at_begin ? s.begin : s.end);
  const Vector<2>& outward = is_at_begin ? s.at_begin : s.at_end;
  const double distance = d.norm();
  const double side = d.dot(outward) < 0 ? -1 : 1;
  // On the vertex itself the direction is lost to rounding.
  if (distance < 1e-9 * s.length) return {side * distance, outward.normalized()};
  return {side * distance, side * d / distance};
}

WallDistance WallGeometry::at(const Vector<2>& x) const {
  const Vector<2> place = (x - lower_) / size_;
  const bool is_in_bins = place[0] >= 0 && place[1] >= 0 &&
                          place[0] < static_cast<double>(columns_) &&
                          place[1] < static_cast<double>(rows_);
  if (!is_in_bins) return seen_from(x, nearest(x, all_.data(), all_.data() + all_.size()));
  const std::size_t bin =
      static_cast<std::size_t>(place[1]) * columns_ + static_cast<std::size_t>(place[0]);
  const std::vector<std::size_t>& near = bins_[bin];
  if (near.empty()) return {is_in_fluid_[bin] ? reach_ : -reach_, Vector<2>::Zero()};
  return seen_from(x, nearest(x, near.data(), near.data() + near.size()));
}

}  // namespace hemoscale::micro
