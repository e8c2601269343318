#pragma once

#include "micro/linear/choose_solver.hpp"

namespace hemoscale::micro {

enum class PressureCoupling { chorin, incremental, coupled };
enum class ViscosityTreatment { explicit_euler, implicit };
enum class TimeScheme { euler, sdirk2 };
enum class Inertia { unsteady, quasi_steady };

/// How the nodes of the fluid move.
enum class NodeMotion {
  eulerian,    // they rest; the fluid passes
  lagrangian,  // with the fluid, then shifted apart if wanted
  ale,         // with a transport velocity: that of the fluid plus one that keeps nodes apart
};

/// How moving nodes are kept apart.
enum class Shifting { none, concentration };

/// Choices of the least-squares solver. The defaults are the fastest at given accuracy for
/// capillary flow.
struct StageOptions {
  PressureCoupling coupling = PressureCoupling::coupled;
  ViscosityTreatment viscosity = ViscosityTreatment::implicit;
  TimeScheme time_scheme = TimeScheme::sdirk2;
  Inertia inertia = Inertia::unsteady;
  NodeMotion motion = NodeMotion::eulerian;
  Shifting shifting = Shifting::none;
  double kernel_ratio = 2.5;        // [-] radius of the fits over the spacing
  double stabilisation = 50;        // [-] c of the coupled solver
  double condition_bound = 1e8;     // [-] of moment matrices
  double shifting_strength = 0.05;  // [-] largest shift per step over the spacing
  LinearSolverKind linear_solver = LinearSolverKind::automatic;
  SolveTolerance tolerance = {};
};

/// @throws ParameterError for choices that exclude each other
void check(const StageOptions& options);

}  // namespace hemoscale::micro
