#include "micro/cells/ring_mesh.hpp"

#include <fmt/core.h>

#include <cmath>
#include <cstddef>
#include <numbers>

#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

/// theta0 of a node that stands for a length of the membrane.
double angle_of_curvature(double curvature, double node_length, std::size_t node) {
  const double angle = curvature * node_length;
  if (!(std::abs(angle) < std::numbers::pi)) {
    throw ParameterError(
        fmt::format("ring: a spontaneous curvature of {} 1/m turns the membrane by {} rad at node "
                    "{}; it must be less than pi; use more nodes or less curvature",
                    curvature, angle, node));
  }
  return angle;
}

double cross(const Vector<2>& a, const Vector<2>& b) {
  return a.x() * b.y() - a.y() * b.x();
}

}  // namespace

RingMesh make_ring_mesh(const std::vector<Vector<2>>& polygon, NaturalShape natural_shape,
                        double spontaneous_curvature) {
  const std::size_t n = polygon.size();
  if (n < 3) {
    throw ParameterError(fmt::format("ring of {} nodes; at least 3 enclose an area; add nodes", n));
  }
  if (natural_shape != NaturalShape::curvature && spontaneous_curvature != 0) {
    throw ParameterError(fmt::format(
        "ring: spontaneous curvature {} 1/m, but the natural shape is not of uniform curvature; "
        "choose the natural shape `curvature`, or 0",
        spontaneous_curvature));
  }
  RingMesh mesh;
  mesh.nodes = static_cast<int>(n);
  mesh.rest_length.resize(n);
  mesh.node_length.resize(n);
  mesh.natural_angle.resize(n);
  mesh.natural_half_tangent.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Vector<2> segment = polygon[(i + 1) % n] - polygon[i];
    mesh.rest_length[i] = segment.norm();
    if (!(mesh.rest_length[i] > 0) || !std::isfinite(mesh.rest_length[i])) {
      throw ParameterError(
          fmt::format("ring: the distance from node {} to the next is {} m; it must be finite and "
                      "positive; space "
                      "the nodes evenly",
                      i, mesh.rest_length[i]));
    }
    mesh.rest_perimeter += mesh.rest_length[i];
    mesh.rest_area += 0.5 * cross(polygon[i] - polygon[0], polygon[(i + 1) % n] - polygon[0]);
  }
  if (!(mesh.rest_area > 0)) {
    throw ParameterError(
        fmt::format("ring: the enclosed area is {} m^2; it must be positive; number the nodes "
                    "counter-clockwise",
                    mesh.rest_area));
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t before = (i + n - 1) % n;
    mesh.node_length[i] = 0.5 * (mesh.rest_length[before] + mesh.rest_length[i]);
    if (natural_shape == NaturalShape::outline) {
      const Vector<2> incoming = polygon[i] - polygon[before];
      const Vector<2> outgoing = polygon[(i + 1) % n] - polygon[i];
      mesh.natural_angle[i] = std::atan2(cross(incoming, outgoing), incoming.dot(outgoing));
    } else if (natural_shape == NaturalShape::curvature) {
      mesh.natural_angle[i] = angle_of_curvature(spontaneous_curvature, mesh.node_length[i], i);
    }
    mesh.natural_half_tangent[i] = std::tan(0.5 * mesh.natural_angle[i]);
  }
  return mesh;
}

}  // namespace hemoscale::micro
