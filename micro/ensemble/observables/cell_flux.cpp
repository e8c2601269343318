#include "micro/ensemble/observables/cell_flux.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

namespace hemoscale::micro {

std::vector<CellMotion> cell_motions(const EnsembleState& state, std::span<const CellShape> shapes,
                                     std::span<const double> velocity_x,
                                     std::span<const double> velocity_y) {
  std::vector<CellMotion> motions;
  motions.reserve(state.cells);
  for (std::size_t cell = 0; cell < state.cells; ++cell) {
    const Vector<2>& middle = shapes[cell].node_mean;
    Vector<2> mean = Vector<2>::Zero();
    Tensor<2> spread = Tensor<2>::Zero();  // [m^2] sum of d d^T
    Tensor<2> together =
        Tensor<2>::Zero();  // [m^2/s] sum of v d^T; d sums to zero, v needs no mean
    for (std::size_t i = cell * state.nodes; i < (cell + 1) * state.nodes; ++i) {
      const Vector<2> d(state.x[i] - middle.x(), state.y[i] - middle.y());
      const Vector<2> v(velocity_x[i], velocity_y[i]);
      mean += v;
      spread += d * d.transpose();
      together += v * d.transpose();
    }
    CellMotion motion;
    motion.gradient = together * spread.inverse();
    motion.velocity =
        mean / static_cast<double>(state.nodes) + motion.gradient * (shapes[cell].centre - middle);
    motions.push_back(motion);
  }
  return motions;
}

LateralSums lateral_sums(const EnsembleState& state, std::span<const CellShape> shapes,
                         std::span<const CellMotion> motions, const LateralBins& bins) {
  const std::vector<double> zeros(bins.count, 0.0);
  LateralSums sums{zeros, zeros, zeros, zeros};
  std::vector<Slice> slices(bins.count);
  for (std::size_t cell = 0; cell < state.cells; ++cell) {
    const auto first = static_cast<std::ptrdiff_t>(cell * state.nodes);
    const auto last = first + static_cast<std::ptrdiff_t>(state.nodes);
    const auto [low, high] = std::minmax_element(state.y.begin() + first, state.y.begin() + last);
    add_slices(state, cell, shapes[cell].centre, bins, slices);
    const double mirror = shapes[cell].centre.y() > 0.5 * bins.height ? -1 : 1;
    const double cosine = std::cos(2 * shapes[cell].inclination);
    const double sine = mirror * std::sin(2 * shapes[cell].inclination);
    const std::size_t end = bins.bin_of(*high) + 1;
    for (std::size_t b = bins.bin_of(*low); b < end; ++b) {
      const Slice& slice = slices[b];
      sums.area[b] += slice.area;
      sums.transport[b] +=
          slice.area * motions[cell].velocity.x() + motions[cell].gradient.row(0).dot(slice.moment);
      sums.cosine[b] += slice.area * cosine;
      sums.sine[b] += slice.area * sine;
      slices[b] = Slice{};
    }
  }
  return sums;
}

double flow_rate(const GivenFlow& flow, double x, double height, double time,
                 std::size_t intervals) {
  const std::array<double, 3> places = {-std::sqrt(0.6), 0, std::sqrt(0.6)};
  const std::array<double, 3> weights = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  const double step = height / static_cast<double>(intervals);
  double sum = 0;
  for (std::size_t k = 0; k < intervals; ++k) {
    const double middle = step * (static_cast<double>(k) + 0.5);
    for (std::size_t g = 0; g < places.size(); ++g) {
      sum += step * weights[g] * flow.at({x, middle + 0.5 * step * places[g]}, time).velocity.x();
    }
  }
  return sum;
}

Hematocrits hematocrits(std::span<const CellShape> shapes, std::span<const CellMotion> motions,
                        const Box& box, double flow_rate) {
  double area = 0;
  double transport = 0;
  for (std::size_t cell = 0; cell < shapes.size(); ++cell) {
    area += shapes[cell].area;
    transport += shapes[cell].area * motions[cell].velocity.x();
  }
  return {.tube = area / box.area(),
          .discharge = transport / box.length / flow_rate,
          .mean_velocity = transport / area};
}

}  // namespace hemoscale::micro
