// All kernels in one version. A file that includes this defines HEMOSCALE_VERSION, the name of the
// version, and is compiled for its instruction set. Everything lies in a namespace of that name and
// is inlined into the few functions that the table points to.

#include <stddef.h>
#if defined(__AVX512F__)
#include <immintrin.h>
#endif

#include "micro/ensemble/blocks/kernel_arguments.hpp"
#include "micro/ensemble/blocks/kernel_versions.hpp"

namespace hemoscale::micro::blocks::HEMOSCALE_VERSION {
namespace {

// Each builds on those above it.
// clang-format off
#include "micro/ensemble/blocks/lanes.inl"
#include "micro/ensemble/blocks/ring_shape.inl"
#include "micro/ensemble/blocks/flow_and_walls.inl"
#include "micro/ensemble/blocks/implicit_ring.inl"
#include "micro/ensemble/blocks/ring_pass.inl"
#include "micro/ensemble/blocks/explicit_ring.inl"
#include "micro/ensemble/blocks/inertial_ring.inl"
#include "micro/ensemble/blocks/rkc_ring.inl"
#include "micro/ensemble/blocks/constant_operator_ring.inl"
#include "micro/ensemble/blocks/exponential.inl"
#include "micro/ensemble/blocks/pair_laws.inl"
#include "micro/ensemble/blocks/pair_kernel.inl"
#include "micro/ensemble/blocks/prune_kernel.inl"
#include "micro/ensemble/blocks/mirror_kernel.inl"
#include "micro/ensemble/blocks/box_kernel.inl"
// clang-format on

int near_boxes(const BoxArguments& g) {
  return find_near_boxes(g);
}

template <class Real, class Law, PairStiffness stiffness>
void pairs(const PairArguments<Real>& g) {
  contact_forces<Real, Law, stiffness>(g);
}
template <class Real>
PruneCounts prune(const PruneArguments<Real>& g) {
  return prune_entries<Real>(g);
}
template <class Real>
void mirror(const MirrorArguments<Real>& g) {
  if (g.add_x != nullptr) {
    write_mirror<Real, true>(g);
  } else {
    write_mirror<Real, false>(g);
  }
}
template <class Real, class Bending, bool parallel_flow, bool walls>
void implicit_kernel(const BlockArguments<Real>& g) {
  implicit_ring<Real, Bending, parallel_flow, walls>(g);
}
template <class Real, class Bending, bool parallel_flow, bool walls>
void explicit_kernel(const BlockArguments<Real>& g) {
  explicit_ring<Real, Bending, parallel_flow, walls>(g);
}
template <class Real, class Bending, bool parallel_flow, bool walls>
void constant_operator_kernel(const BlockArguments<Real>& g) {
  constant_operator_ring<Real, Bending, parallel_flow, walls>(g);
}

// These are not for speed: one kernel for all flows, with walls whose stiffness may be zero.
template <class Real, class Bending>
void inertial_kernel(const BlockArguments<Real>& g) {
  inertial_ring<Real, Bending, false, true>(g);
}
template <class Real, class Bending>
void chebyshev_kernel(const BlockArguments<Real>& g) {
  rkc_ring<Real, Bending, false, true>(g);
}

template <class Real, class Law>
constexpr void set_pairs(Kernels<Real>& table, PairForm form) {
  table.pairs[form] = pairs<Real, Law, PairStiffness::none>;
  table.stiff_pairs[form] = pairs<Real, Law, PairStiffness::diagonal_blocks>;
  table.bounded_pairs[form] = pairs<Real, Law, PairStiffness::bound>;
}

template <class Real, class Bending, bool parallel_flow, bool walls>
constexpr void set_steps(Kernels<Real>& table, bool half_angle) {
  const int index = kernel_index({half_angle, parallel_flow, walls});
  table.implicit_step[index] = implicit_kernel<Real, Bending, parallel_flow, walls>;
  table.explicit_step[index] = explicit_kernel<Real, Bending, parallel_flow, walls>;
  table.constant_operator_step[index] =
      constant_operator_kernel<Real, Bending, parallel_flow, walls>;
  table.inertial_step[index] = inertial_kernel<Real, Bending>;
  table.chebyshev_step[index] = chebyshev_kernel<Real, Bending>;
}

template <class Real>
constexpr Kernels<Real> make_table(const char* name) {
  Kernels<Real> table;
  set_pairs<Real, PolynomialLaw>(table, polynomial_form);
  set_pairs<Real, MorseLaw>(table, morse_form);
  set_pairs<Real, LennardJonesLaw>(table, lennard_jones_form);
  table.prune = prune<Real>;
  table.mirror = mirror<Real>;
  table.near_boxes = near_boxes;
  set_steps<Real, TurningAngle, false, false>(table, false);
  set_steps<Real, TurningAngle, false, true>(table, false);
  set_steps<Real, TurningAngle, true, false>(table, false);
  set_steps<Real, TurningAngle, true, true>(table, false);
  set_steps<Real, HalfAngle, false, false>(table, true);
  set_steps<Real, HalfAngle, false, true>(table, true);
  set_steps<Real, HalfAngle, true, false>(table, true);
  set_steps<Real, HalfAngle, true, true>(table, true);
  table.name = name;
  return table;
}

#define HEMOSCALE_NAME_OF(version) #version
#define HEMOSCALE_NAME(version) HEMOSCALE_NAME_OF(version)

}  // namespace

// Constant-initialised: no code of this version runs before it is chosen.
constinit const Kernels<float> single_kernels =
    make_table<float>(HEMOSCALE_NAME(HEMOSCALE_VERSION));
constinit const Kernels<double> double_kernels =
    make_table<double>(HEMOSCALE_NAME(HEMOSCALE_VERSION));

}  // namespace hemoscale::micro::blocks::HEMOSCALE_VERSION
