#include "micro/ensemble/packing.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "micro/ensemble/interpenetration.hpp"
#include "micro/ensemble/stepper.hpp"
#include "micro/error.hpp"
#include "micro/random/philox.hpp"

namespace hemoscale::micro {
namespace {

constexpr int attempts = 4;
constexpr int steps_per_compression = 20;

/// Numbers in the order in which they are asked for; every attempt has its own range of counters.
class Numbers {
 public:
  Numbers(std::uint64_t seed, std::uint64_t stream, int attempt)
      : draw_{seed, stream, static_cast<std::uint64_t>(attempt) << 32U} {}
  double between(double low, double high) {
    const double u = uniform(draw_);
    ++draw_.counter;
    return low + (high - low) * u;
  }

 private:
  Draw draw_;
};

void place(const std::vector<Vector<2>>& outline, const Vector<2>& centre, double angle,
           EnsembleState& state) {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  for (const Vector<2>& node : outline) {
    state.x.push_back(centre.x() + c * node.x() - s * node.y());
    state.y.push_back(centre.y() + s * node.x() + c * node.y());
  }
}

EnsembleState empty_state(std::size_t cells, std::size_t nodes) {
  EnsembleState state;
  state.cells = cells;
  state.nodes = nodes;
  state.x.reserve(cells * nodes);
  state.y.reserve(cells * nodes);
  return state;
}

/// Random order of the first n numbers.
std::vector<std::size_t> shuffled(std::size_t n, Numbers& numbers) {
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t i = n; i > 1; --i) {
    const auto j = static_cast<std::size_t>(numbers.between(0, static_cast<double>(i)));
    std::swap(order[i - 1], order[std::min(j, i - 1)]);
  }
  return order;
}

/// Lattice of at least `cells` sites that needs the least dilation of the box.
struct Lattice {
  std::size_t columns = 1;
  std::size_t rows = 1;
  double dilation = 1;  // [-] of length and height, at least 1
};

Lattice choose_lattice(std::size_t cells, const Box& box, double spacing) {
  Lattice best;
  best.dilation = 0;
  for (std::size_t columns = 1; columns <= cells; ++columns) {
    const std::size_t rows = (cells + columns - 1) / columns;
    const double dilation = std::max({1.0, static_cast<double>(columns) * spacing / box.length,
                                      static_cast<double>(rows) * spacing / box.height});
    if (best.dilation == 0 || dilation < best.dilation) {
      best = {columns, rows, dilation};
    }
  }
  return best;
}

Box dilated(const Box& box, double factor) {
  return {.length = box.length * factor, .height = box.height * factor, .walls = box.walls};
}

/// Moves every cell, without deforming it, as if its centre were glued to the box.
void move_centres(EnsembleState& state, double factor) {
  for (std::size_t cell = 0; cell < state.cells; ++cell) {
    Vector<2> centre = Vector<2>::Zero();
    for (std::size_t i = cell * state.nodes; i < (cell + 1) * state.nodes; ++i) {
      centre += Vector<2>(state.x[i], state.y[i]);
    }
    centre *= (factor - 1) / static_cast<double>(state.nodes);
    for (std::size_t i = cell * state.nodes; i < (cell + 1) * state.nodes; ++i) {
      state.x[i] += centre.x();
      state.y[i] += centre.y();
    }
  }
}

EnsembleState pack_once(const EnsembleSystem& system, const std::vector<Vector<2>>& outline,
                        std::size_t cells, const Box& box, Numbers numbers, int speed_divisor) {
  double radius = 0;
  for (const Vector<2>& node : outline) {
    radius = std::max(radius, node.norm());
  }
  const double gap = std::sqrt(system.contact.cutoff_squared);
  const double spacing = 1.05 * (2 * radius + gap);
  const Lattice lattice = choose_lattice(cells, box, spacing);
  const Box wide = dilated(box, lattice.dilation);
  const double site_x = wide.length / static_cast<double>(lattice.columns);
  const double site_y = wide.height / static_cast<double>(lattice.rows);
  const std::vector<std::size_t> sites = shuffled(lattice.columns * lattice.rows, numbers);
  EnsembleState state = empty_state(cells, outline.size());
  for (std::size_t cell = 0; cell < cells; ++cell) {
    const double play_x = 0.5 * (site_x - 2 * radius - gap);
    const double play_y = 0.5 * (site_y - 2 * radius - gap);
    const auto column = static_cast<double>(sites[cell] % lattice.columns);
    const auto row = static_cast<double>(sites[cell] / lattice.columns);
    const Vector<2> centre((column + 0.5) * site_x + numbers.between(-play_x, play_x),
                           (row + 0.5) * site_y + numbers.between(-play_y, play_y));
    place(outline, centre, numbers.between(0, 2 * std::numbers::pi), state);
  }
  // Time for a pushed cell to move by the compression of its site, in units in which contacts
  // relax.
  const int compressions = lattice.dilation > 1 ? 400 * speed_divisor : 0;
  // Without compression the cells have not touched.
  const int settling = compressions > 0 ? 4000 * speed_divisor : 0;
  Stepper stepper(system);
  const Flow rest = SimpleShear{0};
  for (int k = 1; k <= compressions; ++k) {
    const double before = std::pow(lattice.dilation, 1 - static_cast<double>(k - 1) / compressions);
    const double after = std::pow(lattice.dilation, 1 - static_cast<double>(k) / compressions);
    move_centres(state, after / before);
    stepper.invalidate();
    const Box present = dilated(box, after);
    for (int i = 0; i < steps_per_compression; ++i) {
      stepper.step(state, present, rest);
    }
  }
  stepper.invalidate();
  for (int i = 0; i < settling; ++i) {
    stepper.step(state, box, rest);
  }
  state.time = 0;
  state.strain = 0;
  state.step = 0;
  return state;
}

}  // namespace

EnsembleState pack_cells(const EnsembleSystem& system, const std::vector<Vector<2>>& outline,
                         std::size_t cells, const Box& box, std::uint64_t seed,
                         std::uint64_t stream) {
  if (system.contact.scale == 0) {
    Numbers numbers(seed, stream, 0);
    EnsembleState state = empty_state(cells, outline.size());
    for (std::size_t cell = 0; cell < cells; ++cell) {
      const double x = numbers.between(0, box.length);
      const double y = numbers.between(0, box.height);
      place(outline, {x, y}, numbers.between(0, 2 * std::numbers::pi), state);
    }
    return state;
  }
  std::size_t inside = 0;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    EnsembleState state = pack_once(system, outline, cells, box, Numbers(seed, stream, attempt),
                                    1 << static_cast<unsigned>(attempt));
    inside = count_interpenetrating_nodes(state, box);
    if (inside == 0) {
      return state;
    }
  }
  const double fraction = static_cast<double>(cells) * system.mesh.rest_area / box.area();
  const double rest_distance = std::sqrt(system.contact.rest_squared);
  const double layer = 0.5 * rest_distance * system.mesh.rest_perimeter;
  throw ParameterError(
      fmt::format("packing: {} of {} nodes lie inside other cells after {} attempts at an area "
                  "fraction of {:.3g}, "
                  "which is {:.3g} with half the contact rest distance {:.3g} m around every cell; "
                  "up to about 0.85 of "
                  "the latter can be packed; lower the hematocrit or the rest distance, or raise "
                  "the contact stiffness",
                  inside, cells * outline.size(), attempts, fraction,
                  fraction * (1 + layer / system.mesh.rest_area), rest_distance));
}

}  // namespace hemoscale::micro
