#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "micro/ensemble/blocks/block_settings.hpp"
#include "micro/ensemble/box.hpp"
#include "micro/ensemble/state.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// Cells of one kind that are to be packed.
struct RandomPacking {
  blocks::KindSettings kind;
  std::vector<Vector<2>> outline;  // [m] undeformed cell, centred on the origin
  PairPotential contact;           // its attraction does not act while packing
  WallPotential wall;              // of a channel
  std::size_t cells = 0;
  Box box;  // periodic along x; between walls, or periodic along y
  int threads = 1;
};

/// Random positions without interpenetration, the same for the same seed and stream and any number
/// of threads.
///
/// Cells are inserted one after the other at random places and angles into a box enlarged so far
/// that they fill a quarter of it; the box is then compressed to its size in strokes. After each of
/// them contacts and membranes relax by a few long implicit steps of the block ensemble in single
/// precision, without flow. Every few strokes outlines are looked at: if some cross, packing goes
/// back to the last sound state and continues with strokes half as long.
///
/// Growing cells in a box of fixed size is the same motion in another unit of length, but would
/// need new membranes at every stroke.
///
/// @throws ParameterError for what cannot be packed: fraction wanted, fraction reached, remedies
EnsembleState pack_at_random(const RandomPacking& packing, std::uint64_t seed,
                             std::uint64_t stream);

}  // namespace hemoscale::micro
