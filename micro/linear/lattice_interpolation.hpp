#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "micro/linear/node_layout.hpp"

namespace hemoscale::micro {

/// Values of fine nodes from those of coarse ones, in compressed rows, and the same transposed.
struct Interpolation {
  std::vector<std::int32_t> first = {0};  // weights of fine node i: [first[i], first[i + 1])
  std::vector<std::int32_t> coarse;
  std::vector<float> weight;

  std::vector<std::int32_t> coarse_first = {0};  // weights of coarse node J
  std::vector<std::int32_t> fine;
  std::vector<float> coarse_weight;

  std::size_t fine_size() const { return first.size() - 1; }
  std::size_t coarse_size() const { return coarse_first.size() - 1; }
};

/// Coarse nodes on a lattice over the fine ones. Each stands for the overlapping aggregate of nodes
/// under its hat function, the product of max(0, 1 - |x - X|/h) over the axes: the hats sum to one
/// everywhere, so that constants and, inside, linear fields are interpolated exactly.
template <int dim>
struct CoarseLattice {
  std::vector<Vector<dim>> positions;  // [m] of the coarse nodes that some fine node uses
  double spacing = 0;                  // [m] about
  Vector<dim> period;                  // [m] of the nodes below
  double slide = 0;                    // [m] likewise
  Interpolation interpolation;

  NodeLayout<dim> layout() const { return {positions, spacing, period, slide}; }
};

/// Lays a lattice of about the given spacing over the nodes: between the outermost nodes of an open
/// axis, around a joined one (a sheared box included).
/// @param active  nodes that take part; the others are interpolated by zero
template <int dim>
CoarseLattice<dim> lay_lattice(const NodeLayout<dim>& fine, double spacing,
                               const std::vector<bool>& active);

}  // namespace hemoscale::micro
