#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "micro/ensemble/blocks/aligned_array.hpp"
#include "micro/ensemble/blocks/block_store.hpp"
#include "micro/ensemble/blocks/kernel_arguments.hpp"

namespace hemoscale::micro::blocks {

/// Where cells have images.
struct Periodicity {
  double length = 0;        // [um] along x; 0: none
  double height = 0;        // [um] along y; 0: none
  double image_offset = 0;  // [um] displacement along x of the image above
};

/// Another cell, or an image of one, whose nodes may come into contact with those of a cell.
struct CellNeighbour {
  std::int32_t place = 0;
  std::int32_t column = 0;  // image displaced by column * length + row * offset along x
  std::int32_t row = 0;     // and row * height along y
};

/// Pairs of clusters of nodes that are nearer to each other than a range, box to box, by their
/// owners: every pair of cells appears with either of them. Clusters of one cell appear in order,
/// and the entries of a cluster by the number of the other cell, image and cluster, whatever the
/// order of cells in the store: sums do not depend on it.
///
/// A list covers the blocks from first_block on; tables per block count from there.
struct ContactList {
  std::size_t first_block = 0;
  std::vector<std::size_t> first_neighbour;  // per place and one more
  std::vector<CellNeighbour> neighbours;
  std::vector<std::size_t> first_active;  // per block and one more
  std::vector<ActiveCluster> active;      // `end` counts from first_entry of the block
  std::vector<std::size_t> first_entry;   // per block and one more
  AlignedArray<ClusterEntry> entries;     // `shift` counts from the first neighbour of the block
};

/// Search of contacts in three stages, of which the first and the last may be shared by threads:
/// boxes of the clusters of every place; bins of the cells and their images; lists of blocks.
template <class Real>
class ContactSearch {
 public:
  /// @param parity  buffer of mirror and frames that holds the present positions
  /// @param range   [um] contact cutoff and skin
  ContactSearch(const BlockStore<Real>& store, std::size_t parity, const Periodicity& periodicity,
                double range);

  /// First stage, for the places [first, last) of store.ids.
  void measure(std::size_t first, std::size_t last);

  /// Second stage, once all places are measured.
  void sort();

  /// Third stage, for the blocks [first, last).
  ContactList find(std::size_t first, std::size_t last) const;

  struct Extent {
    double x0, x1, y0, y1;  // [um]
  };

 private:
  struct Appearance {
    Extent extent;  // [um] in the channel
    std::int32_t place, column, row;
  };
  void add_images(const Extent& own, std::int32_t place);
  std::size_t bin_of(const Extent& extent) const;
  void collect(std::size_t place, std::vector<CellNeighbour>& found) const;

  const BlockStore<Real>& store_;
  std::size_t parity_;
  Periodicity periodicity_;
  double range_;                  // [um]
  std::vector<float> rows_[4];    // [um] x0, x1, y0, y1 of clusters, relative to the frames
  std::vector<Extent> relative_;  // [um] of cells, to their frames
  double largest_ = 1;            // [um] extent of any cell
  std::vector<Appearance> appearances_;
  Vector<2> origin_ = Vector<2>::Zero();  // [um] of the bins
  std::int64_t columns_ = 0, bin_rows_ = 0;
  double bin_ = 1;  // [um]
  std::vector<std::size_t> first_of_bin_, order_;
};

/// The list of all blocks, by one thread.
template <class Real>
ContactList find_contacts(const BlockStore<Real>& store, std::size_t parity,
                          const Periodicity& periodicity, double range);

/// Displacement of the frame of a neighbour from that of a cell at the given time [um].
inline Vector<2> shift_of(const std::vector<Vector<2>>& frames, std::size_t place,
                          const CellNeighbour& other, const Periodicity& periodicity) {
  const Vector<2>& mine = frames[place];
  const Vector<2>& theirs = frames[static_cast<std::size_t>(other.place)];
  return {(theirs.x() - mine.x()) +
              (other.column * periodicity.length + other.row * periodicity.image_offset),
          (theirs.y() - mine.y()) + other.row * periodicity.height};
}

}  // namespace hemoscale::micro::blocks
