#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "micro/immersed/cell.hpp"
#include "micro/immersed/kernel_transfer.hpp"
#include "micro/immersed/membrane_limits.hpp"
#include "micro/immersed/membrane_watch.hpp"
#include "micro/model.hpp"
#include "micro/mps/stage_stepper.hpp"

namespace hemoscale::micro {

/// Choices of the explicit coupling. Limits are evaluated before the first step.
///
/// The flow is best solved coupled. The projection (incremental) is five times faster, but its
/// velocities are divergence-free less exactly next to the forces: a parachute in a capillary
/// buckles and crosses itself after three milliseconds, whatever the step and the stiffness. A
/// narrow kernel smears less: the speed of that parachute is 0.035 of the mean flow higher with
/// three points than with four, at the price of half the step.
struct ImmersedOptions {
  StageOptions flow = {};  // resting nodes; unsteady or quasi-steady
  TransferKernel kernel = TransferKernel::four_point;
  NodeStepping stepping = NodeStepping::forward_euler;
  MembraneThresholds thresholds = {};
  double speed = 0;  // [m/s] characteristic, for the advective limit; 0: not checked

  /// Runs beyond the limits all the same, until the watch ends it.
  bool force = false;
};

/// Membranes in plasma on resting least-squares nodes, coupled explicitly (Peskin 2002): in a step
/// the membrane nodes move with the velocity that they see,
///
///   X <- X + dt J u                              (forward_euler)
///   X <- X + dt (3/2 J u - 1/2 (J u)_before)     (adams_bashforth; the first step is one of Euler,
///                                                 weights for steps of different lengths)
///
/// then the flow is advanced under their elastic forces S F(X), those between the ends of the step
/// taken on the straight way of the nodes. Same viscosity inside and outside.
///
/// Interpolated velocities are divergence-free only as far as the nodes resolve them: the enclosed
/// area leaks. AreaLaw::exact restores it by one normal projection per step; what leaked is
/// counted.
class ImmersedMembranes {
 public:
  /// @throws ParameterError for options, a domain or cells that are not admissible: a viscosity
  ///         contrast or the inextensible law, which need the implicit coupling, among them
  ImmersedMembranes(FlowDomain<2> domain, const Fluid& fluid, const ImmersedOptions& options,
                    std::vector<Cell> cells);

  /// Limits of a step of the given length: of the flow, the membranes and their motion.
  std::vector<Limit> limits(double dt) const;

  /// After a failure the state is that before the step.
  /// @throws ParameterError if a limit is exceeded and the options do not force the run
  /// @throws NumericalError naming step, time, cell, node, value, limit and remedy
  void step(double dt);

  const std::vector<Cell>& cells() const;
  const ParticleSet<2>& particles() const { return flow_.particles(); }
  double time() const { return flow_.time(); }
  std::int64_t steps() const { return flow_.steps(); }

  /// Of each cell after the last step.
  const std::vector<CellReport>& reports() const { return reports_; }

  /// Area that would have leaked out of each cell since the start, over the rest area [-]; zero
  /// unless the area is exact.
  const std::vector<double>& leaks() const { return leaks_; }

  Snapshot snapshot() const;

  /// @throws ParameterError if the snapshot does not belong to such a run
  void restore(const Snapshot& snapshot);

 private:
  struct Coupling;  // what the flow asks for its forces

  ImmersedMembranes(FlowDomain<2> domain, const Fluid& fluid, const ImmersedOptions& options,
                    const std::shared_ptr<Coupling>& coupling);
  void move(double dt);
  void take_velocities();

  ImmersedOptions options_;
  Fluid fluid_;
  double spacing_;
  MembraneBounds bounds_;
  std::shared_ptr<Coupling> coupling_;
  StageStepper<2> flow_;
  std::vector<std::vector<Vector<2>>> former_velocities_;  // [m/s] (J u)_before; empty at first
  double former_step_ = 0;                                 // [s]
  std::vector<CellReport> reports_;
  std::vector<double> leak_rates_;  // [1/s] taken out of the velocities
  std::vector<double> leaks_;
  double limits_step_ = 0;  // [s] for which the limits were evaluated
  std::vector<Limit> limits_;
};

}  // namespace hemoscale::micro
