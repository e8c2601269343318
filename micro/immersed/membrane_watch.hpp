#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "micro/immersed/cell.hpp"
#include "micro/mps/flow_domain.hpp"
#include "micro/mps/limits.hpp"
#include "micro/particles/node_bins.hpp"

namespace hemoscale::micro {

/// Beyond these a membrane has failed.
struct MembraneThresholds {
  double strain = 0.5;     // [-] of a segment
  double area = 0.05;      // [-] relative change of the enclosed area
  double node_step = 0.5;  // [l0] way of a node in one step
};

/// Where membrane nodes may be: within the boundaries of the domain as they are at the beginning,
/// and away from openings.
class MembraneBounds {
 public:
  /// @param wall_offset  [m] of the wall plane before the wall particles, into the fluid
  /// @param margin       [m] kept from openings
  MembraneBounds(const FlowDomain<2>& domain, double wall_offset, double margin);

  /// What is wrong with this place; empty if it is inside.
  std::string fault_at(const Vector<2>& x) const;

 private:
  double spacing_, wall_offset_, margin_;
  ParticleSet<2> boundary_;
  std::optional<NodeBins<2>> bins_;  // none without boundaries
};

/// Shape of one cell against its rest shape.
struct CellReport {
  double area_error = 0;      // [-] (A - A0) / A0
  double length_error = 0;    // [-] of the perimeter
  double largest_strain = 0;  // [-] of a segment, by magnitude
  std::size_t segment = 0;    // where
};

CellReport report_on(const Cell& cell);

/// One normal projection onto the rest area,
///
///   X += lambda dA/dX,   lambda = -(A - A0) / |dA/dX|^2,
///
/// whose error is of second order in A - A0.
/// @returns (A - A0) / A0 before
double project_area(const RingMesh& mesh, std::vector<Vector<2>>& positions);

/// Takes the part along dA/dX out of the velocities, so that the area stays: without it a
/// projection of the positions alone is of first order in the step.
/// @returns (dA/dt) / A0 before [1/s]
double project_velocities(const RingMesh& mesh, const std::vector<Vector<2>>& positions,
                          std::vector<Vector<2>>& velocities);

/// A step as the watch sees it, for its messages.
struct MembraneStep {
  std::int64_t step = 0;
  double time = 0;     // [s] at the end
  double spacing = 0;  // [m] l0
  const std::vector<Limit>* limits = nullptr;
};

/// @throws ParameterError naming every cell that cannot be put into the domain: too few or
///         coinciding nodes, clockwise, crossing itself, outside the fluid, overlapping another
void require_admissible(const std::vector<Cell>& cells, const PeriodicBox<2>& box,
                        const MembraneBounds& bounds);

/// Looks for the signs of failure of the cells that came from `before` in a step.
/// @throws NumericalError naming step, time, cell, node, value, limit and remedy
std::vector<CellReport> watch(const std::vector<Cell>& cells, const std::vector<Cell>& before,
                              const MembraneBounds& bounds, const MembraneThresholds& thresholds,
                              const MembraneStep& step);

}  // namespace hemoscale::micro
