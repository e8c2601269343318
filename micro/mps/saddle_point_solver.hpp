#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "micro/linear/linear_solver.hpp"
#include "micro/linear/null_space.hpp"
#include "micro/mps/stage_problem.hpp"

namespace hemoscale::micro {

/// Coefficients of the coupled system in its own units, see coupled_solver.cpp:
///
///   inertia u - viscous lap u + l0 grad q = f,   l0 div u - smoothing lap q = g
struct SaddlePointCoefficients {
  double inertia = 0;    // [-]
  double viscous = 0;    // [m^2]
  double smoothing = 0;  // [m^2]
};

/// Velocity and pressure together for many nodes: flexible GMRES [Saad1993] on the whole system,
/// preconditioned by one sweep of the rotational projection (Timmermans, Minev and van de Vosse
/// 1996), which is the approximate inverse of the Schur complement of Cahouet and Chabard (1988):
///
///   A u1 = f,   r = g - D u1,   q = viscous r - (1/inertia + smoothing)^-1 lap^-1 r,   A u = f - G
///   q
///
/// The scalar systems in it are solved loosely by multigrid. As a time stepper of its own the sweep
/// drifts; inside the iteration it only has to be near. Less than a direct factorisation in time
/// and memory from some ten thousand nodes on.
template <int dim>
class SaddlePointSolver final : public LinearSolver {
 public:
  /// @param nodes  read here alone
  SaddlePointSolver(const NodeGeometry<dim>& nodes, const SaddlePointCoefficients& coefficients,
                    const SolveTolerance& tolerance, std::optional<ConstantNullSpace> null_space);

  void prepare(const SparseMatrix& matrix) override;
  SolveReport solve(std::span<const double> b, std::span<double> x) override;
  std::string describe() const override;

 private:
  void precondition(std::span<const double> residual, std::span<double> step);
  void solve_velocities(std::span<const double> right, std::span<double> step);

  std::vector<ParticleKind> kinds_;
  SaddlePointCoefficients coefficients_;
  double spacing_;  // [m]
  SolveTolerance tolerance_;
  std::optional<ConstantNullSpace> null_space_;
  SparseMatrix matrix_;
  std::unique_ptr<LinearSolver> velocity_;  // one component
  std::unique_ptr<LinearSolver> pressure_;  // the Laplacian
  std::vector<double> product_;
  std::vector<double> right_, solution_;  // of the scalar systems
};

}  // namespace hemoscale::micro
