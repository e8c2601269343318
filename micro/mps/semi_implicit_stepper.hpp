#pragma once

#include <vector>

#include "micro/model.hpp"
#include "micro/mps/limits.hpp"
#include "micro/mps/semi_implicit_parts.hpp"

namespace hemoscale::micro {

/// Plasma by moving particles in the order of events of Koshizuka and Oka 1996: velocities without
/// pressure, motion, pressure from the density (or the velocities) of the moved particles,
/// correction of velocities and positions. Walls are rows of particles.
///
/// One stage a file: semi_implicit_{coefficients, boundaries, prediction, source, pressure,
/// shifting, watch}, inlet_outlet. The same bits for any number of threads.
template <int dim>
class SemiImplicitStepper {
 public:
  /// @param make_solver  of the symmetric systems; without one, AggregateSolver
  /// @throws ParameterError if domain, fluid or options are not admissible
  SemiImplicitStepper(const FlowDomain<dim>& domain, const Fluid& fluid,
                      const SemiImplicitOptions& options, const SolveTolerance& tolerance = {},
                      SymmetricSolverFactory<dim> make_solver = nullptr);

  /// Limits of a step of the given length; see semi_implicit_limits().
  std::vector<Limit> limits(double dt) const;

  /// One step. After a failure the particles are those before the step.
  /// @throws ParameterError if a limit is exceeded and the options do not force the run
  /// @throws NumericalError naming step, time, particle, value, limit and remedy
  void step(double dt);

  /// Back to the state before the last step, for a caller that does not accept what it finds; once
  /// for each step.
  void revert();

  const ParticleSet<dim>& particles() const { return state_.particles; }
  double time() const { return state_.time; }
  std::int64_t steps() const { return state_.step; }
  const ParticleLedger& ledger() const { return state_.ledger; }
  const SemiImplicitReport& report() const { return work_.report; }
  const SemiImplicitTimes& times() const { return work_.times; }

  Snapshot snapshot() const;

  /// @throws ParameterError if the snapshot does not belong to such a run
  void restore(const Snapshot& snapshot);

 private:
  void advance(double dt);
  void resume();

  SemiImplicitSetting<dim> setting_;
  SemiImplicitState<dim> state_;
  SemiImplicitState<dim> last_good_;
  SemiImplicitWork<dim> work_;
  double deviation_ = 0;    // [-] of the initial number density
  double limits_step_ = 0;  // [s] for which the limits were evaluated
  std::vector<Limit> limits_;
};

}  // namespace hemoscale::micro
