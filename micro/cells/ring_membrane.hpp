#pragma once

#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "micro/cells/area.hpp"
#include "micro/cells/half_angle_bending.hpp"
#include "micro/cells/line_element_stretch.hpp"
#include "micro/cells/membrane.hpp"
#include "micro/cells/ring_mesh.hpp"
#include "micro/cells/ring_stiffness.hpp"
#include "micro/cells/stretch.hpp"
#include "micro/cells/turning_angle_bending.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// Elastic energy of one ring per unit depth, by law [N].
struct MembraneEnergy {
  double stretch = 0;
  double bending = 0;
  double area = 0;
  double total() const { return stretch + bending + area; }
};

/// Mesh and laws of one kind of cell in the plane, resolved from the parameters once.
///
/// Laws that hold exactly (inextensible, exact area) exert no force here: who advances the cell
/// holds them as constraints. The modulus of the line elements is k_l = E_l times the mean rest
/// length. Calls do not share memory: several threads may use the same membrane.
class RingMembrane {
 public:
  /// @param mesh  as from make_ring_mesh with the natural shape and the spontaneous curvature of
  ///              the parameters
  /// @throws ParameterError naming all parameters that are not admissible
  RingMembrane(RingMesh mesh, const MembraneParameters& parameters);

  const RingMesh& mesh() const { return mesh_; }
  const MembraneParameters& parameters() const { return parameters_; }

  MembraneEnergy energy(std::span<const Vector<2>> positions) const;

  /// F_i = -dE/dX_i per unit depth [N/m], overwritten.
  void forces(std::span<const Vector<2>> positions, std::span<Vector<2>> forces) const;

  /// H_ij = d2E / dX_i dX_j, overwritten.
  void stiffness(std::span<const Vector<2>> positions, Compression compression,
                 RingStiffness& stiffness) const;

  /// Tension of every segment by its stretch [N/m], positive where it is pulled; zero for the
  /// inextensible law.
  std::vector<double> tensions(std::span<const Vector<2>> positions) const;

 private:
  RingMesh mesh_;
  MembraneParameters parameters_;
  std::variant<std::monostate, Stretch, LineElementStretch> stretch_;  // none: inextensible
  std::variant<TurningAngleBending, HalfAngleBending> bending_;
  std::optional<AreaPenalty> area_;  // none: exact
};

}  // namespace hemoscale::micro
