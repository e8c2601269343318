#include "micro/ensemble/blocks/contact_list.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace hemoscale::micro::blocks {
namespace {

template <class Extent>
Extent moved(const Extent& e, double dx, double dy) {
  return {e.x0 + dx, e.x1 + dx, e.y0 + dy, e.y1 + dy};
}

template <class Extent>
bool are_near(const Extent& a, const Extent& b, double range) {
  return std::max(a.x0 - b.x1, b.x0 - a.x1) < range && std::max(a.y0 - b.y1, b.y0 - a.y1) < range;
}

/// Column and row of the image whose middle lies in the home box.
template <class Extent>
std::pair<std::int32_t, std::int32_t> home_image(const Extent& e, const Periodicity& p) {
  std::int32_t row = 0;
  std::int32_t column = 0;
  if (p.height > 0) {
    row = static_cast<std::int32_t>(-std::floor(0.5 * (e.y0 + e.y1) / p.height));
  }
  if (p.length > 0) {
    const double x = 0.5 * (e.x0 + e.x1) + row * p.image_offset;
    column = static_cast<std::int32_t>(-std::floor(x / p.length));
  }
  return {column, row};
}

/// Another cell seen from the frame of this one, its box grown by the range.
struct Grown {
  float x0, x1, y0, y1;    // [um]
  float shift_x, shift_y;  // [um] of its frame
  std::uint32_t first_cluster, clusters;
};

}  // namespace

template <class Real>
ContactSearch<Real>::ContactSearch(const BlockStore<Real>& store, std::size_t parity,
                                   const Periodicity& periodicity, double range)
    : store_(store), parity_(parity), periodicity_(periodicity), range_(range) {
  // The search reads whole groups.
  const std::size_t clusters = store.mirror[parity].size() / 8 + box_group;
  for (std::size_t k = 0; k < 4; ++k) {
    rows_[k].assign(clusters, (k % 2 == 0 ? 1.0F : -1.0F) * 1e30F);
  }
  relative_.resize(store.ids.size());
}

template <class Real>
void ContactSearch<Real>::measure(std::size_t first, std::size_t last) {
  const Real* const mirror = store_.mirror[parity_].data();
  for (std::size_t place = first; place < last; ++place) {
    if (store_.ids[place] == no_cell) continue;
    const auto kind = static_cast<std::size_t>(store_.kind_of_place[place]);
    const auto nodes = static_cast<std::size_t>(store_.kinds[kind].nodes);
    float x0 = 1e30F, x1 = -1e30F, y0 = 1e30F, y1 = -1e30F;
    for (std::size_t c = 0; c < store_.clusters_of_kind(kind); ++c) {
      const std::size_t k = store_.first_cluster[place] + c;
      // A last cluster that is not full repeats its first node here.
      float x[4], y[4];
      for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t own = 4 * c + i < nodes ? i : 0;
        x[i] = static_cast<float>(mirror[8 * k + own]);
        y[i] = static_cast<float>(mirror[8 * k + 4 + own]);
      }
      rows_[0][k] = std::min(std::min(x[0], x[1]), std::min(x[2], x[3]));
      rows_[1][k] = std::max(std::max(x[0], x[1]), std::max(x[2], x[3]));
      rows_[2][k] = std::min(std::min(y[0], y[1]), std::min(y[2], y[3]));
      rows_[3][k] = std::max(std::max(y[0], y[1]), std::max(y[2], y[3]));
      x0 = std::min(x0, rows_[0][k]);
      x1 = std::max(x1, rows_[1][k]);
      y0 = std::min(y0, rows_[2][k]);
      y1 = std::max(y1, rows_[3][k]);
    }
    relative_[place] = {x0, x1, y0, y1};
  }
}

template <class Real>
void ContactSearch<Real>::sort() {
  const std::vector<Vector<2>>& frames = store_.frames[parity_];
  for (std::size_t place = 0; place < store_.ids.size(); ++place) {
    if (store_.ids[place] == no_cell) continue;
    const Extent& e = relative_[place];
    largest_ = std::max({largest_, e.x1 - e.x0, e.y1 - e.y0});
  }
  appearances_.reserve(store_.ids.size() + store_.ids.size() / 4);
  for (std::size_t place = 0; place < store_.ids.size(); ++place) {
    if (store_.ids[place] == no_cell) continue;
    add_images(moved(relative_[place], frames[place].x(), frames[place].y()),
               static_cast<std::int32_t>(place));
  }
  bin_ = largest_ + range_;
  constexpr double least = std::numeric_limits<double>::lowest();
  constexpr double most = std::numeric_limits<double>::max();
  Extent all{most, least, most, least};
  for (const Appearance& a : appearances_) {
    all = {std::min(all.x0, a.extent.x0), std::max(all.x1, a.extent.x0),
           std::min(all.y0, a.extent.y0), std::max(all.y1, a.extent.y0)};
  }
  if (appearances_.empty()) return;
  origin_ = {all.x0, all.y0};
  columns_ = static_cast<std::int64_t>((all.x1 - all.x0) / bin_) + 1;
  bin_rows_ = static_cast<std::int64_t>((all.y1 - all.y0) / bin_) + 1;
  first_of_bin_.assign(static_cast<std::size_t>(columns_ * bin_rows_) + 1, 0);
  for (const Appearance& a : appearances_) ++first_of_bin_[bin_of(a.extent) + 1];
  for (std::size_t k = 1; k < first_of_bin_.size(); ++k) first_of_bin_[k] += first_of_bin_[k - 1];
  order_.resize(appearances_.size());
  std::vector<std::size_t> next(first_of_bin_.begin(), first_of_bin_.end() - 1);
  for (std::size_t k = 0; k < appearances_.size(); ++k) {
    order_[next[bin_of(appearances_[k].extent)]++] = k;
  }
}

/// The images of a cell that lie near the home box, itself among them. A cell whose middle lies in
/// the home box reaches out of it by less than its extent.
template <class Real>
void ContactSearch<Real>::add_images(const Extent& own, std::int32_t place) {
  const Periodicity& p = periodicity_;
  const double margin = largest_ + range_;
  const auto below =
      p.height > 0 ? static_cast<std::int32_t>(std::ceil((-margin - own.y1) / p.height)) : 0;
  const auto above =
      p.height > 0 ? static_cast<std::int32_t>(std::floor((p.height + margin - own.y0) / p.height))
                   : 0;
  for (std::int32_t row = below; row <= above; ++row) {
    const double dy = row * p.height;
    const double slide = row * p.image_offset;
    if (p.length <= 0) {
      appearances_.push_back({moved(own, slide, dy), place, 0, row});
      continue;
    }
    const auto first = static_cast<std::int32_t>(std::ceil((-margin - own.x1 - slide) / p.length));
    const auto last =
        static_cast<std::int32_t>(std::floor((p.length + margin - own.x0 - slide) / p.length));
    for (std::int32_t column = first; column <= last; ++column) {
      appearances_.push_back({moved(own, slide + column * p.length, dy), place, column, row});
    }
  }
}

template <class Real>
std::size_t ContactSearch<Real>::bin_of(const Extent& extent) const {
  const auto c = static_cast<std::int64_t>((extent.x0 - origin_.x()) / bin_);
  const auto r = static_cast<std::int64_t>((extent.y0 - origin_.y()) / bin_);
  return static_cast<std::size_t>(c * bin_rows_ + r);
}

/// The neighbours of a cell: appearances are binned by their lower left corners and smaller than a
/// bin.
template <class Real>
void ContactSearch<Real>::collect(std::size_t place, std::vector<CellNeighbour>& found) const {
  const Periodicity& p = periodicity_;
  const Vector<2>& frame = store_.frames[parity_][place];
  const Extent own = moved(relative_[place], frame.x(), frame.y());
  const auto [column, row] = home_image(own, p);
  const Extent home = moved(own, column * p.length + row * p.image_offset, row * p.height);
  const auto bin = [&](double v, std::int64_t n) {
    return std::clamp<std::int64_t>(static_cast<std::int64_t>(std::floor(v / bin_)), 0, n - 1);
  };
  const std::int64_t c0 = bin(home.x0 - range_ - largest_ - origin_.x(), columns_);
  const std::int64_t c1 = bin(home.x1 + range_ - origin_.x(), columns_);
  const std::int64_t r0 = bin(home.y0 - range_ - largest_ - origin_.y(), bin_rows_);
  const std::int64_t r1 = bin(home.y1 + range_ - origin_.y(), bin_rows_);
  found.clear();
  for (std::int64_t c = c0; c <= c1; ++c) {
    for (std::int64_t r = r0; r <= r1; ++r) {
      const auto b = static_cast<std::size_t>(c * bin_rows_ + r);
      for (std::size_t k = first_of_bin_[b]; k < first_of_bin_[b + 1]; ++k) {
        const Appearance& a = appearances_[order_[k]];
        const CellNeighbour other{a.place, a.column - column, a.row - row};
        const bool is_self =
            a.place == static_cast<std::int32_t>(place) && other.column == 0 && other.row == 0;
        if (!is_self && are_near(home, a.extent, range_)) found.push_back(other);
      }
    }
  }
  std::sort(found.begin(), found.end(), [&](const CellNeighbour& a, const CellNeighbour& b) {
    return std::tuple(store_.ids[static_cast<std::size_t>(a.place)], a.row, a.column) <
           std::tuple(store_.ids[static_cast<std::size_t>(b.place)], b.row, b.column);
  });
}

template <class Real>
ContactList ContactSearch<Real>::find(std::size_t first, std::size_t last) const {
  constexpr std::size_t width = BlockStore<Real>::width;
  const std::vector<Vector<2>>& frames = store_.frames[parity_];
  const auto reach = static_cast<float>(range_);
  const Kernels<Real>& table = kernels<Real>();
  ContactList list;
  list.first_block = first;
  list.first_neighbour.push_back(0);
  list.first_active.push_back(0);
  list.first_entry.push_back(0);
  std::vector<CellNeighbour> found;
  std::vector<Grown> others;
  std::size_t most = 0;
  for (std::size_t kind = 0; kind < store_.kinds.size(); ++kind) {
    most = std::max(most, store_.clusters_of_kind(kind));
  }
  std::vector<std::uint16_t> hits(most);
  for (std::size_t block = first; block < last; ++block) {
    const std::size_t first_of_block = list.neighbours.size();
    const std::size_t first_entry = list.entries.size();
    for (std::size_t place = block * width; place < (block + 1) * width; ++place) {
      if (store_.ids[place] == no_cell) {
        list.first_neighbour.push_back(list.neighbours.size());
        continue;
      }
      collect(place, found);
      const auto slot = static_cast<std::uint32_t>(list.neighbours.size() - first_of_block);
      list.neighbours.insert(list.neighbours.end(), found.begin(), found.end());
      list.first_neighbour.push_back(list.neighbours.size());
      others.clear();
      for (const CellNeighbour& other : found) {
        const auto there = static_cast<std::size_t>(other.place);
        const Vector<2> shift = shift_of(frames, place, other, periodicity_);
        const Extent e = moved(relative_[there], shift.x(), shift.y());
        others.push_back({static_cast<float>(e.x0) - reach, static_cast<float>(e.x1) + reach,
                          static_cast<float>(e.y0) - reach, static_cast<float>(e.y1) + reach,
                          static_cast<float>(shift.x()), static_cast<float>(shift.y()),
                          store_.first_cluster[there],
                          static_cast<std::uint32_t>(store_.clusters_of_kind(
                              static_cast<std::size_t>(store_.kind_of_place[there])))});
      }
      const std::size_t clusters =
          store_.clusters_of_kind(static_cast<std::size_t>(store_.kind_of_place[place]));
      const std::size_t first_own = store_.first_cluster[place];
      for (std::size_t c = 0; c < clusters; ++c) {
        const float x0 = rows_[0][first_own + c];
        const float x1 = rows_[1][first_own + c];
        const float y0 = rows_[2][first_own + c];
        const float y1 = rows_[3][first_own + c];
        const std::size_t before = list.entries.size();
        for (std::uint32_t k = 0; k < others.size(); ++k) {
          const Grown& o = others[k];
          // Most clusters face away from a neighbour.
          if (o.x0 > x1 || x0 > o.x1 || o.y0 > y1 || y0 > o.y1) continue;
          BoxArguments g;
          g.x0 = rows_[0].data() + o.first_cluster;
          g.x1 = rows_[1].data() + o.first_cluster;
          g.y0 = rows_[2].data() + o.first_cluster;
          g.y1 = rows_[3].data() + o.first_cluster;
          g.count = static_cast<int>(o.clusters);
          g.own_x0 = x0 - o.shift_x;
          g.own_x1 = x1 - o.shift_x;
          g.own_y0 = y0 - o.shift_y;
          g.own_y1 = y1 - o.shift_y;
          g.reach_squared = reach * reach;
          g.hits = hits.data();
          const int count = table.near_boxes(g);
          for (int j = 0; j < count; ++j) {
            list.entries.push_back({o.first_cluster + hits[static_cast<std::size_t>(j)], slot + k});
          }
        }
        if (list.entries.size() > before) {
          list.active.push_back({static_cast<std::uint16_t>(c),
                                 static_cast<std::uint16_t>(place % width),
                                 static_cast<std::uint32_t>(list.entries.size() - first_entry)});
        }
      }
    }
    list.first_active.push_back(list.active.size());
    list.first_entry.push_back(list.entries.size());
  }
  return list;
}

template <class Real>
ContactList find_contacts(const BlockStore<Real>& store, std::size_t parity,
                          const Periodicity& periodicity, double range) {
  ContactSearch<Real> search(store, parity, periodicity, range);
  search.measure(0, store.ids.size());
  search.sort();
  return search.find(0, store.blocks.size());
}

template class ContactSearch<float>;
template class ContactSearch<double>;
template ContactList find_contacts<float>(const BlockStore<float>&, std::size_t, const Periodicity&,
                                          double);
template ContactList find_contacts<double>(const BlockStore<double>&, std::size_t,
                                           const Periodicity&, double);

}  // namespace hemoscale::micro::blocks
