#include "micro/ensemble/ring_forces.hpp"

// Versions for wider vectors are chosen when the program starts. Contraction to fused operations is
// off, so that all of them give the same bits.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define HEMOSCALE_VECTOR_CLONES \
  [[gnu::target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")]]
#else
#define HEMOSCALE_VECTOR_CLONES
#endif

namespace hemoscale::micro {
namespace {

template <class Bending>
[[gnu::always_inline]] inline void forces(const Stretch& stretch, const Bending& bending,
                                          const AreaPenalty& area, const RingMesh& mesh,
                                          const double* x, const double* y, RingGeometry& ring,
                                          double* force_x, double* force_y) {
  measure(x, y, ring);
  add_loads(stretch, mesh, ring);
  add_loads(bending, mesh, ring);
  add_loads(area, mesh, ring);
  assemble(ring, force_x, force_y);
}

HEMOSCALE_VECTOR_CLONES
void turning_angle_forces(const Stretch& stretch, const TurningAngleBending& bending,
                          const AreaPenalty& area, const RingMesh& mesh, const double* x,
                          const double* y, RingGeometry& ring, double* force_x, double* force_y) {
  forces(stretch, bending, area, mesh, x, y, ring, force_x, force_y);
}

HEMOSCALE_VECTOR_CLONES
void half_angle_forces(const Stretch& stretch, const HalfAngleBending& bending,
                       const AreaPenalty& area, const RingMesh& mesh, const double* x,
                       const double* y, RingGeometry& ring, double* force_x, double* force_y) {
  forces(stretch, bending, area, mesh, x, y, ring, force_x, force_y);
}

}  // namespace

MembraneLaws make_membrane_laws(const MembraneParameters& parameters) {
  MembraneLaws laws;
  laws.stretch.modulus = parameters.stretch_modulus;
  laws.area.modulus = parameters.area_modulus;
  if (parameters.bending_law == BendingLaw::turning_angle) {
    laws.bending = TurningAngleBending{parameters.bending_modulus};
  } else {
    laws.bending = HalfAngleBending{parameters.bending_modulus};
  }
  return laws;
}

void ring_forces(const MembraneLaws& laws, const RingMesh& mesh, const double* x, const double* y,
                 RingGeometry& scratch, double* force_x, double* force_y) {
  if (const auto* bending = std::get_if<TurningAngleBending>(&laws.bending)) {
    turning_angle_forces(laws.stretch, *bending, laws.area, mesh, x, y, scratch, force_x, force_y);
  } else {
    half_angle_forces(laws.stretch, std::get<HalfAngleBending>(laws.bending), laws.area, mesh, x, y,
                      scratch, force_x, force_y);
  }
}

double ring_energy(const MembraneLaws& laws, const RingMesh& mesh, const double* x, const double* y,
                   RingGeometry& scratch) {
  measure(x, y, scratch);
  const double bending =
      std::visit([&](const auto& law) { return energy(law, mesh, scratch); }, laws.bending);
  return energy(laws.stretch, mesh, scratch) + bending + energy(laws.area, mesh, scratch);
}

}  // namespace hemoscale::micro
