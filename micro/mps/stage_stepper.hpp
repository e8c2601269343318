#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "micro/mps/coupled_solver.hpp"
#include "micro/mps/flow_domain.hpp"
#include "micro/mps/least_squares.hpp"
#include "micro/mps/projection_solver.hpp"
#include "micro/mps/stage_options.hpp"

namespace hemoscale::micro {

/// What the last step did.
struct StepReport {
  SolveReport solve;             // worst of the stages
  int stages = 0;                // [-] systems solved
  double largest_speed = 0;      // [m/s]
  double smallest_distance = 0;  // [m] between nodes; 0 while they rest
  FitQuality fit;
  std::size_t inserted = 0;  // [-] particles since the start
  std::size_t removed = 0;
};

/// What a stepper counts besides its particles.
struct StageCounters {
  double time = 0;  // [s]
  std::int64_t steps = 0;
  std::size_t inserted = 0;  // [-] particles since the start
  std::size_t removed = 0;
  std::int64_t next_identity = 0;  // of the next particle that enters
};

/// Incompressible flow by least-squares operators on nodes that lie in the fluid and on its
/// boundaries: method of lines in time.
///
/// Pressure and viscosity are implicit, advection relative to the nodes explicit:
///
///   euler    one stage, first order
///   sdirk2   two stages with g = 1 - 1/sqrt(2) (Alexander 1977), second order and L-stable, joined
///            with the explicit scheme of Ascher, Ruuth and Spiteri (1997), ARS(2,2,2)
///
/// Nodes that move are advanced by the explicit part, and operators are made anew at each stage.
/// Quasi-steady flow has no rate term: each step is one Stokes solve at the end of the step.
template <int dim>
class StageStepper {
 public:
  /// @param ranks  share the work of each step; all hold all nodes and call every function together
  /// @throws ParameterError for options that exclude each other, or a fluid that makes no sense
  StageStepper(FlowDomain<dim> domain, const Fluid& fluid, const StageOptions& options,
               std::shared_ptr<const Communicator> ranks = std::make_shared<Communicator>());

  /// @throws NumericalError naming step, time, particle, value, limit and remedy; the state is then
  ///         that before the step
  void step(double time_step);

  /// Quasi-steady flow on resting nodes: the flow at the present time under the present forces; no
  /// time passes.
  /// @throws ParameterError for unsteady flow or moving nodes
  /// @throws NumericalError as above
  void settle();

  const FlowDomain<dim>& domain() const { return domain_; }
  const ParticleSet<dim>& particles() const { return domain_.particles; }
  const Fluid& fluid() const { return fluid_; }
  const StageOptions& options() const { return options_; }
  double time() const { return time_; }
  std::int64_t steps() const { return steps_; }
  const StepReport& report() const { return report_; }
  std::string describe_solver() const;

  /// Operators at the present nodes.
  const NodeGeometry<dim>& nodes();

  std::int64_t next_identity() const { return next_identity_; }

  /// Continues from a saved state with the same bits.
  void restore(ParticleSet<dim> particles, const StageCounters& counters);

 private:
  void advance(double time_step);
  void rebuild(const std::vector<Vector<dim>>& positions, double time);
  void carry_pressure(const std::vector<Vector<dim>>& places);
  void prepare(double rate);
  SolveReport solve_stage(const StageProblem<dim>& problem, std::vector<Vector<dim>>& velocities,
                          std::vector<double>& pressures);
  void solve_unsteady(double time_step);
  void solve_quasi_steady(double time_step);
  void move_nodes_apart();
  void exchange_at_openings();

  std::vector<Vector<dim>> explicit_part(const std::vector<Vector<dim>>& velocities,
                                         const std::vector<Vector<dim>>& node_velocities) const;
  std::vector<Vector<dim>> node_velocities(const std::vector<Vector<dim>>& velocities,
                                           double time_step) const;
  StageProblem<dim> boundary_values(double time) const;
  void add_local_acceleration(double time, std::vector<Vector<dim>>& source) const;
  Vector<dim> boundary_acceleration(std::size_t node, double time) const;
  Vector<dim> sliding_velocity(const Vector<dim>& x) const;
  void remember(const SolveReport& report);

  FlowDomain<dim> domain_;
  Fluid fluid_;
  StageOptions options_;
  std::shared_ptr<const Communicator> ranks_;
  double time_ = 0;  // [s]
  std::int64_t steps_ = 0;
  std::int64_t next_identity_ = 0;

  NodeGeometry<dim> nodes_;
  bool nodes_are_current_ = false;
  double prepared_rate_ = -1;  // [1/s] of the factored matrix; negative: none
  std::variant<std::unique_ptr<CoupledSolver<dim>>, std::unique_ptr<ProjectionSolver<dim>>> solver_;
  StepReport report_;
};

}  // namespace hemoscale::micro
