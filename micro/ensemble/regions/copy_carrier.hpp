#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "micro/ensemble/blocks/block_store.hpp"
#include "micro/ensemble/flow/given_flow.hpp"

namespace hemoscale::micro::regions {

/// How copies of cells of other ranks move between two exchanges.
enum class CopyMotion {
  frozen,  // not at all: they stay where they were in the channel [Tsubota2006, section 3.3]
  flow,    // every node with the given flow
  slip  // besides, every node with the slip that it had, on average, between the last two exchanges
};

struct CopyCarrierSettings {
  CopyMotion motion = CopyMotion::slip;
  const GivenFlow* flow = nullptr;
  double start = 0;           // [s] time of step 0
  double time_step = 0;       // [s]
  std::int64_t interval = 1;  // [steps] between exchanges
};

/// Moves the copies of a store from exchange to exchange.
///
///   x(s+1) = x(s) + dt [u(x(s)) + v],     v += (x - x_carried) / (interval dt)  at an exchange
///
/// The flow is expanded about the frame of the copy where it was at the exchange. The slip v of a
/// node is what the flow alone lacked in the last interval: contacts push cells for longer than
/// that.
template <class Real>
class CopyCarrier {
 public:
  explicit CopyCarrier(const CopyCarrierSettings& settings) : settings_(settings) {}

  /// Copies will be found anew at a step: remembers the slips of the present ones, and where they
  /// would have been carried to.
  void remember(blocks::BlockStore<Real>& store, std::int64_t step);

  /// Copies were found anew; those that were there before keep their slips.
  void begin(const blocks::BlockStore<Real>& store);

  /// Puts a copy where its cell is at a step. @returns where the bytes of the next one are
  const char* place_copy(blocks::BlockStore<Real>& store, std::int64_t step, std::size_t place,
                         const char* bytes);
  /// All copies were placed.
  void end_placing(std::int64_t step) {
    placed_at_ = step;
    remembered_.clear();
  }

  /// Carries a group of copies from a step to the next.
  void carry(blocks::BlockStore<Real>& store, std::int64_t step, std::size_t group) const;

 private:
  /// Displacements in a step by the flow.
  struct Motion {
    Vector<2> frame = Vector<2>::Zero();  // [um]
    Real x[5] = {}, y[5] = {};            // [um] of offsets: factors of x, y, xx, xy, yy
  };

  /// A copy that was there before copies were found anew.
  struct Remembered {
    std::vector<Real> slip;
    std::vector<Real> carried;  // [um] mirror; empty if it was not carried a whole interval
    Vector<2> frame = Vector<2>::Zero();  // [um] as carried
  };

  bool ends_interval(std::int64_t step) const {
    return slips() && placed_at_ >= 0 && step - placed_at_ == settings_.interval;
  }
  bool slips() const { return settings_.interval > 1 && settings_.motion == CopyMotion::slip; }
  std::size_t slip_begin(const blocks::BlockStore<Real>& store, std::size_t place) const;
  void carry_copy(blocks::BlockStore<Real>& store, std::int64_t step, std::size_t place) const;
  void set_motion(Motion& motion, const Vector<2>& frame, std::int64_t step) const;
  void correct_slip(const blocks::BlockStore<Real>& store, std::size_t place, const Real* mirror,
                    const Vector<2>& ahead);

  CopyCarrierSettings settings_;
  std::int64_t placed_at_ = -1;  // step; -1: not since copies were found
  std::vector<Motion> motions_;  // per copy
  std::vector<Real> slips_;      // [um per step] as in the mirror
  std::vector<Real> carried_;    // [um] mirror of a copy before it was placed
  std::map<blocks::CellId, Remembered> remembered_;
};

}  // namespace hemoscale::micro::regions
