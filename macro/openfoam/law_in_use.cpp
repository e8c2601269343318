#include "macro/openfoam/law_in_use.hpp"

#include "objectRegistry.H"

namespace Foam {

defineTypeNameAndDebug(hemoscaleLawInUse, 0);

hemoscaleLawInUse::hemoscaleLawInUse(const objectRegistry& mesh, hemoscale::macro::ViscosityLaw law,
                                     double hematocrit, const hemoscale::macro::MeshUnits& units)
    : regIOobject(
          IOobject(typeName, mesh.instance(), mesh, IOobject::NO_READ, IOobject::NO_WRITE, true)),
      law_(std::move(law)),
      hematocrit_(hematocrit),
      units_(units) {}

hemoscaleLawInUse* hemoscaleLawInUse::find(const objectRegistry& mesh) {
  return mesh.getObjectPtr<hemoscaleLawInUse>(typeName);
}

}  // namespace Foam
