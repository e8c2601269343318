#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "micro/linear/linear_solver.hpp"
#include "micro/linear/node_layout.hpp"
#include "micro/linear/null_space.hpp"
#include "micro/mps/flow_domain.hpp"
#include "micro/mps/inlet_outlet.hpp"
#include "micro/mps/mps_operators.hpp"
#include "micro/mps/semi_implicit_options.hpp"

namespace hemoscale::micro {

/// Makes a solver of symmetric positive (semi-)definite systems over the given nodes.
template <int dim>
using SymmetricSolverFactory = std::function<std::unique_ptr<LinearSolver>(
    const NodeLayout<dim>&, const SolveTolerance&, const std::optional<ConstantNullSpace>&)>;

/// What does not change during a run.
template <int dim>
struct SemiImplicitSetting {
  SemiImplicitOptions options;
  Fluid fluid;
  MpsKernel kernel;
  double spacing = 0;  // [m]
  PeriodicBox<dim> box;
  std::vector<Patch<dim>> patches;
  std::function<Vector<dim>(double t)> acceleration;
  std::function<void(const ParticleSet<dim>&, double t, std::vector<Vector<dim>>&)>
      local_acceleration;
  std::function<std::vector<Limit>(double time_step)> local_limits;
  Openings<dim> openings;
  Vector<dim> lower,
      upper;  // [m] beyond them, along axes that are not periodic, a particle is lost
  SolveTolerance tolerance;
  SymmetricSolverFactory<dim> make_solver;
};

/// All that a run needs to continue with the same bits.
template <int dim>
struct SemiImplicitState {
  ParticleSet<dim> particles;
  std::vector<double> depths;  // [m] of wall and dummy particles behind the wall plane; else zero
  std::vector<Vector<dim>> table_positions;  // [m] for which the neighbours were searched last
  std::int64_t searches = 0;                 // [-] of neighbours since the particles were ordered
  double time = 0;                           // [s]
  std::int64_t step = 0;
  ParticleLedger ledger;
};

/// What the last step found.
struct SemiImplicitReport {
  int pressure_iterations = 0;
  int velocity_iterations = 0;        // sum over the components
  double relative_residual = 0;       // [-] of the pressure solve
  double density_error = 0;           // [-] root mean square of n / n0 - 1 in the fluid
  double kinetic_energy = 0;          // [J/m, 3-D: J] of the fluid
  double fastest = 0;                 // [m/s]
  double nearest = 0;                 // [l0] smallest distance of two particles
  std::size_t clamped = 0;            // negative pressures raised to zero
  std::size_t uncorrected = 0;        // particles that kept the plain gradient
  std::size_t surface_particles = 0;  // found on a free surface
};

/// Seconds of wall time spent so far, by stage.
struct SemiImplicitTimes {
  double neighbours = 0;
  double coefficients = 0;
  double viscosity = 0;
  double pressure = 0;  // source, matrix, solution, gradient
  double shifting = 0;
  double other = 0;
};

/// A symmetric system over all particles but the dummies; an unknown whose value is given has a row
/// and a column of the unit matrix, so that the pattern lasts as long as the neighbour table.
struct ParticleSystem {
  SparseMatrix matrix;
  std::vector<double> right, solution;
  std::unique_ptr<LinearSolver> solver;
  bool is_singular = false;  // no value is given: the constant is free
};

/// Scratch memory: rebuilt from state and setting whenever needed.
template <int dim>
struct SemiImplicitWork {
  NeighbourTable table;
  PairGeometry<dim> pairs;
  LaplacianWeights laplacian;
  std::vector<Vector<dim>> gradient;           // [1/m] all neighbours
  std::vector<Vector<dim>> pressure_gradient;  // [1/m] neighbours with a pressure

  NeighbourTable probe_table;               // fluid and what looks at it from outside
  std::vector<std::int32_t> probe_sources;  // particles at the head of the table
  std::vector<std::int32_t> probes;         // wall, dummy and outlet particles at its tail

  std::vector<std::int32_t> unknown;  // row of each particle; -1 of dummies
  std::vector<Vector<dim>> unknown_positions;
  std::shared_ptr<const SparsePattern> pattern;
  ParticleSystem pressure, velocity;

  std::vector<char> is_dry;           // thinner than at a free surface; empty without one
  std::vector<char> has_pressure;     // takes part in pressure sums
  std::vector<char> solves_pressure;  // and its pressure is unknown
  std::vector<double> density;        // [-] at the moved positions
  std::vector<double> first_density;  // [-] at the beginning of the step
  std::vector<double> first_rate;     // [1/s]
  std::vector<double> rate;           // [1/s]
  std::vector<double> source;         // [Pa/m^2]
  std::vector<double> change;         // [Pa] what the solve gives: pressure, or its change
  std::vector<double> lowest;         // [Pa]
  std::vector<Vector<dim>> viscous_velocities;  // [m/s] as the viscous term sees them
  std::vector<Vector<dim>> vectors;             // results of operators
  SemiImplicitReport report;
  SemiImplicitTimes times;
};

}  // namespace hemoscale::micro
