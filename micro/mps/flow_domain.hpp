#pragma once

#include <functional>
#include <string>
#include <vector>

#include "micro/particles/particle_set.hpp"
#include "micro/particles/periodic_box.hpp"

namespace hemoscale::micro {

/// Newtonian fluid of constant density.
struct Fluid {
  double density = 0;              // [kg/m^3] positive
  double kinematic_viscosity = 0;  // [m^2/s] not negative

  double viscosity() const { return density * kinematic_viscosity; }  // [Pa s]
};

/// One piece of the boundary and what is imposed there.
template <int dim>
struct Patch {
  std::string name;
  ParticleKind kind = ParticleKind::wall;

  /// Velocity at x and t [m/s], for walls and inlets; without one, rest.
  std::function<Vector<dim>(const Vector<dim>& x, double t)> velocity = nullptr;

  /// Pressure at t [Pa], for outlets; without one, zero.
  std::function<double(double t)> pressure = nullptr;
};

/// Where the fluid is, what bounds it and what drives it.
template <int dim>
struct FlowDomain {
  double spacing = 0;  // [m] l0, the mean distance of neighbours
  ParticleSet<dim> particles;
  PeriodicBox<dim> box;
  std::vector<Patch<dim>> patches;

  /// Body force per mass at t [m/s^2]; without one, none.
  std::function<Vector<dim>(double t)> acceleration = nullptr;

  /// Rate of shear of a sheared periodic box [1/s]: du_x/dy; its images slide accordingly.
  double sliding_rate = 0;
};

template <int dim>
Vector<dim> body_acceleration(const FlowDomain<dim>& domain, double t) {
  return domain.acceleration ? domain.acceleration(t) : Vector<dim>(Vector<dim>::Zero());
}

template <int dim>
Vector<dim> patch_velocity(const Patch<dim>& patch, const Vector<dim>& x, double t) {
  return patch.velocity ? patch.velocity(x, t) : Vector<dim>(Vector<dim>::Zero());
}

}  // namespace hemoscale::micro
