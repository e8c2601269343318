#pragma once

#include "macro/openfoam/law_in_use.hpp"
#include "viscosityModel.H"
#include "volFields.H"

namespace Foam {
namespace viscosityModels {

/// Viscosity model `hemoscale`: nu = mu(shear rate, hematocrit) / rho with a law that may be
/// replaced while the solver runs, through the mesh's hemoscaleLawInUse.
///
/// The shear rate is sqrt(2 D:D), OpenFOAM's strainRate(). On patches, walls included, the law is
/// evaluated with the shear rate of the patch. Until the first law arrives that of the dictionary
/// `hemoscaleCoeffs` holds (law_dictionary.hpp).
class hemoscaleViscosity : public viscosityModel {
 public:
  TypeName("hemoscale");

  hemoscaleViscosity(const word& name, const dictionary& properties, const volVectorField& U,
                     const surfaceScalarField& phi);

  tmp<volScalarField> nu() const override { return nu_; }
  tmp<scalarField> nu(const label patch) const override { return nu_.boundaryField()[patch]; }

  /// Ends the run with a FatalError if a viscosity is not finite and positive.
  void correct() override;

  /// The dictionary changed on disk. A new initial law counts only while no law has arrived.
  bool read(const dictionary& properties) override;

 private:
  volScalarField nu_;
  hemoscaleLawInUse law_;
};

}  // namespace viscosityModels
}  // namespace Foam
