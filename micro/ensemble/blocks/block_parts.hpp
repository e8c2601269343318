#pragma once

// Private to the stepper: what it keeps between steps, and the parts of its work.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include "micro/ensemble/blocks/block_schedule.hpp"
#include "micro/ensemble/blocks/block_stepper.hpp"
#include "micro/ensemble/blocks/cell_copies.hpp"
#include "micro/ensemble/blocks/chebyshev_weights.hpp"
#include "micro/ensemble/blocks/pair_arguments.hpp"

namespace hemoscale::micro::blocks {

// Cells whose nodes have drifted from the frame are given a new one. Looked at every so many steps,
// counted from step 0, so that a restart does the same.
inline constexpr std::int64_t steps_between_centrings = 64;
inline constexpr double allowed_drift = 0.5;  // [um]

// A stretch of steps without a look at the list is at most this long.
inline constexpr std::int64_t longest_leg = 64;

// The part of the skin that is left to lists when they are pruned.
inline constexpr double inner_share = 0.25;

// The part of the skin by which contacts are searched for where lists are not pruned.
inline constexpr double share_with_copies = 0.4;

// The motion that is expected of the next leg, over that of the last: contacts may begin. It comes
// in bursts, which are not forgotten at once, and a leg is not much longer than the one before.
inline constexpr double caution = 1.5;
inline constexpr double memory_of_motion = 0.9;
inline constexpr std::int64_t longest_growth = 2;

// An even number, so that the state is in the same buffer again; soft modes need most.
inline constexpr std::int64_t preparing_iterations = 100;

// Tiles of every thread in the cache.
inline constexpr std::size_t tiles_in_cache = 3;

// Rounds of fewer steps are not worth the order.
inline constexpr std::size_t least_round = 3;

// Motion in a step before any is known, and where there is none. [um]
inline constexpr double first_reach_per_step = 0.02;
inline constexpr double least_reach_per_step = 1e-6;

// Single precision may see a distance that much shorter than it is, in the search and in forces.
// [um]
inline constexpr double rounding_of_distances = 1e-5;

/// A membrane in the units of the kernels.
template <class Real>
struct KernelRing {
  AlignedArray<Real> rest, inverse_rest, bending, natural;
  RingTables<Real> tables;
};

template <class Real>
void set_ring(const KindSettings& kind, double time_step, KernelRing<Real>& ring) {
  const double tau = time_step / kind.node_drag;
  const auto n = static_cast<std::size_t>(kind.mesh.nodes);
  const auto* half_angle = std::get_if<HalfAngleBending>(&kind.laws.bending);
  const double modulus = half_angle != nullptr
                             ? half_angle->modulus
                             : std::get<TurningAngleBending>(kind.laws.bending).modulus;
  for (std::size_t i = 0; i < n; ++i) {
    ring.rest.push_back(static_cast<Real>(kind.mesh.rest_length[i] / micrometre));
    ring.inverse_rest.push_back(static_cast<Real>(micrometre / kind.mesh.rest_length[i]));
    ring.bending.push_back(
        static_cast<Real>(tau * modulus / kind.mesh.node_length[i] / (micrometre * micrometre)));
    ring.natural.push_back(static_cast<Real>(
        half_angle != nullptr ? kind.mesh.natural_half_tangent[i] : kind.mesh.natural_angle[i]));
  }
  ring.tables.nodes = kind.mesh.nodes;
  ring.tables.rest = ring.rest.data();
  ring.tables.inverse_rest = ring.inverse_rest.data();
  ring.tables.bending = ring.bending.data();
  ring.tables.natural = ring.natural.data();
  ring.tables.stretch = static_cast<Real>(tau * kind.laws.stretch.modulus / micrometre);
  ring.tables.area = static_cast<Real>(tau * kind.laws.area.modulus / kind.mesh.rest_area *
                                       micrometre * micrometre);
  const double l0 = *std::min_element(kind.mesh.rest_length.begin(), kind.mesh.rest_length.end());
  ring.tables.largest_stretch = static_cast<Real>(tau * kind.laws.stretch.modulus / l0);
  ring.tables.largest_bending = static_cast<Real>(tau * modulus / (l0 * l0 * l0));
  ring.tables.rest_area = static_cast<Real>(kind.mesh.rest_area / (micrometre * micrometre));
  ring.tables.normal_excess = static_cast<Real>(1 / kind.normal_drag - 1);
  ring.tables.momentum =
      static_cast<Real>(kind.momentum_drag * micrometre / (kind.node_drag * time_step));
}

using Clock = std::chrono::steady_clock;
inline double seconds_since(Clock::time_point t) {
  return std::chrono::duration<double>(Clock::now() - t).count();
}

template <class Real>
struct BlockStepper<Real>::Parts {
  static constexpr std::size_t width = BlockStore<Real>::width;
  static constexpr std::size_t flow_rows = 10;

  BlockSettings settings;
  const Kernels<Real>& table;
  std::vector<KernelRing<Real>> rings;
  std::vector<PairArguments<Real>> pairs;  // the law of contact alone, per kind
  typename Kernels<Real>::Step kernel = nullptr;
  typename Kernels<Real>::Pairs pair_kernel = nullptr;
  std::size_t force_arrays = 5;  // that the pair kernel writes
  bool changing_flow = false;    // in time, or along the motion of a frame
  bool predicts = false;  // mirrors hold the positions that the next step is expected to reach
  Real share = 1;
  Real move = 1;
  std::vector<Real> velocity_shares;  // [-] of the terminal velocity, per kind; nodes with mass
  std::vector<StageWeights<Real>> stages;  // of Integrator::chebyshev
  double contact_cutoff = 0;               // [um]
  PlaneWalls<Real> walls;
  ThreadTeam team;
  std::vector<ContactList> wide_lists;  // per thread: of its blocks, as they were searched for
  std::vector<ContactList> lists;       // what was within the inner range when they were pruned
  bool list_is_valid = false;
  bool must_prune = false;
  bool must_size = true;
  double strain = 0;                             // [-] of the flow since the search
  double strain_at_pruning = 0;                  // [-]
  double reach_before = 0;                       // [um] that is used of the inner range
  double reach_per_step = first_reach_per_step;  // [um] in the last legs
  std::int64_t leg_before = 4;                   // [steps]
  StepCounters counters;

  // Per place.
  AlignedArray<Real> flow;                // rows of lanes per block
  AlignedArray<Real> frame_y;             // [um] above the lower wall
  AlignedArray<Real> drift;               // [um] two rows of lanes per block, of the frames
  AlignedArray<Real> extremes;            // rows of lanes per block, of the last step
  std::vector<Vector<2>> velocity;        // [um per step] of the frames
  std::vector<double> migration;          // [um per step] of the frames, across the flow
  std::vector<double> travel;             // [um] relative to the flow since the search
  std::vector<double> travel_at_pruning;  // [um]
  std::vector<double> longest, shortest;  // [-] l / l0 in this stretch
  std::vector<unsigned char> broken;      // met a number that is not finite

  // Per thread.
  struct Scratch {
    AlignedArray<Real> forces;  // five arrays of nodes * width
    AlignedArray<Real> solver;
    std::vector<Real> shifts;
  };
  std::vector<Scratch> scratch;
  std::vector<std::vector<std::size_t>> blocks_of_thread;
  struct alignas(64) Turn {
    std::atomic<std::size_t> next{0};
  };
  std::vector<Turn> turns;                        // tasks of a thread that were begun in this leg
  std::vector<std::vector<BlockTask>> schedules;  // per thread
  std::vector<std::size_t> member_of_block;       // whose list it is in
  std::size_t spread = 0;                         // [-] numbers between blocks that see each other
  // Per block: all other blocks whose cells it sees; with copies those of other threads alone, and
  // groups of copies.
  std::vector<std::vector<std::size_t>> awaited;
  std::vector<Milestone> done;  // per block and group of copies: the step whose state is complete

  // Times count from step 0, and the offset grows by one step after the other: neither depends on
  // how steps are divided into calls, or by looks at the list.
  std::int64_t first_step = 0;
  std::vector<double> offsets = {0};  // [m] of the image above, from first_step on
  double start = 0;                   // [s] time of step 0
  double slide = 0;                   // [m] of the image above in one step

  // Copies of cells of other ranks.
  std::optional<CopyUpdates> copies;
  std::int64_t found_at = -1;                 // step at which they were filled last
  std::vector<std::size_t> blocks_at_copies;  // that see copies or are copied
  std::vector<std::vector<std::size_t>> groups_of_thread;

  explicit Parts(BlockSettings s)
      : settings(std::move(s)), table(kernels<Real>()), team(settings.threads) {
    KernelChoice choice;
    for (const KindSettings& kind : settings.kinds) {
      rings.emplace_back();
      choice.half_angle = std::holds_alternative<HalfAngleBending>(kind.laws.bending);
    }
    for (std::size_t k = 0; k < settings.kinds.size(); ++k) {
      set_ring(settings.kinds[k], settings.time_step, rings[k]);
      pairs.push_back(
          pair_arguments<Real>(settings.contact, settings.time_step / settings.kinds[k].node_drag));
    }
    contact_cutoff = cutoff_of(settings.contact) / micrometre;
    const auto form = settings.contact.index();
    choice.parallel_flow = settings.parallel_flow;
    changing_flow =
        !settings.parallel_flow || !settings.flow->is_steady() || settings.migration.is_any();
    choice.plane_walls = settings.plane_walls.has_value();
    const int index = kernel_index(choice);
    switch (settings.integrator) {
      case Integrator::explicit_euler:
        kernel = table.explicit_step[index];
        pair_kernel = table.pairs[form];
        force_arrays = 2;
        break;
      case Integrator::inertial:
        kernel = table.inertial_step[index];
        pair_kernel = table.pairs[form];
        force_arrays = 2;
        for (const KindSettings& kind : settings.kinds) {
          velocity_shares.push_back(static_cast<Real>(
              -std::expm1(-settings.time_step * kind.node_drag / kind.node_mass)));
        }
        break;
      case Integrator::chebyshev:
        kernel = table.chebyshev_step[index];
        pair_kernel = table.pairs[form];
        force_arrays = 2;
        for (const StageWeights<double>& w : chebyshev_weights(settings.stages)) {
          stages.push_back({static_cast<Real>(w.base), static_cast<Real>(w.before),
                            static_cast<Real>(w.second), static_cast<Real>(w.force),
                            static_cast<Real>(w.first_force)});
        }
        break;
      case Integrator::linearly_implicit:
        kernel = table.implicit_step[index];
        pair_kernel = table.stiff_pairs[form];
        force_arrays = 5;
        break;
      case Integrator::constant_operator_second_order:
        share = static_cast<Real>(2.0 / 3.0);
        [[fallthrough]];
      case Integrator::constant_operator:
        kernel = table.constant_operator_step[index];
        pair_kernel = table.bounded_pairs[form];
        force_arrays = 3;
        predicts = true;
        break;
    }
    if (settings.plane_walls) {
      walls.range = static_cast<Real>(settings.plane_walls->range / micrometre);
      walls.height = static_cast<Real>(settings.height / micrometre);
    }
    scratch.resize(static_cast<std::size_t>(settings.threads));
    lists.resize(scratch.size());
    wide_lists.resize(scratch.size());
    blocks_of_thread.resize(scratch.size());
    turns = std::vector<Turn>(scratch.size());
    schedules.resize(scratch.size());
  }

  /// Whether the memory is the motion in the last step.
  bool keeps_motion() const { return predicts || !velocity_shares.empty(); }

  Periodicity periodicity(double image_offset) const {
    return {settings.length / micrometre, settings.periodic_y ? settings.height / micrometre : 0,
            image_offset / micrometre};
  }

  void size_arrays(const BlockStore<Real>& store);
  bool copies_are_due(std::int64_t step) const {
    return copies && copies->come_anew(step) && step != found_at;
  }
  void build_list(const BlockStore<Real>& store, std::int64_t step, double image_offset);
  std::pair<std::size_t, std::size_t> blocks_of(std::size_t blocks, std::size_t member) const;
  void prune_lists(const BlockStore<Real>& store, std::int64_t step, double image_offset);
  void prune_block(const BlockStore<Real>& store, std::int64_t step, const Periodicity& p,
                   std::size_t block, std::size_t member);
  void set_shifts(const BlockStore<Real>& store, std::int64_t step, const Periodicity& p,
                  std::size_t block, const ContactList& list, std::vector<Real>& shifts) const;
  void order_blocks(const BlockStore<Real>& store);
  bool is_between_walls(const Real* y, std::size_t nodes, double frame) const;
  void centre_block(BlockStore<Real>& store, std::int64_t step, std::size_t number);
  void set_flow(const BlockStore<Real>& store, std::int64_t step, double time, std::size_t block);
  void set_migration(const BlockStore<Real>& store, std::int64_t step, double time,
                     std::size_t block);
  void step_block(BlockStore<Real>& store, std::int64_t step, double time, double image_offset,
                  std::size_t block, const ContactList& list, Scratch& s);
  void prepare(BlockStore<Real>& store, std::int64_t step, double time, double image_offset);
  void write_mirror(BlockStore<Real>& store, std::size_t parity, std::size_t block) const;
  void expect_drift(BlockStore<Real>& store, std::size_t block) const;
  void watch_block(const BlockStore<Real>& store, std::size_t block);
  SharedWatch watch_cells(const BlockStore<Real>& store) const;
  double inner_range() const;
  double wide_range() const;
  double inner_reach(const SharedWatch& watch) const;
  double wide_reach(const SharedWatch& watch) const;
  double time_of(std::int64_t step) const {
    return start + settings.time_step * static_cast<double>(step);
  }
  double offset_of(std::int64_t step) const {
    return offsets[static_cast<std::size_t>(step - first_step)];
  }
  /// Keeps the offsets from step `first` on and adds those up to `last`.
  void set_offsets(std::int64_t first, std::int64_t last) {
    offsets = {offset_of(first)};
    first_step = first;
    while (first_step + static_cast<std::int64_t>(offsets.size()) <= last) {
      offsets.push_back(offsets.back() + slide);
    }
  }
  std::size_t bytes_of(const BlockStore<Real>& store) const;
  void set_schedules(const BlockStore<Real>& store, std::size_t steps);
  void share_leg(BlockStore<Real>& store, std::int64_t first, std::int64_t last);
  void run_leg(BlockStore<Real>& store, std::int64_t first, std::int64_t last);
  void step_member(BlockStore<Real>& store, std::int64_t step, int member);
};

}  // namespace hemoscale::micro::blocks
