#include "micro/mps/node_shifting.hpp"

#include "micro/particles/weight.hpp"

namespace hemoscale::micro {

namespace {

constexpr double reach = 2;       // [-] of the kernel over the spacing
constexpr double strength = 0.2;  // [-] of one sweep, over the spacing
constexpr int sweeps = 4;
constexpr double wall_distance = 0.5;     // [-] over the spacing: no shift towards a wall within it
constexpr double opening_distance = 1.0;  // [-] no shift at all

/// Takes off the part of a shift that leads into a boundary node nearby.
template <int dim>
void keep_off(const NodeGeometry<dim>& nodes, std::size_t boundary, const Vector<dim>& place,
              Vector<dim>& shift) {
  const ParticleKind kind = nodes.kinds[boundary];
  if (kind == ParticleKind::fluid) return;
  const Vector<dim> r = separation(nodes.box, place, nodes.positions[boundary]);
  if (r.squaredNorm() > nodes.spacing * nodes.spacing) return;
  const Vector<dim>& normal = nodes.normals[boundary];
  const double distance = r.dot(normal);
  if (kind == ParticleKind::wall) {
    const double towards = shift.dot(normal);
    if (distance < wall_distance * nodes.spacing && towards > 0) shift -= towards * normal;
  } else if (distance < opening_distance * nodes.spacing) {
    shift.setZero();
  }
}

}  // namespace

template <int dim>
std::vector<Vector<dim>> shifting_displacements(const NodeGeometry<dim>& nodes, double largest) {
  const double radius = reach * nodes.spacing;
  std::vector<Vector<dim>> places = nodes.positions;
  std::vector<Vector<dim>> shifts(nodes.size(), Vector<dim>::Zero());
  for (int sweep = 0; sweep < sweeps; ++sweep) {
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (nodes.kinds[i] != ParticleKind::fluid) continue;
      Vector<dim> sum = Vector<dim>::Zero();
      for (std::size_t k = nodes.table.begin(i); k < nodes.table.end(i); ++k) {
        const Vector<dim> r = separation(nodes.box, places[i], places[nodes.table[k]]);
        const double distance = r.norm();
        sum -= compact_weight(distance, radius) / distance * r;
      }
      shifts[i] += strength * nodes.spacing * sum;
      for (std::size_t k = nodes.table.begin(i); k < nodes.table.end(i); ++k) {
        keep_off(nodes, nodes.table[k], places[i], shifts[i]);
      }
      const double length = shifts[i].norm();
      if (length > largest) shifts[i] *= largest / length;
    }
    for (std::size_t i = 0; i < nodes.size(); ++i) places[i] = nodes.positions[i] + shifts[i];
  }
  return shifts;
}

template std::vector<Vector<2>> shifting_displacements<2>(const NodeGeometry<2>&, double);
template std::vector<Vector<3>> shifting_displacements<3>(const NodeGeometry<3>&, double);

}  // namespace hemoscale::micro
