#pragma once

#include <optional>

#include "micro/mps/operator_kind.hpp"

namespace hemoscale::micro {

/// What drives the pressure; right-hand sides of lap p = source.
enum class IncompressibilitySource {
  pnd,         // deviation of the particle number density (Koshizuka and Oka 1996)
  divergence,  // divergence of the predicted velocity: nothing holds the density itself
  hs_ecs,      // rate of the number density, with error compensation (Khayyer and Gotoh 2009, 2011)
};

/// Role of the old pressure in the predicted velocity.
enum class ParticleCoupling {
  chorin,       // none: a splitting error of order nu dt / D^2 remains in a pressure-driven flow
  incremental,  // its gradient; the solve gives the change
};

enum class ViscousStepping {
  explicit_euler,  // stable up to the viscous limit
  implicit_euler,  // one system a component, no limit
};

/// Velocity of wall and dummy particles in the viscous term.
enum class WallVelocity {
  dummy,          // that of the wall, in every layer: the no-slip plane lies off the wall
  antisymmetric,  // mirrored, so that the velocity at the wall plane is that of the wall
};

/// Small displacements that restore an even distribution.
enum class ShiftKind {
  none,
  concentration,  // down the gradient of the number density (Lind et al. 2012)
  ops,            // the same, but only along free surfaces next to them (Khayyer et al. 2017)
};

/// How velocity and pressure follow a shifted particle: Taylor terms used.
enum class ShiftInterpolation { none, first_order, second_order };

struct SemiImplicitOptions {
  OperatorKind operators = OperatorKind::mps;  // mps, cmps or gc
  GradientForm gradient_form = GradientForm::difference;
  LaplacianScale laplacian_scale = LaplacianScale::local;
  double gradient_ratio = 2.1;   // [l0] kernel radius of gradient and number density
  double laplacian_ratio = 3.1;  // [l0]

  IncompressibilitySource source = IncompressibilitySource::pnd;
  double relaxation = 1;  // [-] gamma: share of the density deviation that one step removes; (0, 1]
  ParticleCoupling coupling = ParticleCoupling::chorin;
  ViscousStepping viscosity = ViscousStepping::explicit_euler;
  WallVelocity wall_velocity = WallVelocity::dummy;

  ShiftKind shift = ShiftKind::none;
  ShiftInterpolation shift_interpolation = ShiftInterpolation::second_order;
  double shift_coefficient = 0.5;  // [-] of l0^2 grad(n / n0)

  /// Below this share of n0 a fluid particle belongs to a free surface: zero pressure. Without a
  /// value there is no free surface.
  std::optional<double> free_surface_ratio;

  /// Raises negative pressures to zero, as codes for free surfaces do; counted in the report.
  bool clamp_negative_pressure = false;

  double speed = 0;  // [m/s] characteristic of the flow; what runs away is measured by it
  double gap =
      0;  // [m] of a channel driven by pressure, for the splitting error; 0 if there is none
  double condition_bound = 100;  // [-] above it a gradient is left uncorrected, and counted

  /// Runs beyond the limits all the same, until a detector fires and names the limit.
  bool force = false;
};

/// Tsubota, Wada and Yamaguchi 2006 to the letter: equations 1 and 2 as printed in the algorithm of
/// Koshizuka and Oka 1996. With its kernel radii the source in full (relaxation 1) is beyond the
/// number-density gain limit: it needs `force`, and fails; 0.2 is usual and within it.
SemiImplicitOptions paper_literal();

/// The published repairs that proved best together: corrected gradient, divergence as source,
/// implicit viscosity, mirrored wall velocities, shifting with second-order interpolation, which
/// also keeps the density even, and one kernel radius for all.
SemiImplicitOptions best_repaired();

/// @throws ParameterError naming all faults at once: value, range, remedy
void require_admissible(const SemiImplicitOptions& options);

}  // namespace hemoscale::micro
