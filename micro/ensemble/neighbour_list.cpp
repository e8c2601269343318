#include "micro/ensemble/neighbour_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <exception>

#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

// Cells are moved back into the box long before they are this many boxes away.
constexpr double furthest_image = 100;

// Nodes whose partners one thread finds at a time.
constexpr std::size_t nodes_of_part = 4096;

[[noreturn]] void throw_torn(std::size_t node, const EnsembleState& state) {
  throw NumericalError(fmt::format(
      "step {}, time {:.6g} s: node {} of cell {} lies at ({:.4g}, {:.4g}) m, too many boxes away "
      "from a neighbour: cells keep to one box and its nearest images; the run is unstable: reduce "
      "the time step, or stiffen membrane and contact",
      state.step, state.time, node % state.nodes, node / state.nodes, state.x[node],
      state.y[node]));
}

int bin(double position, double extent, int bins) {
  const int i = static_cast<int>(position / extent * bins);
  return std::clamp(i, 0, bins - 1);
}

}  // namespace

void NeighbourList::place_nodes(const EnsembleState& state, const Box& box, double range) {
  const std::size_t total = state.x.size();
  // No more bins than nodes: a nearly empty box must not cost more than its nodes.
  const double finest = std::max(range, std::sqrt(box.area() / static_cast<double>(total)));
  columns_ = std::max(1, static_cast<int>(box.length / finest));
  rows_ = std::max(1, static_cast<int>(box.height / finest));
  const auto bins = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  placed_.resize(total);
  sorted_.resize(total);
  bin_of_.resize(total);
  bin_first_.assign(bins + 1, 0);
  for (std::size_t i = 0; i < total; ++i) {
    const double row = box.walls ? 0 : std::floor(state.y[i] / box.height);
    double x = state.x[i] - row * state.image_offset;
    const double column = std::floor(x / box.length);
    x -= column * box.length;
    const double y = state.y[i] - row * box.height;
    placed_[i] = {x, y, static_cast<std::int32_t>(i), static_cast<std::int32_t>(column),
                  static_cast<std::int32_t>(row)};
    bin_of_[i] =
        static_cast<std::size_t>(bin(y, box.height, rows_)) * static_cast<std::size_t>(columns_) +
        static_cast<std::size_t>(bin(x, box.length, columns_));
    ++bin_first_[bin_of_[i] + 1];
  }
  for (std::size_t b = 0; b < bins; ++b) {
    bin_first_[b + 1] += bin_first_[b];
  }
  std::vector<std::size_t> next(bin_first_.begin(), bin_first_.end() - 1);
  for (std::size_t i = 0; i < total; ++i) {
    sorted_[next[bin_of_[i]]++] = placed_[i];
  }
}

void NeighbourList::find_partners(std::size_t node, const EnsembleState& state, const Box& box,
                                  double range, std::vector<Neighbour>& found) const {
  const Placed& own = placed_[node];
  const std::size_t own_cell = node / state.nodes;
  const int own_row = bin(own.y, box.height, rows_);
  for (int step = -1; step <= 1; ++step) {
    int bin_row = own_row + step;
    int image_row = 0;
    if (bin_row < 0 || bin_row >= rows_) {
      if (box.walls) {
        continue;
      }
      image_row = bin_row < 0 ? -1 : 1;
      bin_row -= image_row * rows_;
    }
    // Seen from the box, the row of images lies at image_row * offset: look at the shifted
    // position.
    double x = own.x - image_row * state.image_offset;
    const double turn = std::floor(x / box.length);
    x -= turn * box.length;
    const int own_column = bin(x, box.length, columns_);
    for (int side = -1; side <= 1; ++side) {
      int bin_column = own_column + side;
      int image_column = static_cast<int>(turn);
      if (bin_column < 0) {
        bin_column += columns_;
        --image_column;
      } else if (bin_column >= columns_) {
        bin_column -= columns_;
        ++image_column;
      }
      const double shift_x = image_column * box.length + image_row * state.image_offset;
      const double shift_y = image_row * box.height;
      const auto b = static_cast<std::size_t>(bin_row) * static_cast<std::size_t>(columns_) +
                     static_cast<std::size_t>(bin_column);
      for (std::size_t k = bin_first_[b]; k < bin_first_[b + 1]; ++k) {
        const Placed& other = sorted_[k];
        const double dx = own.x - (other.x + shift_x);
        const double dy = own.y - (other.y + shift_y);
        if (dx * dx + dy * dy >= range * range) {
          continue;
        }
        const int column = image_column - other.column + own.column;
        const int row = image_row - other.row + own.row;
        const bool own_ring = static_cast<std::size_t>(other.node) / state.nodes == own_cell &&
                              column == 0 && row == 0;
        if (!own_ring) {
          if (!Image::is_known(column, row)) {
            throw_torn(node, state);
          }
          found.push_back({other.node, Image::pack(column, row)});
        }
      }
    }
  }
}

void NeighbourList::build(const EnsembleState& state, const Box& box, double range) {
  for (std::size_t i = 0; i < state.x.size(); ++i) {
    const bool is_near = std::abs(state.x[i]) <= furthest_image * box.length &&
                         std::abs(state.y[i]) <= furthest_image * box.height;
    if (!is_near) {
      throw_torn(i, state);
    }
  }
  place_nodes(state, box, range);
  const std::size_t total = state.x.size();
  const std::size_t parts = (total + nodes_of_part - 1) / nodes_of_part;
  first_.assign(total + 1, 0);
  found_.resize(std::max(found_.size(), parts));
  std::vector<std::exception_ptr> failures(parts);
#pragma omp parallel for schedule(dynamic)
  for (std::size_t part = 0; part < parts; ++part) {
    std::vector<Neighbour>& found = found_[part];
    found.clear();
    try {
      for (std::size_t i = part * nodes_of_part; i < std::min(total, (part + 1) * nodes_of_part);
           ++i) {
        const auto before = static_cast<std::ptrdiff_t>(found.size());
        find_partners(i, state, box, range, found);
        std::sort(found.begin() + before, found.end(),
                  [](const Neighbour& a, const Neighbour& b) { return a.node < b.node; });
        first_[i + 1] = found.size() - static_cast<std::size_t>(before);
      }
    } catch (...) {
      failures[part] = std::current_exception();
    }
  }
  entries_.clear();
  for (std::size_t part = 0; part < parts; ++part) {
    if (failures[part]) std::rethrow_exception(failures[part]);
    entries_.insert(entries_.end(), found_[part].begin(), found_[part].end());
  }
  for (std::size_t i = 0; i < total; ++i) first_[i + 1] += first_[i];
}

}  // namespace hemoscale::micro
