#pragma once

#include <utility>

#include "macro/openfoam/mesh_units.hpp"
#include "macro/viscosity/viscosity_law.hpp"
#include "regIOobject.H"
#include "volFieldsFwd.H"

namespace Foam {

/// The place where a viscosity law reaches a mesh: an object in the mesh's registry, made by the
/// viscosity model `hemoscale`, in which the coupling leaves each new law. No file is behind it.
class hemoscaleLawInUse : public regIOobject {
 public:
  TypeName("hemoscaleLawInUse");

  hemoscaleLawInUse(const objectRegistry& mesh, hemoscale::macro::ViscosityLaw law,
                    double hematocrit, const hemoscale::macro::MeshUnits& units);

  /// The one of that mesh, or null if its solver does not use the viscosity model `hemoscale`.
  static hemoscaleLawInUse* find(const objectRegistry& mesh);

  const hemoscale::macro::ViscosityLaw& law() const { return law_; }
  double hematocrit() const { return hematocrit_; }  // [-] uniform
  const hemoscale::macro::MeshUnits& units() const { return units_; }

  /// The law from now on; takes effect when the viscosity model is corrected.
  void assign(hemoscale::macro::ViscosityLaw law, double hematocrit) {
    law_ = std::move(law);
    hematocrit_ = hematocrit;
    ++revision_;
  }
  /// Another law of the dictionary, before any has been assigned.
  void begin_with(hemoscale::macro::ViscosityLaw law, double hematocrit,
                  const hemoscale::macro::MeshUnits& units) {
    law_ = std::move(law);
    hematocrit_ = hematocrit;
    units_ = units;
  }
  label revision() const { return revision_; }  // laws assigned so far; 0: that of the dictionary

  /// What the viscosity model last did with it.
  void record_correction(const volScalarField& nu) {
    nu_ = &nu;
    applied_revision_ = revision_;
    ++corrections_;
  }
  label corrections() const { return corrections_; }  // times the viscosity was computed
  label applied_revision() const { return applied_revision_; }
  const volScalarField* nu() const { return nu_; }  // [mesh units] the model's field

  bool writeData(Ostream&) const override { return true; }

 private:
  hemoscale::macro::ViscosityLaw law_;
  double hematocrit_;  // [-]
  hemoscale::macro::MeshUnits units_;
  label revision_ = 0;
  label applied_revision_ = -1;
  label corrections_ = 0;
  const volScalarField* nu_ = nullptr;
};

}  // namespace Foam
