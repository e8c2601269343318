#pragma once

#include <memory>

#include "micro/linear/choose_solver.hpp"
#include "micro/mps/stage_problem.hpp"

namespace hemoscale::micro {

/// Where the nodes lie, in the terms of the linear solvers; views the nodes.
template <int dim>
NodeLayout<dim> node_layout(const NodeGeometry<dim>& nodes);

/// How the systems of a stepper are solved.
struct StageSolving {
  LinearSolverKind kind = LinearSolverKind::automatic;
  SolveTolerance tolerance;
  bool is_reused = false;  // the nodes rest: one matrix serves many steps
};

/// The solver that suits a system over the nodes.
/// @param ranks  outlives the solver
/// @throws ParameterError if the kind named does not fit
template <int dim>
std::unique_ptr<LinearSolver> make_node_solver(const NodeGeometry<dim>& nodes,
                                               const SparsePattern& pattern,
                                               const SystemTraits& traits,
                                               const StageSolving& solving,
                                               const Communicator& ranks);

}  // namespace hemoscale::micro
