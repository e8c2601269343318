#include "macro/openfoam/viscosity_model.hpp"

#include <cmath>
#include <exception>

#include "addToRunTimeSelectionTable.H"
#include "fvMesh.H"
#include "macro/openfoam/floating_point_traps.hpp"
#include "macro/openfoam/law_dictionary.hpp"

namespace Foam {
namespace viscosityModels {

defineTypeNameAndDebug(hemoscaleViscosity, 0);
addToRunTimeSelectionTable(viscosityModel, hemoscaleViscosity, dictionary);

namespace {

hemoscaleLawInUse make_law(const dictionary& properties, const objectRegistry& mesh) {
  const hemoscale::macro::InitialLaw initial =
      hemoscale::macro::read_initial_law(properties.subDict("hemoscaleCoeffs"));
  return {mesh, initial.law, initial.hematocrit, initial.units};
}

/// nu at the faces or cells where the shear rate is given, both in mesh units.
void evaluate(const hemoscaleLawInUse& in_use, const scalarField& shear_rates, scalarField& nu) {
  const hemoscale::macro::MeshUnits& units = in_use.units();
  const double unit = units.dynamic_viscosity();
  forAll(nu, i) {
    nu[i] = in_use.law().viscosity(shear_rates[i] / units.time, in_use.hematocrit()) / unit;
    if (!(nu[i] > 0) || !std::isfinite(nu[i])) {
      FatalErrorInFunction << "hemoscale: viscosity " << nu[i] * unit << " Pa s at shear rate "
                           << shear_rates[i] / units.time
                           << " 1/s is not positive and finite; the flow diverged, or the law is "
                           << "not valid there" << exit(FatalError);
    }
  }
}

}  // namespace

hemoscaleViscosity::hemoscaleViscosity(const word& name, const dictionary& properties,
                                       const volVectorField& U, const surfaceScalarField& phi)
    : viscosityModel(name, properties, U, phi),
      nu_(IOobject(name, U.time().timeName(), U.db(), IOobject::NO_READ, IOobject::AUTO_WRITE),
          U.mesh(), dimensionedScalar(name, dimViscosity, Zero)),
      law_(make_law(properties, U.db())) {
  correct();
}

void hemoscaleViscosity::correct() {
  const tmp<volScalarField> shear_rate = strainRate();
  const volScalarField::Boundary& shear_rate_on_patch = shear_rate().boundaryField();
  std::string failure;
  {
    const hemoscale::macro::FloatingPointTrapsOff traps_off;
    try {
      evaluate(law_, shear_rate().primitiveField(), nu_.primitiveFieldRef());
      volScalarField::Boundary& nu_on_patch = nu_.boundaryFieldRef();
      forAll(nu_on_patch, patch) {
        if (nu_on_patch[patch].coupled()) continue;  // filled from the cells, below
        evaluate(law_, shear_rate_on_patch[patch], nu_on_patch[patch]);
      }
    } catch (const std::runtime_error& error) {
      failure = error.what();
    }
  }
  if (!failure.empty()) {
    FatalErrorInFunction << "hemoscale: " << failure.c_str() << exit(FatalError);
  }
  nu_.correctBoundaryConditions();
  law_.record_correction(nu_);
}

bool hemoscaleViscosity::read(const dictionary& properties) {
  viscosityModel::read(properties);
  if (law_.revision() > 0) return true;
  const hemoscale::macro::InitialLaw initial =
      hemoscale::macro::read_initial_law(properties.subDict("hemoscaleCoeffs"));
  law_.begin_with(initial.law, initial.hematocrit, initial.units);
  return true;
}

}  // namespace viscosityModels
}  // namespace Foam
