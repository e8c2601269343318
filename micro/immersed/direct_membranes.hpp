#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "micro/immersed/direct_insertion.hpp"
#include "micro/immersed/membrane_limits.hpp"
#include "micro/immersed/membrane_watch.hpp"
#include "micro/mps/semi_implicit_stepper.hpp"

namespace hemoscale::micro {

/// Membranes whose nodes are particles of the semi-implicit method [Tsubota2006, section 2]: fluid
/// like the plasma, with the elastic force F of their membrane as an acceleration of their own,
///
///   a = F / (rho l0^2).
///
/// A node carries the mass of one particle, rho l0^2, however near its neighbours are: the fluid
/// then receives the whole force, as momentum in this method is summed over particles of that mass.
/// Forces are explicit, those at the beginning of the step. Same viscosity inside and outside.
/// Nodes are never shifted; AreaLaw::exact is refused, since nothing but forces moves a particle.
class DirectMembranes {
 public:
  /// @throws ParameterError for options, a domain or cells that are not admissible: a viscosity
  ///         contrast or a law held as a constraint, which need the implicit coupling, among them
  DirectMembranes(const FlowDomain<2>& domain, const Fluid& fluid,
                  const SemiImplicitOptions& options, std::vector<Cell> cells,
                  const DirectInsertion& insertion = {}, const MembraneThresholds& thresholds = {},
                  const SolveTolerance& tolerance = {});

  /// Limits of a step of the given length: of the particle method and of the membranes.
  std::vector<Limit> limits(double dt) const;

  /// After a failure the state is that before the step.
  /// @throws ParameterError if a limit is exceeded and the options do not force the run
  /// @throws NumericalError naming step, time, cell, node, value, limit and remedy
  void step(double dt);

  const std::vector<Cell>& cells() const { return *cells_; }
  const ParticleSet<2>& particles() const { return plasma_->particles(); }
  double time() const { return plasma_->time(); }
  std::int64_t steps() const { return plasma_->steps(); }
  const SemiImplicitStepper<2>& plasma() const { return *plasma_; }

  /// Of each cell after the last step.
  const std::vector<CellReport>& reports() const { return reports_; }

  std::size_t removed() const { return removed_; }         // plasma particles, by the insertion
  double initial_deviation() const { return deviation_; }  // see InsertedMembranes

  Snapshot snapshot() const;

  /// @throws ParameterError if the snapshot does not belong to such a run
  void restore(const Snapshot& snapshot);

 private:
  /// The cells as the particles have them now.
  std::vector<Cell> seen_cells() const;

  MembraneThresholds thresholds_;
  double spacing_;
  PeriodicBox<2> box_;
  MembraneBounds bounds_;
  std::shared_ptr<std::vector<Cell>> cells_;  // the plasma asks them for their forces
  std::unique_ptr<SemiImplicitStepper<2>> plasma_;
  std::int64_t first_identity_ = 0;
  std::size_t removed_ = 0;
  double deviation_ = 0;
  std::vector<CellReport> reports_;
  double limits_step_ = 0;  // [s] for which the limits were evaluated
  std::vector<Limit> limits_;
};

}  // namespace hemoscale::micro
