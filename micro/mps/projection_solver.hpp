#pragma once

#include <memory>
#include <string>
#include <vector>

#include "micro/mps/node_solver.hpp"
#include "micro/mps/stage_options.hpp"
#include "micro/mps/stage_problem.hpp"

namespace hemoscale::micro {

/// Velocity and pressure of a stage one after the other:
///
///   (a0 - nu L) u* = s - G p_before / rho
///   L p = a0 rho D u* + D G p_before
///   u = u* - G (p - p_before) / (a0 rho)
///
/// with p_before = 0 in the first form, chorin. The pressure is solved for as a whole: solving for
/// its increment, L phi = a0 rho D u*, gathers what D G and L disagree on and blows up on
/// disordered nodes; here, as in the coupled solver, the disagreement is damped (Rhie and Chow
/// 1983).
///
/// At walls and inlets n.grad p = rho n.(body force - acceleration): with the friction n.lap u in
/// it the explicit step in the pressure blows up at nu dt / l0^2 of some ten, without it no limit
/// was found; the pressure next to curved or developing boundaries is then first order.
///
/// Scalar systems only: the choice for many nodes. The first form (Chorin 1968) leaves a slip
/// velocity of a0^-1 dp/dx / rho at walls, 12 nu dt / D^2 of the mean velocity of a channel; the
/// incremental form (Goda 1979) has no such error in steady flow (Guermond, Minev and Shen 2006).
/// The rotational form is not offered: on one set of nodes it gathers its residual divergence into
/// the pressure and drifts over thousands of steps.
template <int dim>
class ProjectionSolver {
 public:
  /// @param coupling  chorin or incremental
  /// @param ranks     outlives the solver; rows and solution are shared among them
  ProjectionSolver(const Fluid& fluid, PressureCoupling coupling, ViscosityTreatment viscosity,
                   const StageSolving& solving, const Communicator& ranks);

  /// @param rate  a0 [1/s], positive
  void prepare(const NodeGeometry<dim>& nodes, double rate);

  /// @param velocities  in: first guess, and the field whose viscous term is taken if explicit;
  ///                    out: solution [m/s]
  /// @param pressures   p_before in, solution out [Pa]
  SolveReport solve(const NodeGeometry<dim>& nodes, const StageProblem<dim>& problem,
                    std::vector<Vector<dim>>& velocities, std::vector<double>& pressures);

  std::string describe() const;

 private:
  void assemble(const NodeGeometry<dim>& nodes);
  void predict(const NodeGeometry<dim>& nodes, const StageProblem<dim>& problem,
               const std::vector<double>& pressures, std::vector<Vector<dim>>& velocities,
               SolveReport& report);

  Fluid fluid_;
  PressureCoupling coupling_;
  ViscosityTreatment viscosity_;
  StageSolving solving_;
  const Communicator& ranks_;
  double rate_ = 0;  // [1/s] a0
  SparseMatrix momentum_;
  SparseMatrix pressure_;
  std::unique_ptr<LinearSolver> momentum_solver_;
  std::unique_ptr<LinearSolver> pressure_solver_;
};

}  // namespace hemoscale::micro
