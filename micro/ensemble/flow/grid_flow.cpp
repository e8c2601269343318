#include "micro/ensemble/flow/grid_flow.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "micro/ensemble/flow/grid_extension.hpp"

namespace hemoscale::micro {
namespace {

/// Places of the parts of a node: value and derivatives, in units of the spacing.
constexpr std::size_t value = 0;
constexpr std::size_t along_x = 1;
constexpr std::size_t along_y = 2;
constexpr std::size_t along_both = 3;

/// A difference formula for the first derivative: coefficients of the neighbours from -3 to 3.
struct Formula {
  std::array<double, 7> coefficients;
};

/// In the order of preference: of fourth order, of third, of second, of first.
constexpr std::array<Formula, 10> formulas = {{
    {{0, 1.0 / 12, -2.0 / 3, 0, 2.0 / 3, -1.0 / 12, 0}},
    {{0, 0, -1.0 / 3, -0.5, 1, -1.0 / 6, 0}},
    {{0, 1.0 / 6, -1, 0.5, 1.0 / 3, 0, 0}},
    {{0, 0, 0, -11.0 / 6, 3, -1.5, 1.0 / 3}},
    {{-1.0 / 3, 1.5, -3, 11.0 / 6, 0, 0, 0}},
    {{0, 0, -0.5, 0, 0.5, 0, 0}},
    {{0, 0, 0, -1.5, 2, -0.5, 0}},
    {{0, 0.5, -2, 1.5, 0, 0, 0}},
    {{0, 0, 0, -1, 1, 0, 0}},
    {{0, 0, -1, 1, 0, 0, 0}},
}};

/// Derivative per spacing of what get(k) returns for the neighbours k = -3 to 3 of a known node,
/// empty for those that are not known; 0 for a node without known neighbours.
template <typename Get>
double difference(const Get& get) {
  std::array<std::optional<double>, 7> values;
  for (std::size_t k = 0; k < 7; ++k) values[k] = get(static_cast<long>(k) - 3);
  for (const Formula& formula : formulas) {
    double sum = 0;
    bool is_usable = true;
    for (std::size_t k = 0; k < 7 && is_usable; ++k) {
      if (formula.coefficients[k] == 0) continue;
      is_usable = values[k].has_value();
      if (is_usable) sum += formula.coefficients[k] * *values[k];
    }
    if (is_usable) return sum;
  }
  return 0;
}

/// Hermite's functions and their derivatives: of the value and of the derivative at 0, then at 1.
struct Basis {
  std::array<double, 4> values, first, second;
};

Basis basis(double s) {
  const double r = 1 - s;
  return {{r * r * (1 + 2 * s), s * r * r, s * s * (3 - 2 * s), -s * s * r},
          {-6 * s * r, r * (1 - 3 * s), 6 * s * r, s * (3 * s - 2)},
          {6 - 12 * (1 - s), 6 * s - 4, 6 - 12 * s, 6 * s - 2}};
}

/// The number of the last node at or before a place along an axis, and the place between it and
/// the next; a place beyond the grid is that of its edge.
struct Cell {
  std::size_t first = 0;
  double share = 0;
  bool is_beyond = false;
};

Cell cell_of(double place, std::size_t nodes) {
  const double last = static_cast<double>(nodes - 1);
  if (!(place > 0)) return {0, 0, place < 0};
  if (!(place < last)) return {nodes - 2, 1, place > last};
  const double first = std::floor(place);
  return {static_cast<std::size_t>(first), place - first, false};
}

}  // namespace

GridFlow::GridFlow(const GridSamples& samples, const WallGeometry* walls) {
  check(samples);
  origin_ = samples.origin;
  spacing_ = samples.spacing;
  columns_ = samples.columns;
  rows_ = samples.rows;
  nodes_.resize(columns_ * rows_);
  const std::vector<std::optional<Vector<2>>> velocities = extended(samples, walls);
  std::vector<bool> is_known(nodes_.size(), false);
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    if (!velocities[k]) continue;
    is_known[k] = true;
    for (std::size_t c = 0; c < 2; ++c) {
      nodes_[k].components[c][value] = (*velocities[k])[static_cast<Eigen::Index>(c)];
    }
  }
  differentiate(is_known);
  measure_divergence(samples);
  bound(samples);
}

void GridFlow::differentiate(const std::vector<bool>& is_known) {
  const auto along = [&](std::size_t part, std::size_t target, long dx, long dy) {
    for (std::size_t row = 0; row < rows_; ++row) {
      for (std::size_t column = 0; column < columns_; ++column) {
        Node& here = nodes_[row * columns_ + column];
        if (!is_known[row * columns_ + column]) continue;
        for (std::size_t c = 0; c < 2; ++c) {
          here.components[c][target] = difference([&](long k) -> std::optional<double> {
            const long i = static_cast<long>(column) + k * dx;
            const long j = static_cast<long>(row) + k * dy;
            if (i < 0 || j < 0 || i >= static_cast<long>(columns_) || j >= static_cast<long>(rows_))
              return std::nullopt;
            const std::size_t at =
                static_cast<std::size_t>(j) * columns_ + static_cast<std::size_t>(i);
            if (!is_known[at]) return std::nullopt;
            return nodes_[at].components[c][part];
          });
        }
      }
    }
  };
  along(value, along_x, 1, 0);
  along(value, along_y, 0, 1);
  along(along_y, along_both, 1, 0);
}

void GridFlow::measure_divergence(const GridSamples& samples) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    if (!samples.velocities[k]) continue;
    const double here =
        (nodes_[k].components[0][along_x] + nodes_[k].components[1][along_y]) / spacing_;
    sum += here * here;
    ++count;
    divergence_.largest = std::max(divergence_.largest, std::abs(here));
  }
  divergence_.rms = std::sqrt(sum / static_cast<double>(count));
}

/// A bicubic polynomial lies within the range of its coefficients in Bernstein's basis, and so do
/// its derivatives within those of their differences.
void GridFlow::bound(const GridSamples& samples) {
  using Coefficients = std::array<std::array<double, 4>, 4>;  // along x, along y
  const auto coefficients = [&](std::size_t column, std::size_t row, std::size_t c) {
    Coefficients b{};
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t j = 0; j < 2; ++j) {
        const Corner& f = node(column + i, row + j).components[c];
        const double a = i == 0 ? 1.0 / 3 : -1.0 / 3;
        const double d = j == 0 ? 1.0 / 3 : -1.0 / 3;
        const std::size_t x = 3 * i;
        const std::size_t y = 3 * j;
        const std::size_t next_x = i == 0 ? 1 : 2;
        const std::size_t next_y = j == 0 ? 1 : 2;
        b[x][y] = f[value];
        b[next_x][y] = f[value] + a * f[along_x];
        b[x][next_y] = f[value] + d * f[along_y];
        b[next_x][next_y] = f[value] + a * f[along_x] + d * f[along_y] + a * d * f[along_both];
      }
    }
    return b;
  };
  for (std::size_t row = 0; row + 1 < rows_; ++row) {
    for (std::size_t column = 0; column + 1 < columns_; ++column) {
      bool has_fluid = false;
      for (const std::size_t k :
           {samples.index(column, row), samples.index(column + 1, row),
            samples.index(column, row + 1), samples.index(column + 1, row + 1)}) {
        has_fluid = has_fluid || samples.velocities[k].has_value();
      }
      if (!has_fluid) continue;
      Tensor<2> slopes = Tensor<2>::Zero();  // [m/s] largest |d u_i / d x_j| times the spacing
      Vector<2> largest = Vector<2>::Zero();
      for (std::size_t c = 0; c < 2; ++c) {
        const Coefficients b = coefficients(column, row, c);
        const auto k = static_cast<Eigen::Index>(c);
        for (std::size_t i = 0; i < 4; ++i) {
          for (std::size_t j = 0; j < 4; ++j) {
            largest[k] = std::max(largest[k], std::abs(b[i][j]));
            if (i > 0) slopes(k, 0) = std::max(slopes(k, 0), 3 * std::abs(b[i][j] - b[i - 1][j]));
            if (j > 0) slopes(k, 1) = std::max(slopes(k, 1), 3 * std::abs(b[i][j] - b[i][j - 1]));
          }
        }
      }
      const double across = slopes(0, 1) + slopes(1, 0);
      const double squared =
          2 * slopes(0, 0) * slopes(0, 0) + 2 * slopes(1, 1) * slopes(1, 1) + across * across;
      largest_shear_rate_ = std::max(largest_shear_rate_, std::sqrt(squared) / spacing_);
      largest_speed_ = std::max(largest_speed_, largest.norm());
    }
  }
}

LocalFlow GridFlow::at(const Vector<2>& x, double /*time*/) const {
  const Cell cell_x = cell_of((x[0] - origin_[0]) / spacing_, columns_);
  const Cell cell_y = cell_of((x[1] - origin_[1]) / spacing_, rows_);
  const Basis bx = basis(cell_x.share);
  const Basis by = basis(cell_y.share);
  LocalFlow flow;
  for (std::size_t c = 0; c < 2; ++c) {
    double u = 0, u_x = 0, u_y = 0, u_xx = 0, u_xy = 0, u_yy = 0;
    for (std::size_t j = 0; j < 2; ++j) {
      for (std::size_t i = 0; i < 2; ++i) {
        const Corner& f = node(cell_x.first + i, cell_y.first + j).components[c];
        const std::size_t a = 2 * i;
        const std::size_t b = 2 * j;
        // Along y first: the value and the derivative along x at this corner.
        const double f0 = f[value] * by.values[b] + f[along_y] * by.values[b + 1];
        const double f1 = f[along_x] * by.values[b] + f[along_both] * by.values[b + 1];
        const double g0 = f[value] * by.first[b] + f[along_y] * by.first[b + 1];
        const double g1 = f[along_x] * by.first[b] + f[along_both] * by.first[b + 1];
        const double h0 = f[value] * by.second[b] + f[along_y] * by.second[b + 1];
        const double h1 = f[along_x] * by.second[b] + f[along_both] * by.second[b + 1];
        u += f0 * bx.values[a] + f1 * bx.values[a + 1];
        u_x += f0 * bx.first[a] + f1 * bx.first[a + 1];
        u_xx += f0 * bx.second[a] + f1 * bx.second[a + 1];
        u_y += g0 * bx.values[a] + g1 * bx.values[a + 1];
        u_xy += g0 * bx.first[a] + g1 * bx.first[a + 1];
        u_yy += h0 * bx.values[a] + h1 * bx.values[a + 1];
      }
    }
    // Beyond the grid nothing changes across its edge.
    const double is_x = cell_x.is_beyond ? 0 : 1;
    const double is_y = cell_y.is_beyond ? 0 : 1;
    const auto k = static_cast<Eigen::Index>(c);
    flow.velocity[k] = u;
    flow.gradient(k, 0) = is_x * u_x / spacing_;
    flow.gradient(k, 1) = is_y * u_y / spacing_;
    const double squared = spacing_ * spacing_;
    flow.second[c](0, 0) = is_x * u_xx / squared;
    flow.second[c](1, 1) = is_y * u_yy / squared;
    flow.second[c](0, 1) = flow.second[c](1, 0) = is_x * is_y * u_xy / squared;
  }
  return flow;
}

}  // namespace hemoscale::micro
