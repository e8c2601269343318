#include "micro/mps/node_lattice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "micro/error.hpp"
#include "micro/particles/neighbour_table.hpp"
#include "micro/particles/rearrange.hpp"
#include "micro/random/philox.hpp"

namespace hemoscale::micro {

void check(const NodeSpacing& spacing) {
  if (!(spacing.spacing > 0)) {
    throw ParameterError(
        fmt::format("the spacing is {:g} m; it must be positive", spacing.spacing));
  }
  if (!(spacing.disorder >= 0 && spacing.disorder < 0.5)) {
    throw ParameterError(fmt::format(
        "the disorder is {:g} of the spacing; it must be at least 0 and below 0.5, or nodes may "
        "coincide",
        spacing.disorder));
  }
}

template <int dim>
void NodeWriter<dim>::inner(const Vector<dim>& x) {
  Vector<dim> moved = x;
  for (int axis = 0; axis < dim && spacing_.disorder > 0; ++axis) {
    const Draw draw{.seed = spacing_.seed,
                    .stream = static_cast<std::uint64_t>(axis),
                    .counter = static_cast<std::uint64_t>(next_identity_)};
    moved[axis] += spacing_.disorder * spacing_.spacing * (2 * uniform(draw) - 1);
  }
  domain_->particles.append(moved, next_identity_++);
}

template <int dim>
void NodeWriter<dim>::boundary(const Vector<dim>& x, std::int32_t patch, const Vector<dim>& normal,
                               double measure) {
  const ParticleKind kind = domain_->patches[static_cast<std::size_t>(patch)].kind;
  domain_->particles.append(x, next_identity_++, kind, patch, normal, measure);
}

template class NodeWriter<2>;
template class NodeWriter<3>;

namespace {

struct BoundaryNode {
  Vector<2> x;
  Vector<2> normal;
  double measure;
  std::int32_t patch;
};

double length_of(const std::vector<Vector<2>>& points) {
  double length = 0;
  for (std::size_t k = 1; k < points.size(); ++k) length += (points[k] - points[k - 1]).norm();
  return length;
}

/// Nodes at equal distances along a piece, both ends included; normals out of the fluid, which lies
/// on the left.
std::vector<BoundaryNode> place_on(const OutlinePiece& piece, double spacing) {
  const double length = length_of(piece.points);
  if (!(length >= spacing)) {
    throw ParameterError(fmt::format(
        "a piece of the outline of patch {} is {:.4g} m long, shorter than the spacing {:.4g} m",
        piece.patch, length, spacing));
  }
  const auto intervals = static_cast<std::size_t>(std::lround(length / spacing));
  const double step = length / static_cast<double>(intervals);
  std::vector<BoundaryNode> nodes;
  std::size_t segment = 1;
  double passed = 0;  // up to the beginning of the segment
  for (std::size_t k = 0; k <= intervals; ++k) {
    const double along = k == intervals ? length : step * static_cast<double>(k);
    double span = (piece.points[segment] - piece.points[segment - 1]).norm();
    while (segment + 1 < piece.points.size() && along > passed + span) {
      passed += span;
      ++segment;
      span = (piece.points[segment] - piece.points[segment - 1]).norm();
    }
    const Vector<2> direction = (piece.points[segment] - piece.points[segment - 1]) / span;
    const bool is_end = k == 0 || k == intervals;
    nodes.push_back({piece.points[segment - 1] + (along - passed) * direction,
                     Vector<2>(direction[1], -direction[0]), is_end ? step / 2 : step,
                     piece.patch});
  }
  return nodes;
}

/// Nodes of a closed loop; where two pieces meet one node is left.
std::vector<BoundaryNode> place_on(const OutlineLoop& loop, const std::vector<Patch<2>>& patches,
                                   double spacing) {
  std::vector<std::vector<BoundaryNode>> parts;
  for (const OutlinePiece& piece : loop) parts.push_back(place_on(piece, spacing));
  std::vector<BoundaryNode> nodes;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    std::vector<BoundaryNode>& part = parts[p];
    const std::vector<BoundaryNode>& next = parts[(p + 1) % parts.size()];
    if ((part.back().x - next.front().x).norm() > 1e-6 * spacing) {
      throw ParameterError(fmt::format(
          "the outline is open: a piece of patch {} ends at ({:.6g}, {:.6g}) m, the next begins at "
          "({:.6g}, {:.6g}) m",
          part.back().patch, part.back().x[0], part.back().x[1], next.front().x[0],
          next.front().x[1]));
    }
    // The last node of a piece is the first of the next: walls take it, for the fluid sticks there.
    BoundaryNode corner = next.front();
    const auto is_wall = [&](const BoundaryNode& node) {
      return patches[static_cast<std::size_t>(node.patch)].kind == ParticleKind::wall;
    };
    if (is_wall(part.back()) == is_wall(corner)) {
      corner.measure += part.back().measure;
      const Vector<2> mean = part.back().normal + corner.normal;
      if (mean.norm() > 1e-6) corner.normal = mean.normalized();
    } else if (is_wall(part.back())) {
      corner = part.back();
    }
    nodes.insert(nodes.end(), part.begin() + 1, part.end() - 1);
    nodes.push_back(corner);
  }
  return nodes;
}

/// Even-odd rule along the ray in +x.
bool is_inside(const std::vector<OutlineLoop>& loops, const Vector<2>& x) {
  bool inside = false;
  for (const OutlineLoop& loop : loops) {
    for (const OutlinePiece& piece : loop) {
      for (std::size_t k = 1; k < piece.points.size(); ++k) {
        const Vector<2>& a = piece.points[k - 1];
        const Vector<2>& b = piece.points[k];
        if ((a[1] > x[1]) == (b[1] > x[1])) continue;
        if (x[0] < a[0] + (x[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) inside = !inside;
      }
    }
  }
  return inside;
}

double distance_to(const std::vector<OutlineLoop>& loops, const Vector<2>& x) {
  double least = std::numeric_limits<double>::infinity();
  for (const OutlineLoop& loop : loops) {
    for (const OutlinePiece& piece : loop) {
      for (std::size_t k = 1; k < piece.points.size(); ++k) {
        const Vector<2>& a = piece.points[k - 1];
        const Vector<2> along = piece.points[k] - a;
        const double squared = along.squaredNorm();
        const double s =
            squared > 0 ? std::min(1.0, std::max(0.0, (x - a).dot(along) / squared)) : 0.0;
        least = std::min(least, (a + s * along - x).norm());
      }
    }
  }
  return least;
}

/// Whether each point is far enough inside. Distances are measured near boundary nodes only.
std::vector<char> far_inside(const std::vector<Vector<2>>& points,
                             const std::vector<BoundaryNode>& boundary,
                             const std::vector<OutlineLoop>& loops, double spacing) {
  std::vector<Vector<2>> all = points;
  for (const BoundaryNode& node : boundary) all.push_back(node.x);
  NeighbourTable table;
  table.build<2>(all, {}, 1.5 * spacing);
  std::vector<char> result(points.size(), 1);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto near = table.of(i);
    const bool is_near = !near.empty() && static_cast<std::size_t>(near.back()) >= points.size();
    if (is_near && distance_to(loops, points[i]) < clearance * spacing) result[i] = 0;
  }
  return result;
}

}  // namespace

FlowDomain<2> outline_nodes(const std::vector<OutlineLoop>& loops, std::vector<Patch<2>> patches,
                            const NodeSpacing& spacing) {
  check(spacing);
  FlowDomain<2> domain;
  domain.spacing = spacing.spacing;
  domain.patches = std::move(patches);
  std::vector<BoundaryNode> boundary;
  for (const OutlineLoop& loop : loops) {
    const auto nodes = place_on(loop, domain.patches, spacing.spacing);
    boundary.insert(boundary.end(), nodes.begin(), nodes.end());
  }
  Vector<2> lower = boundary.front().x;
  Vector<2> upper = lower;
  for (const BoundaryNode& node : boundary) {
    lower = lower.cwiseMin(node.x);
    upper = upper.cwiseMax(node.x);
  }
  domain.box.lower = lower;
  domain.box.upper = upper;

  // The lattice divides the extents evenly, so that straight channels get whole rows.
  const Vector<2> extent = upper - lower;
  const auto columns = std::lround(extent[0] / spacing.spacing);
  const auto rows = std::lround(extent[1] / spacing.spacing);
  std::vector<Vector<2>> points;
  for (long i = 1; i < columns; ++i) {
    for (long j = 1; j < rows; ++j) {
      const Vector<2> x(
          lower[0] + extent[0] * static_cast<double>(i) / static_cast<double>(columns),
          lower[1] + extent[1] * static_cast<double>(j) / static_cast<double>(rows));
      if (is_inside(loops, x)) points.push_back(x);
    }
  }
  const std::vector<char> keep = far_inside(points, boundary, loops, spacing.spacing);
  NodeWriter<2> write(domain, spacing);
  for (const BoundaryNode& node : boundary) {
    write.boundary(node.x, node.patch, node.normal, node.measure);
  }
  std::size_t inner = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (keep[i] == 0) continue;
    write.inner(points[i]);
    ++inner;
  }
  if (inner == 0) {
    throw ParameterError(
        fmt::format("no node lies inside the outline at a spacing of {:.4g} m; reduce the spacing",
                    spacing.spacing));
  }
  return domain;
}

FlowDomain<2> with_hole(const FlowDomain<2>& domain, const OutlineLoop& hole,
                        std::vector<Patch<2>> patches, const NodeSpacing& spacing) {
  FlowDomain<2> result = domain;
  result.patches = std::move(patches);
  const auto boundary = place_on(hole, result.patches, spacing.spacing);
  const std::vector<OutlineLoop> loops = {hole};
  std::vector<std::int32_t> staying;
  for (std::size_t i = 0; i < result.particles.size(); ++i) {
    const Vector<2>& x = result.particles.positions[i];
    const bool is_fluid = result.particles.kinds[i] == ParticleKind::fluid;
    if (is_fluid && (is_inside(loops, x) || distance_to(loops, x) < clearance * spacing.spacing)) {
      continue;
    }
    staying.push_back(static_cast<std::int32_t>(i));
  }
  rearrange(result.particles, staying);
  std::int64_t identity = static_cast<std::int64_t>(domain.particles.size());
  for (const BoundaryNode& node : boundary) {
    result.particles.append(node.x, identity++,
                            result.patches[static_cast<std::size_t>(node.patch)].kind, node.patch,
                            node.normal, node.measure);
  }
  return result;
}

}  // namespace hemoscale::micro
