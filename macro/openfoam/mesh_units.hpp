#pragma once

namespace hemoscale::macro {

/// What the numbers of an OpenFOAM case mean. OpenFOAM is told metres and seconds, but its
/// arithmetic is safest when cells are of order one (interpolation in cells below about 10 um fails
/// silently in metres), so a case may be meshed in, say, micrometres and milliseconds.
///
/// Incompressible solvers work with viscosity and pressure over density: density enters here.
struct MeshUnits {
  double length = 1;      // [m] that 1 of the mesh means
  double time = 1;        // [s] that 1 of the case's time means
  double density = 1050;  // [kg/m^3] of the fluid

  double speed() const { return length / time; }                         // [m/s] of 1
  double pressure() const { return density * speed() * speed(); }        // [Pa] of 1, kinematic
  double kinematic_viscosity() const { return length * length / time; }  // [m^2/s] of 1
  double dynamic_viscosity() const { return density * kinematic_viscosity(); }  // [Pa s] of 1
};

}  // namespace hemoscale::macro
