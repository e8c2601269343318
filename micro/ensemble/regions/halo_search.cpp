#include "micro/ensemble/regions/halo_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "micro/ensemble/regions/cell_bytes.hpp"

namespace hemoscale::micro::regions {

using blocks::BlockStore;
using blocks::no_cell;
using blocks::Periodicity;

namespace {

struct Box {
  double x0 = std::numeric_limits<double>::max(), x1 = std::numeric_limits<double>::lowest();
  double y0 = std::numeric_limits<double>::max(), y1 = std::numeric_limits<double>::lowest();
  bool is_empty() const { return x1 < x0; }
};

/// The box of a cell, and where in the messages to a rank it is.
struct CellBox {
  blocks::CellId id = no_cell;
  std::int32_t kind = 0;
  Box box;
};

template <class Real>
Box box_of_cell(const BlockStore<Real>& store, std::size_t parity, std::size_t place) {
  const auto kind = static_cast<std::size_t>(store.kind_of_place[place]);
  const auto nodes = static_cast<std::size_t>(store.kinds[kind].nodes);
  const Real* mirror = store.mirror[parity].data() + 8 * std::size_t{store.first_cluster[place]};
  Real x0 = mirror[0];
  Real x1 = mirror[0];
  Real y0 = mirror[4];
  Real y1 = mirror[4];
  for (std::size_t first = 0; first < nodes; first += 4, mirror += 8) {
    for (std::size_t i = 0; i < std::min<std::size_t>(4, nodes - first); ++i) {
      x0 = std::min(x0, mirror[i]);
      x1 = std::max(x1, mirror[i]);
      y0 = std::min(y0, mirror[4 + i]);
      y1 = std::max(y1, mirror[4 + i]);
    }
  }
  const Vector<2>& frame = store.frames[parity][place];
  return {frame.x() + static_cast<double>(x0), frame.x() + static_cast<double>(x1),
          frame.y() + static_cast<double>(y0), frame.y() + static_cast<double>(y1)};
}

/// The image of a box whose middle is nearest to a point.
Box image_near(Box box, const Vector<2>& middle, const Periodicity& p) {
  if (p.height > 0) {
    const double row = std::round((middle.y() - 0.5 * (box.y0 + box.y1)) / p.height);
    box.y0 += row * p.height;
    box.y1 += row * p.height;
    box.x0 += row * p.image_offset;
    box.x1 += row * p.image_offset;
  }
  if (p.length > 0) {
    const double column = std::round((middle.x() - 0.5 * (box.x0 + box.x1)) / p.length);
    box.x0 += column * p.length;
    box.x1 += column * p.length;
  }
  return box;
}

/// Whether any image of b is near a. Numbers depend on the order of a and b: both ranks give the
/// one of the lower rank first.
bool are_near(const Box& a, const Box& b, double range, const Periodicity& p) {
  const double middle_y = 0.5 * (a.y0 + a.y1) - 0.5 * (b.y0 + b.y1);
  const double middle_x = 0.5 * (a.x0 + a.x1) - 0.5 * (b.x0 + b.x1);
  // Images that lie within the extent of either: more than one on each side in short periods.
  const auto images = [range](double middle, double extent, double period) {
    if (period <= 0) return std::pair(0.0, 0.0);
    const double reach = 0.5 * extent + range;
    return std::pair(std::ceil((middle - reach) / period), std::floor((middle + reach) / period));
  };
  const auto [row0, row1] = images(middle_y, (a.y1 - a.y0) + (b.y1 - b.y0), p.height);
  for (double row = row0; row <= row1; ++row) {
    const double dy = row * p.height;
    if (std::max(a.y0 - (b.y1 + dy), (b.y0 + dy) - a.y1) >= range) continue;
    const double slide = row * p.image_offset;
    const auto [column0, column1] =
        images(middle_x - slide, (a.x1 - a.x0) + (b.x1 - b.x0), p.length);
    for (double column = column0; column <= column1; ++column) {
      const double dx = column * p.length + slide;
      if (std::max(a.x0 - (b.x1 + dx), (b.x0 + dx) - a.x1) < range) return true;
    }
  }
  return false;
}

/// Boxes of the ranks, in the order of the ranks.
std::vector<Box> boxes_of_ranks(const Box& own, const RankMessages& messages) {
  const std::vector<double> all = messages.gather({own.x0, own.x1, own.y0, own.y1});
  std::vector<Box> boxes;
  for (std::size_t k = 0; k < all.size(); k += 4) {
    boxes.push_back({all[k], all[k + 1], all[k + 2], all[k + 3]});
  }
  return boxes;
}

std::vector<CellBox> read_boxes(const std::string& bytes) {
  std::vector<CellBox> boxes;
  for (ByteReader reader(bytes); !reader.at_end();) boxes.push_back(reader.read<CellBox>());
  return boxes;
}

}  // namespace

template <class Real>
std::vector<Neighbourhood> find_neighbourhoods(const BlockStore<Real>& store, std::size_t parity,
                                               const Periodicity& periodicity, double range,
                                               const Vector<2>& middle,
                                               const RankMessages& messages) {
  std::vector<Box> boxes(store.places());
  Box own;
  for (std::size_t place = 0; place < store.places(); ++place) {
    if (store.ids[place] == no_cell) continue;
    const Box b = image_near(box_of_cell(store, parity, place), middle, periodicity);
    own = {std::min(own.x0, b.x0), std::max(own.x1, b.x1), std::min(own.y0, b.y0),
           std::max(own.y1, b.y1)};
    boxes[place] = b;
  }
  const std::vector<Box> ranks = boxes_of_ranks(own, messages);
  const int rank = messages.rank();
  const auto near_rank = [&](const Box& mine, const Box& theirs, int other) {
    return rank < other ? are_near(mine, theirs, range, periodicity)
                        : are_near(theirs, mine, range, periodicity);
  };
  std::vector<Message> outgoing;
  std::vector<std::vector<std::size_t>> candidates;
  for (int other = 0; other < messages.size(); ++other) {
    const Box& theirs = ranks[static_cast<std::size_t>(other)];
    if (other == rank || own.is_empty() || theirs.is_empty()) continue;
    if (!near_rank(own, theirs, other)) continue;
    outgoing.push_back({other, {}});
    candidates.emplace_back();
    for (std::size_t place = 0; place < store.places(); ++place) {
      if (store.ids[place] == no_cell || !near_rank(boxes[place], theirs, other)) continue;
      candidates.back().push_back(place);
      append(outgoing.back().bytes,
             CellBox{store.ids[place], store.kind_of_place[place], boxes[place]});
    }
  }
  const std::vector<Message> incoming = messages.exchange_with(outgoing);
  std::vector<Neighbourhood> result;
  for (std::size_t k = 0; k < incoming.size(); ++k) {
    const std::vector<CellBox> theirs = read_boxes(incoming[k].bytes);
    std::vector<unsigned char> is_received(theirs.size(), 0);
    Neighbourhood found;
    found.rank = incoming[k].rank;
    for (const std::size_t place : candidates[k]) {
      bool is_sent = false;
      for (std::size_t j = 0; j < theirs.size(); ++j) {
        if (near_rank(boxes[place], theirs[j].box, found.rank)) {
          is_sent = true;
          is_received[j] = 1;
        }
      }
      if (is_sent) found.sent.push_back(place);
    }
    for (std::size_t j = 0; j < theirs.size(); ++j) {
      if (is_received[j] == 0) continue;
      found.received.push_back(theirs[j].id);
      found.received_kinds.push_back(theirs[j].kind);
    }
    if (!found.sent.empty()) result.push_back(std::move(found));
  }
  return result;
}

template std::vector<Neighbourhood> find_neighbourhoods<float>(const BlockStore<float>&,
                                                               std::size_t, const Periodicity&,
                                                               double, const Vector<2>&,
                                                               const RankMessages&);
template std::vector<Neighbourhood> find_neighbourhoods<double>(const BlockStore<double>&,
                                                                std::size_t, const Periodicity&,
                                                                double, const Vector<2>&,
                                                                const RankMessages&);

}  // namespace hemoscale::micro::regions
