#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "interpolation.H"
#include "macro/flow_field.hpp"
#include "macro/openfoam/interpolation.hpp"
#include "macro/openfoam/mesh_units.hpp"
#include "macro/openfoam/point_locator.hpp"
#include "volFields.H"

namespace hemoscale::macro {

/// The flow of an OpenFOAM mesh at one instant, in SI.
///
/// Gradients are Gauss gradients with linear interpolation to the faces, whatever the case's own
/// fvSchemes say. OpenFOAM's grad(U) holds d u_j / d x_i in component (i,j); FlowState holds the
/// transpose, L(i,j) = d u_i / d x_j. With Interpolation::taylor, r = x - x_c from the cell centre:
///
///   u(x) = u_c + L_c r + (r . grad L_c) r / 2,    L(x) = L_c + r . grad L_c
///
/// Exact for quadratic flows in the interior of a mesh; in the cells next to a wall of cell height
/// h the one-sided difference leaves an error of h u''/8 in L.
///
/// Refers to the fields it was made from, which must not change while it is in use. Construction
/// and every call are collective over the ranks of the mesh.
class FoamFlowField : public FlowField<3> {
 public:
  /// @param velocity  [mesh length / time]
  /// @param pressure  null: the pressure of every state is zero [kinematic, mesh units]
  /// @param locator   of the same mesh; null: one is made
  /// @throws ParameterError  cellPoint in a mesh whose numbers are too small for it, a pressure
  ///                         that is not kinematic
  FoamFlowField(const Foam::volVectorField& velocity, const Foam::volScalarField* pressure,
                const MeshUnits& units, Interpolation interpolation,
                std::shared_ptr<const PointLocator> locator = nullptr);

  /// @param t  not used: the field is that of one instant
  std::optional<FlowState<3>> at(const Vector<3>& x, double t) const override;

  /// @throws NumericalError  the flow at a point is not finite
  std::vector<std::optional<FlowState<3>>> sample(const std::vector<Vector<3>>& points,
                                                  double t) const override;

 private:
  struct Values {
    Foam::vector velocity = Foam::Zero;
    Foam::tensor gradient = Foam::Zero;  // OpenFOAM's orientation
    Foam::scalar pressure = 0;
  };
  Values values_in_cell(Foam::label cell, const Foam::point& x) const;

  const Foam::volVectorField& velocity_;
  const Foam::volScalarField* pressure_;
  MeshUnits units_;
  std::shared_ptr<const PointLocator> locator_;
  Foam::volTensorField gradient_;
  Foam::PtrList<Foam::volTensorField> second_;  // of each velocity component; taylor only
  std::unique_ptr<Foam::volVectorField> pressure_gradient_;
  Foam::autoPtr<Foam::interpolation<Foam::vector>> velocity_in_cell_;  // unless taylor
  Foam::autoPtr<Foam::interpolation<Foam::tensor>> gradient_in_cell_;
  Foam::autoPtr<Foam::interpolation<Foam::scalar>> pressure_in_cell_;
};

}  // namespace hemoscale::macro
