#pragma once

#include <memory>
#include <string>
#include <vector>

#include "micro/mps/node_solver.hpp"
#include "micro/mps/saddle_point_solver.hpp"
#include "micro/mps/stage_problem.hpp"

namespace hemoscale::micro {

/// Velocity and pressure of a stage together: the saddle point
///
///   (a0 - nu L) u + G p / rho = s
///   D u - (tau / rho) (L p - D G p_before) = 0,   tau = 1 / (a0 + c nu / l0^2)
///
/// without splitting error. The difference of the two discrete Laplacians couples neighbouring
/// pressures, which central differences on one set of nodes leave apart (Rhie and Chow 1983); it
/// vanishes where p is quadratic and as p approaches p_before. Boundary rows: at walls and inlets u
/// is given and n.G p = mu n.L u + rho n.(body force - acceleration); at outlets p is given, the
/// velocity is normal and does not change along the normal; at free surfaces p is given.
///
/// a0 = 0 is quasi-steady (Stokes) flow.
template <int dim>
class CoupledSolver {
 public:
  /// @param stabilisation  c [-], positive
  /// @param ranks  outlives the solver; each assembles its rows, all solve the whole system
  CoupledSolver(const Fluid& fluid, double stabilisation, const StageSolving& solving,
                const Communicator& ranks);

  /// Assembles and factors the matrix for these nodes.
  /// @param rate  a0 [1/s]
  /// @throws NumericalError if it is singular
  void prepare(const NodeGeometry<dim>& nodes, double rate);

  /// @param velocities  solution out [m/s]
  /// @param pressures   p_before in, solution out [Pa]
  /// @throws NumericalError if the solution misses the tolerance
  SolveReport solve(const NodeGeometry<dim>& nodes, const StageProblem<dim>& problem,
                    std::vector<Vector<dim>>& velocities, std::vector<double>& pressures);

  std::string describe() const;

 private:
  void assemble(const NodeGeometry<dim>& nodes);
  void gather_matrix(const NodeGeometry<dim>& nodes);
  SaddlePointCoefficients scaled_coefficients(double spacing) const;

  Fluid fluid_;
  double stabilisation_;
  StageSolving solving_;
  const Communicator& ranks_;
  Communicator alone_;
  double rate_ = 0;             // [1/s] a0
  double viscosity_scale_ = 0;  // [Pa s] mu + rho a0 l0^2
  SparseMatrix matrix_;
  std::unique_ptr<LinearSolver> solver_;
};

}  // namespace hemoscale::micro
