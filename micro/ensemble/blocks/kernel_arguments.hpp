#pragma once

// What the vector kernels are called with: plain pointers and numbers, so that the versions for
// different instruction sets share one interface. Arrays per node are interleaved: entry
// node * width + lane, aligned to 64 bytes.
//
// Unit of length in the kernels: one micrometre, because powers of lengths in metres leave the
// range of single precision. Forces come as displacements: force times tau, tau = dt / zeta.

#include <cstdint>

namespace hemoscale::micro::blocks {

inline constexpr int cluster_nodes = 4;  // consecutive nodes of a ring that are searched together

/// Membrane of one kind of cell, times tau. Tables have an entry per node or segment.
template <class Real>
struct RingTables {
  int nodes = 0;
  const Real* rest = nullptr;          // [um] l0 of a segment
  const Real* inverse_rest = nullptr;  // [1/um] 1 / l0
  const Real* bending = nullptr;       // [um^2] tau kappa / l0 at a node
  const Real* natural = nullptr;       // [-] angle theta0, or tan(theta0/2) for the half-angle law
  Real stretch = 0;                    // [um] tau E_l
  Real area = 0;                       // [1/um^2] tau k_A / A0
  Real largest_stretch = 0;            // [-] tau E_l / smallest l0
  Real largest_bending = 0;            // [-] bound on tau kappa / l0^3
  Real rest_area = 0;                  // [um^2]
  Real normal_excess = 0;              // [-] drag along the membrane over that across it, less one
  Real momentum = 0;                   // [1/um] k / (zeta dt) of the momentum drag
};

/// One stage of a Runge-Kutta-Chebyshev step, see rkc_ring.inl. [-]
template <class Real>
struct StageWeights {
  Real base = 1, before = 0, second = 0, force = 0, first_force = 0;
};

/// Walls y = 0 and y = height of a plane channel. Without walls the stiffness is zero.
template <class Real>
struct PlaneWalls {
  Real stiffness = 0;  // [-] tau k
  Real range = 0;      // [um]
  Real height = 0;     // [um]
};

/// One block of cells: as many as a vector has lanes.
template <class Real>
struct BlockArguments {
  const RingTables<Real>* ring = nullptr;
  PlaneWalls<Real> walls;
  Real* x = nullptr;  // [um] offsets from the frames
  Real* y = nullptr;
  Real* memory_x = nullptr;     // [um] second state of an integrator, if it has one: what rounding
  Real* memory_y = nullptr;     // dropped, or the displacement in the last step, frame included
  const Real* drift = nullptr;  // [um] two rows of lanes: displacement of the frame in this step
  Real* area = nullptr;         // [um^2] per lane, of the present shape
  const Real* frame_y = nullptr;  // [um] per lane, height of the frame above the lower wall
  // Flow relative to the frame, times dt, as rows of lanes: gradient xx, xy, yx, yy; of u_x half
  // the second derivative xx, the mixed one, half of yy; the same of u_y. A flow along x that
  // varies with y alone needs rows 1 and 6 only.
  const Real* flow = nullptr;
  // Forces of contacts and general walls, times tau, and the part of their stiffness that is kept
  // on the diagonal; [um] and [-], nodes * width each.
  const Real* force_x = nullptr;
  const Real* force_y = nullptr;
  const Real* stiffness_xx = nullptr;
  const Real* stiffness_xy = nullptr;
  const Real* stiffness_yy = nullptr;
  Real* scratch = nullptr;  // as the kernel asks
  Real share = 1;  // [-] of the new forces in a step: 1 for first, 2/3 for second order; of the
                   // terminal velocity in that of a node with mass
  Real move = 1;   // [-] 0: improve the displacements in the memory, move nothing
  const StageWeights<Real>* stages = nullptr;
  int stage_count = 0;
  Real* extremes = nullptr;  // 3 rows of lanes: smallest (at most 1) and largest (at least 1)
                             // l0/l, largest square of a displacement against the flow [um^2]
};

/// Contacts between clusters of nodes of different cells.
struct ActiveCluster {
  std::uint16_t cluster;  // of its cell
  std::uint16_t lane;     // of its block
  std::uint32_t end;      // of its entries; they begin where those of the cluster before end
};
struct ClusterEntry {
  std::uint32_t other;  // cluster in the mirror
  std::uint32_t shift;  // row of the table of displacements between frames
};

/// Polynomial pair force F = A (rc^2-s)^2 (r0^2-s) d, times tau.
template <class Real>
struct PolynomialPair {
  Real scale = 0;       // [1/um^6]
  Real rest = 0;        // [um^2] r0^2
  Real cutoff = 0;      // [um^2] rc^2
  Real attraction = 0;  // [-]
};

/// Morse's force, times tau.
template <class Real>
struct MorsePair {
  Real scale = 0;      // [um] tau 2 b D
  Real steepness = 0;  // [1/um] b
  Real rest = 0;       // [um] re
  Real cut_force = 0;  // [um] tau F before the shift, at the cutoff
  Real cutoff = 0;     // [um^2] rc^2
};

/// Force of Lennard-Jones form, times tau.
template <class Real>
struct LennardJonesPair {
  Real scale = 0;      // [um^2] tau 12 e
  Real rest = 0;       // [um] re
  Real core = 1;       // [um]
  Real cut_force = 0;  // [um] tau F before the shift, at the cutoff
  Real cutoff = 0;     // [um^2] rc^2
};

/// Kernels of contacts exist once for every form.
enum PairForm { polynomial_form, morse_form, lennard_jones_form };
inline constexpr int pair_forms = 3;

template <class Real>
struct PairArguments {
  PolynomialPair<Real> law;  // these three: the one that belongs to the kernel
  MorsePair<Real> morse;
  LennardJonesPair<Real> lennard_jones;
  const Real* mirror = nullptr;  // clusters of x0..x3, y0..y3
  const ActiveCluster* active = nullptr;
  std::uint32_t active_count = 0;
  std::uint32_t first_entry = 0;
  const ClusterEntry* entries = nullptr;
  const Real* shifts = nullptr;  // [um] pairs (x, y): frame of the other minus own
  const std::uint32_t* first_cluster =
      nullptr;  // per lane: first cluster of the cell in the mirror
  int nodes = 0;
  Real* force_x = nullptr;  // as in BlockArguments, zero on entry
  Real* force_y = nullptr;
  Real* stiffness_xx = nullptr;
  Real* stiffness_xy = nullptr;
  Real* stiffness_yy = nullptr;
  int width = 0;
};

/// A list of a block, as in PairArguments, and room for what is kept of it.
template <class Real>
struct PruneArguments {
  const Real* mirror = nullptr;
  const ActiveCluster* active = nullptr;
  std::uint32_t active_count = 0;
  const ClusterEntry* entries = nullptr;
  const Real* shifts = nullptr;
  const std::uint32_t* first_cluster = nullptr;
  Real reach_squared = 0;  // [um^2]
  ActiveCluster* kept_active = nullptr;
  ClusterEntry* kept_entries = nullptr;
};
struct PruneCounts {
  std::uint32_t active = 0, entries = 0;
};

template <class Real>
struct MirrorArguments {
  int nodes = 0;
  const Real* x = nullptr;
  const Real* y = nullptr;
  const Real* add_x = nullptr;  // predicted displacements that are added, or null
  const Real* add_y = nullptr;
  const Real* drift = nullptr;  // [um] two rows of lanes, of the frame; subtracted from them
  Real* mirror = nullptr;       // of all cells
  const std::uint32_t* first_cluster = nullptr;  // per lane
};

/// Boxes of clusters in four arrays, which can be read up to a multiple of box_group.
inline constexpr int box_group = 16;
struct BoxArguments {
  const float* x0 = nullptr;  // [um]
  const float* x1 = nullptr;
  const float* y0 = nullptr;
  const float* y1 = nullptr;
  int count = 0;
  float own_x0 = 0, own_x1 = 0, own_y0 = 0, own_y1 = 0;  // [um]
  float reach_squared = 0;                               // [um^2]
  std::uint16_t* hits = nullptr;  // room for `count`: numbers of the boxes that are nearer
};

/// Which kernel of an integrator is needed; chosen once.
struct KernelChoice {
  bool half_angle = false;    // bending law; otherwise turning angles
  bool parallel_flow = true;  // along x, varying with y alone
  bool plane_walls = false;
};
constexpr int kernel_index(KernelChoice c) {
  return (c.half_angle ? 4 : 0) + (c.parallel_flow ? 2 : 0) + (c.plane_walls ? 1 : 0);
}
inline constexpr int kernel_choices = 8;

/// The kernels in one version.
template <class Real>
struct Kernels {
  using Step = void (*)(const BlockArguments<Real>&);
  using Pairs = void (*)(const PairArguments<Real>&);
  Pairs pairs[pair_forms] = {};
  Pairs stiff_pairs[pair_forms] = {};    // with the stiffness
  Pairs bounded_pairs[pair_forms] = {};  // with a bound on it, in ..._xx
  PruneCounts (*prune)(const PruneArguments<Real>&) = nullptr;
  void (*mirror)(const MirrorArguments<Real>&) = nullptr;
  int (*near_boxes)(const BoxArguments&) = nullptr;  // @returns how many hits
  Step implicit_step[kernel_choices] = {};
  Step explicit_step[kernel_choices] = {};
  Step constant_operator_step[kernel_choices] = {};
  Step inertial_step[kernel_choices] = {};
  Step chebyshev_step[kernel_choices] = {};
  const char* name = nullptr;
};

/// Scratch of the implicit kernel in numbers per lane and node.
inline constexpr int implicit_scratch_rows = 18;

/// The widest version that this processor can run. The environment variable HEMOSCALE_VECTORS =
/// plain | v3 | v4 asks for a narrower one, for tests and comparisons.
/// @throws EnvironmentError if the variable asks for a version that does not exist or cannot run
template <class Real>
const Kernels<Real>& kernels();

}  // namespace hemoscale::micro::blocks
