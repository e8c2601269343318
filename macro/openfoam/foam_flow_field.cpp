#include "macro/openfoam/foam_flow_field.hpp"

#include <cmath>
#include <sstream>

#include "PstreamCombineReduceOps.H"
#include "fvMesh.H"
#include "gaussGrad.H"
#include "leastSquaresGrad.H"
#include "linear.H"
#include "macro/error.hpp"

namespace hemoscale::macro {
namespace {

Foam::IOobject unregistered(const char* name, const Foam::fvMesh& mesh) {
  return Foam::IOobject(name, mesh.time().timeName(), mesh, Foam::IOobject::NO_READ,
                        Foam::IOobject::NO_WRITE, false);
}

/// Without asking the case's fvSchemes: a Gauss gradient with linear interpolation, unless it is to
/// be one of least squares.
template <class Type>
auto gradient_of(const Foam::GeometricField<Type, Foam::fvPatchField, Foam::volMesh>& field,
                 Interpolation interpolation) {
  if (interpolation == Interpolation::least_squares) {
    return Foam::fv::leastSquaresGrad<Type>(field.mesh()).calcGrad(field, "hemoscale:gradient");
  }
  auto gradient =
      Foam::fv::gaussGrad<Type>::gradf(Foam::linearInterpolate(field), "hemoscale:gradient");
  Foam::fv::gaussGrad<Type>::correctBoundaryConditions(field, gradient.ref());
  return gradient;
}

const char* openfoam_name(Interpolation interpolation) {
  return interpolation == Interpolation::cell_point ? "cellPoint" : "cellPointFace";
}

/// OpenFOAM's cellPoint tests a determinant (six tetrahedron volumes) against 1e-15 and takes
/// equal weights below it. A hexahedron has 24 such tetrahedra, so the test fails for all of them
/// below a volume of 4e-15; a margin of 100 covers flat ones.
void check_cell_size(const Foam::fvMesh& mesh, const MeshUnits& units) {
  const double smallest = Foam::gMin(mesh.V().field());  // [mesh length^3]
  const double limit = 4e-13;                            // [mesh length^3]
  if (smallest >= limit) return;
  std::ostringstream message;
  message << "interpolation cell-point: the smallest cell is " << smallest << " mesh units cubed ("
          << smallest * std::pow(units.length, 3) << " m^3), OpenFOAM's cellPoint gives wrong "
          << "values without a warning below " << limit
          << "; use taylor or cell-point-face, or mesh in micrometres and declare the length unit";
  throw ParameterError(message.str());
}

void check_kinematic(const Foam::volScalarField& pressure) {
  if (pressure.dimensions() == Foam::dimPressure / Foam::dimDensity) return;
  std::ostringstream message;
  message << "pressure field " << pressure.name() << " is not a kinematic pressure [m^2/s^2] as "
          << "incompressible solvers of OpenFOAM write it; name one that is";
  throw ParameterError(message.str());
}

}  // namespace

FoamFlowField::FoamFlowField(const Foam::volVectorField& velocity,
                             const Foam::volScalarField* pressure, const MeshUnits& units,
                             Interpolation interpolation,
                             std::shared_ptr<const PointLocator> locator)
    : velocity_(velocity),
      pressure_(pressure),
      units_(units),
      locator_(std::move(locator)),
      gradient_(unregistered("hemoscale:gradU", velocity.mesh()),
                gradient_of(velocity, interpolation)) {
  const Foam::fvMesh& mesh = velocity_.mesh();
  if (pressure_) check_kinematic(*pressure_);
  if (interpolation == Interpolation::cell_point) check_cell_size(mesh, units_);
  if (!locator_) locator_ = std::make_shared<PointLocator>(mesh);

  if (interpolation == Interpolation::taylor || interpolation == Interpolation::least_squares) {
    second_.setSize(3);
    for (Foam::direction i = 0; i < 3; ++i) {
      Foam::vector unit(Foam::Zero);
      unit[i] = 1;
      const Foam::volVectorField row(
          unregistered("hemoscale:gradient", mesh),
          gradient_ & Foam::dimensionedVector("unit", Foam::dimless, unit));
      second_.set(i, new Foam::volTensorField(unregistered("hemoscale:second", mesh),
                                              gradient_of(row, interpolation)));
    }
    if (pressure_) {
      pressure_gradient_ = std::make_unique<Foam::volVectorField>(
          unregistered("hemoscale:gradp", mesh), gradient_of(*pressure_, interpolation));
    }
  } else {
    const Foam::word name = openfoam_name(interpolation);
    velocity_in_cell_ = Foam::interpolation<Foam::vector>::New(name, velocity_);
    gradient_in_cell_ = Foam::interpolation<Foam::tensor>::New(name, gradient_);
    if (pressure_) pressure_in_cell_ = Foam::interpolation<Foam::scalar>::New(name, *pressure_);
  }
}

FoamFlowField::Values FoamFlowField::values_in_cell(Foam::label cell, const Foam::point& x) const {
  Values values;
  if (velocity_in_cell_.valid()) {
    values.velocity = velocity_in_cell_->interpolate(x, cell);
    values.gradient = gradient_in_cell_->interpolate(x, cell);
    if (pressure_) values.pressure = pressure_in_cell_->interpolate(x, cell);
    return values;
  }
  const Foam::vector r = x - velocity_.mesh().C()[cell];
  values.velocity = velocity_[cell] + (r & gradient_[cell]);
  values.gradient = gradient_[cell];
  for (Foam::direction i = 0; i < 3; ++i) {
    const Foam::vector change = r & second_[i][cell];  // of d u_i / d x_k over r
    values.velocity[i] += 0.5 * (r & change);
    for (Foam::direction k = 0; k < 3; ++k) values.gradient(k, i) += change[k];
  }
  if (pressure_) {
    values.pressure = (*pressure_)[cell] + (r & (*pressure_gradient_)[cell]);
  }
  return values;
}

std::optional<FlowState<3>> FoamFlowField::at(const Vector<3>& x, double t) const {
  return sample({x}, t).front();
}

std::vector<std::optional<FlowState<3>>> FoamFlowField::sample(const std::vector<Vector<3>>& points,
                                                               double /*t*/) const {
  const auto count = static_cast<Foam::label>(points.size());
  Foam::pointField in_mesh(count);
  for (Foam::label i = 0; i < count; ++i) {
    const Vector<3>& x = points[static_cast<std::size_t>(i)];
    in_mesh[i] = Foam::point(x(0), x(1), x(2)) / units_.length;
  }
  const PointLocator::Places places = locator_->locate(in_mesh);

  Foam::vectorField velocities(count, Foam::Zero);
  Foam::tensorField gradients(count, Foam::Zero);
  Foam::scalarField pressures(count, Foam::Zero);
  for (Foam::label i = 0; i < count; ++i) {
    if (places.cells[i] < 0) continue;
    const Values values = values_in_cell(places.cells[i], in_mesh[i]);
    velocities[i] = values.velocity;
    gradients[i] = values.gradient;
    pressures[i] = values.pressure;
  }
  // every point has one owner, so that the sums have one term that is not zero
  Foam::Pstream::listCombineGather(velocities, Foam::plusEqOp<Foam::vector>());
  Foam::Pstream::listCombineScatter(velocities);
  Foam::Pstream::listCombineGather(gradients, Foam::plusEqOp<Foam::tensor>());
  Foam::Pstream::listCombineScatter(gradients);
  Foam::Pstream::listCombineGather(pressures, Foam::plusEqOp<Foam::scalar>());
  Foam::Pstream::listCombineScatter(pressures);

  std::vector<std::optional<FlowState<3>>> states(points.size());
  for (Foam::label i = 0; i < count; ++i) {
    if (places.owners[i] < 0) continue;
    FlowState<3> state;
    for (Foam::direction k = 0; k < 3; ++k) {
      state.velocity(k) = velocities[i][k] * units_.speed();
      for (Foam::direction j = 0; j < 3; ++j) {
        state.velocity_gradient(k, j) = gradients[i](j, k) / units_.time;
      }
    }
    state.pressure = pressures[i] * units_.pressure();
    if (!state.velocity.allFinite() || !state.velocity_gradient.allFinite() ||
        !std::isfinite(state.pressure)) {
      std::ostringstream message;
      message << "the OpenFOAM flow at (" << points[static_cast<std::size_t>(i)].transpose()
              << ") m is not finite: the solver diverged; reduce its time step or its relaxation "
              << "factors";
      throw NumericalError(message.str());
    }
    states[static_cast<std::size_t>(i)] = state;
  }
  return states;
}

}  // namespace hemoscale::macro
