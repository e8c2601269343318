#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <tuple>
#include <vector>

#include "micro/ensemble/blocks/aligned_array.hpp"
#include "micro/ensemble/state.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro::blocks {

inline constexpr double micrometre = 1e-6;  // [m] unit of length of everything below

/// Cells of one kind: same number of nodes, same membrane.
struct CellKind {
  int nodes = 0;
  std::size_t cells = 0;
};

/// Number of a cell that does not change; numbers of different kinds follow each other.
using CellId = std::int32_t;
inline constexpr CellId no_cell = -1;

/// Cells in blocks of as many as a vector has lanes, all of one kind.
///
/// Every cell has a frame, a point in double precision near its centre, and the offsets of its
/// nodes from it: single precision resolves 5e-7 um there, in channels of any length. Place k of
/// the store is lane k % width of block k / width; places without a cell carry a resting shape that
/// nobody sees. Offsets are interleaved, entry node * width + lane of a block.
///
/// The mirror repeats the offsets of every cell one node after the other, in clusters of four, for
/// the search and forces of contacts. Mirror and frames exist twice: one step reads one and writes
/// the other, so that no cell waits for another within a step. Places beyond those of the blocks
/// are copies of cells that another rank owns; they have a mirror and a frame alone.
///
/// Bytes per node in single precision: 8 offsets, 16 mirrors, and 8 of integrators with a memory.
template <class Real>
struct BlockStore {
  static constexpr std::size_t width = 64 / sizeof(Real);

  struct Block {
    std::size_t kind = 0;
    std::size_t first_value = 0;  // of its offsets
  };

  std::vector<CellKind> kinds;
  std::vector<Block> blocks;
  AlignedArray<Real> x, y;                // [um] offsets from the frames
  AlignedArray<Real> memory_x, memory_y;  // [um] second state of the integrator, or empty
  bool memory_is_new = false;             // nothing has set it yet
  AlignedArray<Real> area;                // [um^2] per place
  std::vector<CellId> ids;                // per place
  std::vector<std::int32_t> kind_of_place;
  std::vector<std::uint32_t> first_cluster;      // per place, in the mirror
  std::array<AlignedArray<Real>, 2> mirror;      // [um] clusters of x0..x3, y0..y3
  std::array<std::vector<Vector<2>>, 2> frames;  // [um] per place
  std::vector<std::int32_t> place_of_id;         // -1: on another rank

  std::size_t places() const { return blocks.size() * width; }
  std::size_t nodes_of_block(std::size_t block) const {
    return static_cast<std::size_t>(kinds[blocks[block].kind].nodes);
  }
  std::size_t clusters_of_kind(std::size_t kind) const {
    return (static_cast<std::size_t>(kinds[kind].nodes) + 3) / 4;
  }
};

/// A cell outside the store, with everything that continues with the same bits.
struct CellRecord {
  CellId id = no_cell;
  std::int32_t kind = 0;
  Vector<2> frame = Vector<2>::Zero();  // [um]
  std::vector<double> x, y;             // [um] offsets, exact also for single precision
  std::vector<double> memory_x, memory_y;
  std::optional<double> area = std::nullopt;  // [um^2] as the kernels summed it; else summed anew
};

/// By what cells are ordered before they are put into blocks. Few of them: rows along the channel,
/// which the flow carries along together, so that the neighbours of a block remain few. Many:
/// along the channel, so that pieces of it are advanced while they are in the cache. Numbers decide
/// between equal places.
inline std::tuple<double, double, CellId> order_of_cell(const CellRecord& cell,
                                                        const Vector<2>& place, bool along) {
  constexpr double row = 4;  // [um] somewhat more than the thickness of a red cell
  return {along ? 0 : std::floor(place.y() / row), place.x(), cell.id};
}
/// Puts cells into blocks, kind after kind in the given order, and fills mirror and frames of the
/// buffer `parity`. `ids` counts all cells of the ensemble, on whichever rank.
template <class Real>
BlockStore<Real> make_store(const std::vector<CellKind>& kinds,
                            const std::vector<CellRecord>& cells, std::size_t ids, bool memory,
                            std::size_t parity);

/// The cell at a place.
template <class Real>
CellRecord read_cell(const BlockStore<Real>& store, std::size_t place, std::size_t parity);

/// Records of a state, with frames at the means of the nodes and numbers from first_id on.
/// @tparam Real  precision to which the offsets are rounded
template <class Real>
std::vector<CellRecord> to_records(const EnsembleState& state, std::int32_t kind, CellId first_id);

}  // namespace hemoscale::micro::blocks
