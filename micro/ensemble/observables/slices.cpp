#include "micro/ensemble/observables/slices.hpp"

#include <algorithm>
#include <cmath>

namespace hemoscale::micro {
namespace {

/// Integrals along the straight piece from a to b: of x dy, x^2/2 dy and x y dy.
void add_piece(const Vector<2>& a, const Vector<2>& b, Slice& slice) {
  const double rise = b.y() - a.y();
  slice.area += 0.5 * (a.x() + b.x()) * rise;
  slice.moment.x() += rise / 6 * (a.x() * a.x() + a.x() * b.x() + b.x() * b.x());
  slice.moment.y() += rise / 6 * (a.x() * (2 * a.y() + b.y()) + b.x() * (a.y() + 2 * b.y()));
}

}  // namespace

std::size_t LateralBins::bin_of(double y) const {
  const double last = static_cast<double>(count - 1);
  return static_cast<std::size_t>(std::clamp(std::floor(y / width()), 0.0, last));
}

void add_slices(const EnsembleState& state, std::size_t cell, const Vector<2>& origin,
                const LateralBins& bins, std::span<Slice> slices) {
  const std::size_t first = cell * state.nodes;
  const double width = bins.width();
  const auto node = [&](std::size_t k) {
    return Vector<2>(state.x[first + k] - origin.x(), state.y[first + k] - origin.y());
  };
  Vector<2> a = node(state.nodes - 1);
  std::size_t bin = bins.bin_of(a.y() + origin.y());
  for (std::size_t k = 0; k < state.nodes; ++k) {
    const Vector<2> b = node(k);
    const std::size_t last = bins.bin_of(b.y() + origin.y());
    Vector<2> from = a;
    while (bin != last) {
      // To the line between this bin and the next on the way.
      const bool rises = last > bin;
      const double line = width * static_cast<double>(rises ? bin + 1 : bin) - origin.y();
      const double share = (line - a.y()) / (b.y() - a.y());
      const Vector<2> to(a.x() + share * (b.x() - a.x()), line);
      add_piece(from, to, slices[bin]);
      from = to;
      bin = rises ? bin + 1 : bin - 1;
    }
    add_piece(from, b, slices[bin]);
    a = b;
  }
}

std::vector<double> area_fractions(const EnsembleState& state, double length,
                                   const LateralBins& bins) {
  std::vector<Slice> slices(bins.count);
  for (std::size_t cell = 0; cell < state.cells; ++cell) {
    // About a node of the cell: far from the origin the pieces would cancel.
    const Vector<2> origin(state.x[cell * state.nodes], state.y[cell * state.nodes]);
    add_slices(state, cell, origin, bins, slices);
  }
  std::vector<double> fractions;
  fractions.reserve(bins.count);
  for (const Slice& slice : slices) {
    fractions.push_back(slice.area / (length * bins.width()));
  }
  return fractions;
}

}  // namespace hemoscale::micro
