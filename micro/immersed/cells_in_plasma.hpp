#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "micro/immersed/direct_membranes.hpp"
#include "micro/immersed/immersed_membranes.hpp"
#include "micro/immersed/implicit_membranes.hpp"

namespace hemoscale::micro {

/// Red cells in plasma, whichever way they are coupled: one face for the three couplings.
class CellsInPlasma {
 public:
  using Coupling =
      std::variant<std::unique_ptr<ImplicitMembranes>, std::unique_ptr<ImmersedMembranes>,
                   std::unique_ptr<DirectMembranes>>;

  /// @param time_step  [s] of the explicit couplings, the longest; the implicit one has its own
  CellsInPlasma(Coupling coupling, double time_step);

  /// Advances by a stretch of time.
  /// @throws NumericalError naming step, time, cell, value, limit and remedy; the cells are then
  ///         those of the last good step
  void advance_by(double duration);

  const std::vector<Cell>& cells() const;
  double time() const;
  std::int64_t steps() const;

  /// Tension of the segments of a cell [N/m], positive where they are pulled.
  std::vector<double> tensions(std::size_t cell) const;

  /// Limits of the coupling and of the flow that depend on the step; none of the implicit one.
  std::vector<Limit> limits() const;

  /// The implicit coupling, which knows more; null for the others.
  const ImplicitMembranes* implicit() const;

  /// Particles or nodes of the plasma; null for the implicit coupling, whose flow is not on nodes
  /// alone (see MembraneFlow).
  const ParticleSet<2>* particles() const;

  Snapshot snapshot() const;

  /// @throws ParameterError if the snapshot does not belong to such a run
  void restore(const Snapshot& snapshot);

 private:
  Coupling coupling_;
  double time_step_;  // [s]
};

}  // namespace hemoscale::micro
