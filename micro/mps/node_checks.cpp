#include "micro/mps/node_checks.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "micro/error.hpp"

namespace hemoscale::micro {

namespace {

template <int dim>
std::string place_of(const Vector<dim>& x) {
  std::string text = fmt::format("({:.6g}, {:.6g}", x[0], x[1]);
  if constexpr (dim == 3) text += fmt::format(", {:.6g}", x[2]);
  return text + ") m";
}

/// Nearest approach of two nodes over the spacing, below which moment matrices are about to become
/// singular.
constexpr double closest_allowed = 0.1;

/// Passages per step over the spacing at which explicit advection has long failed.
constexpr double fastest_allowed = 5;

}  // namespace

void check_fluid(const Fluid& fluid, bool is_quasi_steady) {
  if (!(fluid.density > 0)) {
    throw ParameterError(
        fmt::format("the density is {:g} kg/m^3; it must be positive", fluid.density));
  }
  const double nu = fluid.kinematic_viscosity;
  if (!(nu >= 0) || !std::isfinite(nu) || (is_quasi_steady && nu == 0)) {
    throw ParameterError(
        fmt::format("the kinematic viscosity is {:g} m^2/s; it must be {}", nu,
                    is_quasi_steady ? "positive in quasi-steady flow" : "zero or positive"));
  }
}

template <int dim>
void check_nodes(const NodeGeometry<dim>& nodes, double& smallest) {
  smallest = std::numeric_limits<double>::infinity();
  std::size_t closest = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (!has_momentum(nodes.kinds[i])) continue;
    for (std::size_t k = nodes.table.begin(i); k < nodes.table.end(i); ++k) {
      const std::size_t j = nodes.table[k];
      // Nodes pass through openings.
      if (nodes.kinds[j] == ParticleKind::inlet || nodes.kinds[j] == ParticleKind::outlet) continue;
      const Vector<dim> r = separation(nodes.box, nodes.positions[j], nodes.positions[i]);
      const double distance = r.norm();
      if (distance < smallest) {
        smallest = distance;
        closest = i;
      }
      if (nodes.kinds[j] == ParticleKind::wall && distance < nodes.spacing &&
          r.dot(nodes.normals[j]) > 0) {
        throw NumericalError(fmt::format(
            "particle {} at {} has crossed the wall by {:.3g} m (spacing {:.3g} m); reduce the "
            "time "
            "step",
            i, place_of<dim>(nodes.positions[i]), r.dot(nodes.normals[j]), nodes.spacing));
      }
    }
  }
  if (smallest < closest_allowed * nodes.spacing) {
    throw NumericalError(fmt::format(
        "particle {} at {} is {:.3g} m from another, the limit is {:.3g} m ({:g} of the spacing); "
        "switch shifting on, or reduce the time step",
        closest, place_of<dim>(nodes.positions[closest]), smallest, closest_allowed * nodes.spacing,
        closest_allowed));
  }
}

template <int dim>
double check_speeds(const ParticleSet<dim>& particles, double spacing, double time_step) {
  double largest = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double speed = particles.velocities[i].norm();
    if (!std::isfinite(speed) || !std::isfinite(particles.pressures[i])) {
      throw NumericalError(fmt::format(
          "the {} of particle {} at {} is not finite; the run is unstable: reduce the time step",
          std::isfinite(speed) ? "pressure" : "velocity", i,
          place_of<dim>(particles.positions[i])));
    }
    if (speed * time_step > fastest_allowed * spacing) {
      throw NumericalError(
          fmt::format("particle {} at {} passes {:.3g} spacings in a step (speed {:.4g} m/s), the "
                      "limit is {:g}; "
                      "advection is explicit: reduce the time step below {:.3g} s",
                      i, place_of<dim>(particles.positions[i]), speed * time_step / spacing, speed,
                      fastest_allowed, spacing / speed));
    }
    largest = std::max(largest, speed);
  }
  return largest;
}

template void check_nodes<2>(const NodeGeometry<2>&, double&);
template void check_nodes<3>(const NodeGeometry<3>&, double&);
template double check_speeds<2>(const ParticleSet<2>&, double, double);
template double check_speeds<3>(const ParticleSet<3>&, double, double);

}  // namespace hemoscale::micro
