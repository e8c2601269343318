#include "micro/mps/flow_figures.hpp"

#include <array>
#include <cmath>

namespace hemoscale::micro {

template <int dim>
double kinetic_energy(const ParticleSet<dim>& particles, double density, double spacing) {
  double sum = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (particles.kinds[i] == ParticleKind::fluid) sum += particles.velocities[i].squaredNorm();
  }
  return density * std::pow(spacing, dim) * sum / 2;
}

SectionFlow section_flow(const LeastSquares& fit, const ParticleSet<2>& particles,
                         const PeriodicBox<2>& box, double spacing, double x, double height) {
  // Two Gauss points a spacing integrate the parabolas between nodes exactly.
  const auto panels = std::lround(std::ceil(height / spacing));
  const double panel = height / static_cast<double>(panels);
  const double offset = panel / (2 * std::sqrt(3.0));
  std::vector<Vector<2>> points;
  for (long k = 0; k < panels; ++k) {
    const double middle = (static_cast<double>(k) + 0.5) * panel;
    for (const double side : {-offset, offset}) points.emplace_back(x, middle + side);
  }
  SectionFlow flow;
  for (const FlowSample<2>& sample : interpolate_flow<2>(
           fit, particles.positions, box, particles.velocities, particles.pressures, points)) {
    flow.flow_rate += sample.velocity[0] * panel / 2;
    flow.pressure += sample.pressure / static_cast<double>(points.size());
  }
  return flow;
}

namespace {

/// Force of the fluid on each boundary node of interest; zero elsewhere.
template <int dim, typename Wanted>
std::vector<Vector<dim>> node_forces(const NodeGeometry<dim>& nodes,
                                     const ParticleSet<dim>& particles, double viscosity,
                                     const Wanted& wanted) {
  std::vector<Vector<dim>> forces(particles.size(), Vector<dim>::Zero());
  const NodeRange own = nodes.stencils.rows(particles.size());
  for (std::size_t i = own.begin; i < own.end; ++i) {
    if (!wanted(i)) continue;
    const Tensor<dim> gradient =
        velocity_gradient(nodes.stencils, nodes.table, particles.velocities, i);
    const Vector<dim>& normal = particles.normals[i];
    forces[i] = particles.measures[i] * (particles.pressures[i] * normal -
                                         viscosity * (gradient + gradient.transpose()) * normal);
  }
  gather_rows(nodes.stencils, forces);
  return forces;
}

}  // namespace

template <int dim>
Vector<dim> boundary_force(const NodeGeometry<dim>& nodes, const ParticleSet<dim>& particles,
                           double viscosity, std::int32_t patch) {
  Vector<dim> force = Vector<dim>::Zero();
  for (const Vector<dim>& one : node_forces(nodes, particles, viscosity, [&](std::size_t i) {
         return particles.patches[i] == patch;
       })) {
    force += one;
  }
  return force;
}

double mean_wall_friction(const NodeGeometry<2>& nodes, const ParticleSet<2>& particles,
                          double viscosity, const std::array<std::int32_t, 2>& walls, double from,
                          double to) {
  const auto is_meant = [&](std::size_t i) {
    const bool is_wall = particles.patches[i] == walls[0] || particles.patches[i] == walls[1];
    return is_wall && particles.positions[i][0] >= from && particles.positions[i][0] <= to;
  };
  double friction = 0;
  for (const Vector<2>& one : node_forces(nodes, particles, viscosity, is_meant)) {
    friction += one[0];
  }
  double length = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (is_meant(i)) length += particles.measures[i];
  }
  return length > 0 ? friction / length : 0;
}

#define HEMOSCALE_INSTANTIATE(dim)                                                            \
  template double kinetic_energy<dim>(const ParticleSet<dim>&, double, double);               \
  template Vector<dim> boundary_force<dim>(const NodeGeometry<dim>&, const ParticleSet<dim>&, \
                                           double, std::int32_t);
HEMOSCALE_INSTANTIATE(2)
HEMOSCALE_INSTANTIATE(3)
#undef HEMOSCALE_INSTANTIATE

}  // namespace hemoscale::micro
