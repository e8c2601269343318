#include "micro/linear/lattice_interpolation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace hemoscale::micro {
namespace {

// A node this near to a line of the lattice [spacings] counts as on it: hats that a node touches
// with their edge alone would make rows of next to nothing.
constexpr double snap = 0.05;

// Shares are rounded to this part of the spacing: products of three are then exact in single
// precision, and the hats sum to one exactly, so that constants stay a null space on every lattice.
constexpr double steps = 256;

// The lattice: where it lies and how it is numbered.
template <int dim>
struct Lattice {
  Vector<dim> origin;                // [m]
  Vector<dim> spacing;               // [m]
  std::array<std::int32_t, 3> size;  // [-] lattice nodes along each axis
  Vector<dim> period;                // [m] 0 of an open axis
  double slide;                      // [m]

  std::size_t nodes() const {
    std::size_t product = 1;
    for (int a = 0; a < dim; ++a) {
      product *= static_cast<std::size_t>(size[static_cast<std::size_t>(a)]);
    }
    return product;
  }
};

template <int dim>
Lattice<dim> cover(const NodeLayout<dim>& fine, double spacing) {
  Lattice<dim> lattice{
      fine.positions.front(), Vector<dim>::Constant(spacing), {}, fine.period, fine.slide};
  Vector<dim> upper = lattice.origin;
  for (const Vector<dim>& x : fine.positions) {
    lattice.origin = lattice.origin.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }
  for (int a = 0; a < dim; ++a) {
    const bool joined = fine.period[a] > 0;
    const double extent = joined ? fine.period[a] : upper[a] - lattice.origin[a];
    const double cells = std::max(extent > 0 || joined ? 1.0 : 0.0, std::round(extent / spacing));
    lattice.spacing[a] = cells > 0 ? extent / cells : spacing;
    lattice.size[static_cast<std::size_t>(a)] = static_cast<std::int32_t>(cells) + (joined ? 0 : 1);
  }
  return lattice;
}

// The two lattice nodes beside a coordinate, and the weight of the second.
struct Between {
  std::array<std::int32_t, 2> node;
  double share;
  std::array<bool, 2> is_image;  // lies above the upper of the joined faces
};

Between between(double x, double spacing, std::int32_t size, bool joined) {
  const double place = x / spacing;
  double cell = std::floor(place);
  double share = std::round((place - cell) * steps) / steps;
  if (share > 1 - snap) {
    cell += 1;
    share = 0;
  } else if (share < snap) {
    share = 0;
  }
  auto low = static_cast<std::int32_t>(cell);
  if (joined) {
    return {{low % size, (low + 1) % size}, share, {low >= size, low + 1 >= size}};
  }
  low = std::clamp(low, 0, size - 1);
  return {{low, std::min(low + 1, size - 1)}, share, {false, false}};
}

double wrapped(double x, double period) {
  return x - period * std::floor(x / period);
}

struct Weight {
  std::size_t node;  // of the lattice
  double weight;
};

// Hats at one position, weights of one lattice node added up; returns their number.
template <int dim>
std::size_t hats(const Lattice<dim>& lattice, Vector<dim> x, std::array<Weight, 8>& list) {
  x -= lattice.origin;
  std::array<Between, 3> beside = {};
  // From the last axis to the first, because crossing the second shifts along the first.
  for (int a = dim - 1; a > 0; --a) {
    const auto axis = static_cast<std::size_t>(a);
    const double period = lattice.period[a];
    if (period > 0) {
      const double turns = std::floor(x[a] / period);
      x[a] -= turns * period;
      if (a == 1) {
        x[0] -= turns * lattice.slide;
      }
    }
    beside[axis] = between(x[a], lattice.spacing[a], lattice.size[axis], period > 0);
  }
  std::size_t count = 0;
  for (unsigned corner = 0; corner < (1U << dim); ++corner) {
    double weight = 1;
    double along = x[0];
    std::size_t rest = 0;
    for (int a = 1; a < dim; ++a) {
      const Between& b = beside[static_cast<std::size_t>(a)];
      const bool second = ((corner >> a) & 1U) != 0;
      weight *= second ? b.share : 1 - b.share;
      rest = rest * static_cast<std::size_t>(lattice.size[static_cast<std::size_t>(a)]) +
             static_cast<std::size_t>(b.node[second ? 1 : 0]);
      if (a == 1 && b.is_image[second ? 1 : 0]) {
        along -= lattice.slide;
      }
    }
    if (lattice.period[0] > 0) {
      along = wrapped(along, lattice.period[0]);
    }
    const Between b = between(along, lattice.spacing[0], lattice.size[0], lattice.period[0] > 0);
    const bool second = (corner & 1U) != 0;
    weight *= second ? b.share : 1 - b.share;
    std::size_t node = static_cast<std::size_t>(b.node[second ? 1 : 0]);
    for (int a = 1; a < dim; ++a) {
      node *= static_cast<std::size_t>(lattice.size[static_cast<std::size_t>(a)]);
    }
    node += rest;
    if (weight == 0) continue;
    const auto end = list.begin() + static_cast<std::ptrdiff_t>(count);
    const auto same =
        std::find_if(list.begin(), end, [&](const Weight& w) { return w.node == node; });
    if (same != end) {
      same->weight += weight;
    } else {
      list[count++] = {node, weight};
    }
  }
  return count;
}

void transpose(Interpolation& p, std::size_t coarse_nodes) {
  p.coarse_first.assign(coarse_nodes + 1, 0);
  for (const std::int32_t coarse : p.coarse) {
    ++p.coarse_first[static_cast<std::size_t>(coarse) + 1];
  }
  for (std::size_t j = 0; j < coarse_nodes; ++j) {
    p.coarse_first[j + 1] += p.coarse_first[j];
  }
  std::vector<std::int32_t> next(p.coarse_first.begin(), p.coarse_first.end() - 1);
  p.fine.resize(p.coarse.size());
  p.coarse_weight.resize(p.coarse.size());
  for (std::size_t i = 0; i + 1 < p.first.size(); ++i) {
    for (auto k = static_cast<std::size_t>(p.first[i]);
         k < static_cast<std::size_t>(p.first[i + 1]); ++k) {
      const auto to = static_cast<std::size_t>(next[static_cast<std::size_t>(p.coarse[k])]++);
      p.fine[to] = static_cast<std::int32_t>(i);
      p.coarse_weight[to] = p.weight[k];
    }
  }
}

}  // namespace

template <int dim>
CoarseLattice<dim> lay_lattice(const NodeLayout<dim>& fine, double spacing,
                               const std::vector<bool>& active) {
  const Lattice<dim> lattice = cover(fine, spacing);
  CoarseLattice<dim> coarse;
  Interpolation& p = coarse.interpolation;
  p.first.reserve(fine.positions.size() + 1);
  p.coarse.reserve(fine.positions.size() << dim);
  p.weight.reserve(fine.positions.size() << dim);
  std::vector<std::int32_t> number(lattice.nodes(), -1);
  std::array<Weight, 8> list = {};
  for (std::size_t i = 0; i < fine.positions.size(); ++i) {
    const std::size_t count = active[i] ? hats(lattice, fine.positions[i], list) : 0;
    for (std::size_t k = 0; k < count; ++k) {
      number[list[k].node] = 0;
      p.coarse.push_back(static_cast<std::int32_t>(list[k].node));
      p.weight.push_back(static_cast<float>(list[k].weight));
    }
    p.first.push_back(static_cast<std::int32_t>(p.coarse.size()));
  }
  for (std::size_t node = 0; node < number.size(); ++node) {
    if (number[node] < 0) continue;
    number[node] = static_cast<std::int32_t>(coarse.positions.size());
    Vector<dim> position = lattice.origin;
    std::size_t rest = node;
    for (int a = dim - 1; a >= 0; --a) {
      const auto size = static_cast<std::size_t>(lattice.size[static_cast<std::size_t>(a)]);
      position[a] += static_cast<double>(rest % size) * lattice.spacing[a];
      rest /= size;
    }
    coarse.positions.push_back(position);
  }
  for (std::int32_t& node : p.coarse) {
    node = number[static_cast<std::size_t>(node)];
  }
  transpose(p, coarse.positions.size());
  coarse.spacing = spacing;
  coarse.period = fine.period;
  coarse.slide = fine.slide;
  return coarse;
}

template CoarseLattice<2> lay_lattice(const NodeLayout<2>&, double, const std::vector<bool>&);
template CoarseLattice<3> lay_lattice(const NodeLayout<3>&, double, const std::vector<bool>&);

}  // namespace hemoscale::micro
