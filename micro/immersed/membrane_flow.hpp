#pragma once

#include <vector>

#include "micro/immersed/implicit_membranes.hpp"

namespace hemoscale::micro {

/// The flow around cells at one moment, everywhere: without cells, reaction of the boundaries and
/// the rings themselves.
class MembraneFlow {
 public:
  explicit MembraneFlow(const ImplicitMembranes& membranes);

  /// Velocity and pressure at places in the fluid, inside and outside the cells. Within about a
  /// tenth of the node distance of a membrane the sums along it are not exact.
  /// @throws NumericalError for places that lie outside the domain
  FlowValues at(const std::vector<Vector<2>>& places) const;

  /// See Surroundings [Pa].
  double extra_pressure_drop() const;

 private:
  bool is_inside(const RingSource& source, const Vector<2>& place) const;

  const ImplicitMembranes& membranes_;
  std::vector<RingSource> sources_;
  Surroundings::Reaction reaction_;
};

}  // namespace hemoscale::micro
