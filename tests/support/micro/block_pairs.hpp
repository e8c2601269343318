#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <set>
#include <tuple>
#include <vector>

#include "micro/ensemble/blocks/block_store.hpp"
#include "micro/ensemble/blocks/contact_list.hpp"
#include "micro/ensemble/pair_potential.hpp"
#include "tests/support/micro/blocks.hpp"

// Contacts of the cells of a store: by the list and the kernel, and by plain loops over everything.
namespace hemoscale::test {

using blocks::BlockStore;
using blocks::ContactList;
using blocks::Periodicity;
using micro::Vector;

/// Cells at random places of a box, at random angles; they may lie over each other. The numbers of
/// the cells are those of `records`, places are dealt in their order.
struct RandomCells {
  double width = 20, height = 20;  // [um] of the box
  std::uint64_t seed = 1;
  double turn = 6.2832;  // [rad] largest angle of the long axis
};

inline std::vector<blocks::CellRecord> random_cells(const std::vector<blocks::CellKind>& kinds,
                                                    const RandomCells& box) {
  std::vector<blocks::CellRecord> records;
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    for (std::size_t c = 0; c < kinds[kind].cells; ++c) {
      const auto draw = [&](std::uint64_t counter) {
        return micro::uniform({box.seed, 100 + kind, 10 * c + counter});
      };
      blocks::CellRecord cell;
      cell.id = static_cast<blocks::CellId>(records.size());
      cell.kind = static_cast<std::int32_t>(kind);
      cell.frame = {box.width * draw(0), box.height * draw(1)};
      const double angle = box.turn * draw(2);
      for (const Vector<2>& p :
           dented_polygon(kinds[kind].nodes, box.seed + 1000 * kind + c, 0.2, 0.02)) {
        const Vector<2> q(1.2 * p.x() / um, 0.5 * p.y() / um);
        cell.x.push_back(std::cos(angle) * q.x() - std::sin(angle) * q.y());
        cell.y.push_back(std::sin(angle) * q.x() + std::cos(angle) * q.y());
      }
      records.push_back(cell);
    }
  }
  return records;
}

/// Places by which plain loops are exact to the last bit of the positions in double precision.
using ExactPlace = Eigen::Matrix<long double, 2, 1>;

/// A node of a store: its place in it, its number in the cell, where it is.
struct StoreNode {
  std::size_t place = 0, node = 0;
  ExactPlace x = ExactPlace::Zero();  // [um]
};

/// As contacts see them: in the mirror.
template <class Real>
std::vector<StoreNode> nodes_of(const BlockStore<Real>& store, std::size_t parity) {
  std::vector<StoreNode> nodes;
  for (std::size_t place = 0; place < store.places(); ++place) {
    if (store.ids[place] == blocks::no_cell) continue;
    const Real* const mirror = store.mirror[parity].data() + 8 * store.first_cluster[place];
    for (std::size_t i = 0; i < store.nodes_of_block(place / store.width); ++i) {
      const ExactPlace offset(mirror[8 * (i / 4) + i % 4], mirror[8 * (i / 4) + 4 + i % 4]);
      nodes.push_back(
          {place, i, store.frames[parity][place].template cast<long double>() + offset});
    }
  }
  return nodes;
}

/// Visits all pairs of nodes of different cells, or of different images of one, nearer than
/// `range`: visit(a, b, d, column, row) with d from the image of b to a, either way round.
template <class Visit>
void visit_pairs(const std::vector<StoreNode>& nodes, const Periodicity& p, double range,
                 const Visit& visit) {
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    for (std::size_t b = 0; b < nodes.size(); ++b) {
      const ExactPlace apart = nodes[a].x - nodes[b].x;
      const auto along = [&](long double value, long double period, const auto& each) {
        if (period <= 0) {
          if (std::abs(value) < range) each(0);
          return;
        }
        const long double first = std::ceil((value - range) / period);
        for (long double k = first; k * period < value + range; ++k) each(static_cast<int>(k));
      };
      along(apart.y(), p.height, [&](int row) {
        along(apart.x() - row * p.image_offset, p.length, [&](int column) {
          if (nodes[a].place == nodes[b].place && row == 0 && column == 0) return;
          const ExactPlace image(column * static_cast<long double>(p.length) +
                                     row * static_cast<long double>(p.image_offset),
                                 row * static_cast<long double>(p.height));
          const Vector<2> d = (apart - image).cast<double>();
          if (d.norm() < range) visit(a, b, d, column, row);
        });
      });
    }
  }
}

/// Pairs of nodes in the range that the list does not hold: none if it is complete. Counts the
/// pairs in the range besides.
template <class Real>
std::size_t missing_pairs(const BlockStore<Real>& store, std::size_t parity, const Periodicity& p,
                          double range, const std::vector<ContactList>& lists,
                          std::size_t* pairs = nullptr) {
  // place, cluster, cluster of the mirror, column, row
  std::set<std::tuple<std::size_t, std::size_t, std::size_t, int, int>> held;
  for (const ContactList& list : lists) {
    for (std::size_t b = 0; b + 1 < list.first_active.size(); ++b) {
      const std::size_t first_place = (list.first_block + b) * BlockStore<Real>::width;
      const std::size_t first_neighbour = list.first_neighbour[b * BlockStore<Real>::width];
      std::size_t entry = list.first_entry[b];
      for (std::size_t k = list.first_active[b]; k < list.first_active[b + 1]; ++k) {
        const auto& active = list.active[k];
        for (; entry < list.first_entry[b] + active.end; ++entry) {
          const auto& other = list.neighbours[first_neighbour + list.entries[entry].shift];
          held.insert({first_place + active.lane, active.cluster, list.entries[entry].other,
                       other.column, other.row});
        }
      }
    }
  }
  const std::vector<StoreNode> nodes = nodes_of(store, parity);
  std::size_t missing = 0;
  std::size_t count = 0;
  visit_pairs(nodes, p, range,
              [&](std::size_t a, std::size_t b, const Vector<2>&, int column, int row) {
                ++count;
                const std::size_t other = store.first_cluster[nodes[b].place] + nodes[b].node / 4;
                missing += held.count({nodes[a].place, nodes[a].node / 4, other, column, row}) == 0;
              });
  if (pairs != nullptr) *pairs = count;
  return missing;
}

/// Forces of contacts on the nodes in the order of nodes_of: vectors and stiffness xx, xy, yy.
struct ContactForces {
  std::vector<Vector<2>> force;      // [um] times tau
  std::vector<Vector<2>> diagonal;   // [-] xx, yy
  std::vector<double> off_diagonal;  // [-] xy
};

/// By the kernel and a list.
template <class Real>
ContactForces kernel_contacts(const Kernels<Real>& version, const BlockStore<Real>& store,
                              std::size_t parity, const Periodicity& p, const ContactList& list,
                              const blocks::PolynomialPair<Real>& law, bool stiff = true) {
  constexpr std::size_t width = BlockStore<Real>::width;
  ContactForces result;
  for (std::size_t block = 0; block < store.blocks.size(); ++block) {
    const std::size_t n = store.nodes_of_block(block);
    std::vector<AlignedArray<Real>> sums(5, AlignedArray<Real>(n * width, 0));
    std::vector<Real> shifts;
    for (std::size_t place = block * width; place < (block + 1) * width; ++place) {
      for (std::size_t k = list.first_neighbour[place]; k < list.first_neighbour[place + 1]; ++k) {
        const Vector<2> shift =
            blocks::shift_of(store.frames[parity], place, list.neighbours[k], p);
        shifts.push_back(static_cast<Real>(shift.x()));
        shifts.push_back(static_cast<Real>(shift.y()));
      }
    }
    blocks::PairArguments<Real> g;
    g.law = law;
    g.mirror = store.mirror[parity].data();
    g.active = list.active.data() + list.first_active[block];
    g.active_count =
        static_cast<std::uint32_t>(list.first_active[block + 1] - list.first_active[block]);
    g.entries = list.entries.data() + list.first_entry[block];
    g.shifts = shifts.data();
    g.first_cluster = store.first_cluster.data() + block * width;
    g.nodes = static_cast<int>(n);
    g.force_x = sums[0].data();
    g.force_y = sums[1].data();
    g.stiffness_xx = sums[2].data();
    g.stiffness_xy = sums[3].data();
    g.stiffness_yy = sums[4].data();
    (stiff ? version.stiff_pairs : version.pairs)[blocks::polynomial_form](g);
    for (std::size_t lane = 0; lane < width; ++lane) {
      if (store.ids[block * width + lane] == blocks::no_cell) continue;
      for (std::size_t i = 0; i < n; ++i) {
        const auto at = [&](std::size_t k) {
          return static_cast<double>(sums[k][i * width + lane]);
        };
        result.force.emplace_back(at(0), at(1));
        result.diagonal.emplace_back(at(2), at(4));
        result.off_diagonal.push_back(at(3));
      }
    }
  }
  return result;
}

/// By a plain loop over all pairs of nodes, with the potential in micrometres.
inline ContactForces plain_contacts(const std::vector<StoreNode>& nodes, const Periodicity& p,
                                    const micro::PairPotential& law) {
  ContactForces result;
  result.force.assign(nodes.size(), Vector<2>::Zero());
  result.diagonal.assign(nodes.size(), Vector<2>::Zero());
  result.off_diagonal.assign(nodes.size(), 0);
  visit_pairs(nodes, p, std::sqrt(law.cutoff_squared),
              [&](std::size_t a, std::size_t, const Vector<2>& d, int, int) {
                const double s = d.squaredNorm();
                result.force[a] += law.force_over_distance(s) * d;
                const double w = law.cutoff_squared - s;
                const double b = law.rest_squared - s;
                const double k = 2 * law.scale * (b > 0 ? 1 : law.attraction) * w * (2 * b + w);
                if (k > 0) {
                  result.diagonal[a] += k * d.cwiseProduct(d);
                  result.off_diagonal[a] += k * d.x() * d.y();
                }
              });
  return result;
}

/// A potential in micrometres for the kernels.
template <class Real>
blocks::PolynomialPair<Real> kernel_pair(const micro::PairPotential& p) {
  return {static_cast<Real>(p.scale), static_cast<Real>(p.rest_squared),
          static_cast<Real>(p.cutoff_squared), static_cast<Real>(p.attraction)};
}

}  // namespace hemoscale::test
