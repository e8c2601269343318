#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "micro/ensemble/blocks/block_store.hpp"
#include "micro/ensemble/flow/given_flow.hpp"

namespace hemoscale::micro::regions {

/// How copies of cells of other ranks move between two exchanges.
enum class CopyMotion {
  frozen,  // not at all: they stay where they were in the channel [Tsubota2006, section 3.3]
  flow     // every node with the given flow
};

struct CopyCarrierSettings {
  CopyMotion motion = CopyMotion::flow;
  const GivenFlow* flow = nullptr;
  double start = 0;           // [s] time of step 0
  double time_step = 0;       // [s]
  std::int64_t interval = 1;  // [steps] between exchanges
};

/// Moves the copies of a store from exchange to exchange: x(s+1) = x(s) + dt u(x(s)), with the flow
/// expanded about the frame of the copy where it was at the exchange.
///
/// The slip of cells in contact is left out on purpose. Extrapolated from the last interval it
/// halves the error of short intervals, but from about 6 zeta/k0 on (see exchange_interval.hpp) two
/// cells in contact on different ranks answer each other's prediction, and the gap between them
/// oscillates.
template <class Real>
class CopyCarrier {
 public:
  explicit CopyCarrier(const CopyCarrierSettings& settings) : settings_(settings) {}

  /// Copies were found anew.
  void begin(const blocks::BlockStore<Real>& store) {
    motions_.assign(store.ids.size() - store.places(), {});
  }

  /// Puts a copy where its cell is at a step. @returns where the bytes of the next one are
  const char* place_copy(blocks::BlockStore<Real>& store, std::int64_t step, std::size_t place,
                         const char* bytes);

  /// Carries a group of copies from a step to the next.
  void carry(blocks::BlockStore<Real>& store, std::int64_t step, std::size_t group) const;

 private:
  /// Displacements in a step by the flow.
  struct Motion {
    Vector<2> frame = Vector<2>::Zero();  // [um]
    Real x[5] = {}, y[5] = {};            // [um] of offsets: factors of x, y, xx, xy, yy
  };

  void carry_copy(blocks::BlockStore<Real>& store, std::int64_t step, std::size_t place) const;
  void set_motion(Motion& motion, const Vector<2>& frame, std::int64_t step) const;

  CopyCarrierSettings settings_;
  std::vector<Motion> motions_;  // per copy
};

}  // namespace hemoscale::micro::regions
