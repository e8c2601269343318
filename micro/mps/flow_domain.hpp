#pragma once

#include <functional>
#include <string>
#include <vector>

#include "micro/mps/limits.hpp"
#include "micro/particles/particle_set.hpp"
#include "micro/particles/periodic_box.hpp"

namespace hemoscale::micro {

/// Newtonian fluid of constant density.
struct Fluid {
  double density = 0;              // [kg/m^3] positive
  double kinematic_viscosity = 0;  // [m^2/s] not negative

  double viscosity() const { return density * kinematic_viscosity; }  // [Pa s]
};

/// One piece of the boundary and what is imposed there. A patch of the kind `fluid` is no boundary
/// but a membrane in the fluid: its particles move with it and are never shifted, and no opening
/// may take them.
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

  /// Adds a force per mass of its own to that of each particle at t [m/s^2], one value for each of
  /// `particles`; without one, none. Called wherever the body force is taken: by the semi-implicit
  /// stepper with the particles at the beginning of the step, by the least-squares stepper for each
  /// stage, with the nodes where that stage has them and the last known velocities.
  std::function<void(const ParticleSet<dim>& particles, double t,
                     std::vector<Vector<dim>>& acceleration)>
      local_acceleration = nullptr;

  /// Limits that the explicit local acceleration sets to a step; without one, none. Refused and
  /// named like those of the method.
  std::function<std::vector<Limit>(double time_step)> local_limits = nullptr;

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
