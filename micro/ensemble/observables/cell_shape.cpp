#include "micro/ensemble/observables/cell_shape.hpp"

#include <fmt/core.h>

#include <Eigen/LU>
#include <cmath>

#include "micro/error.hpp"

namespace hemoscale::micro {

CellShape measure_cell(const EnsembleState& state, std::size_t cell) {
  const std::size_t nodes = state.nodes;
  const double* const x = state.x.data() + cell * nodes;
  const double* const y = state.y.data() + cell * nodes;
  CellShape shape;
  for (std::size_t k = 0; k < nodes; ++k) {
    shape.node_mean += Vector<2>(x[k] - x[0], y[k] - y[0]);
  }
  shape.node_mean = shape.node_mean / static_cast<double>(nodes) + Vector<2>(x[0], y[0]);
  // About the mean of the nodes: coordinates of a cell far from the origin would cancel.
  Vector<2> first = Vector<2>::Zero();
  Tensor<2> second = Tensor<2>::Zero();
  Vector<2> a(x[nodes - 1] - shape.node_mean.x(), y[nodes - 1] - shape.node_mean.y());
  for (std::size_t k = 0; k < nodes; ++k) {
    const Vector<2> b(x[k] - shape.node_mean.x(), y[k] - shape.node_mean.y());
    // Triangles from the origin: their area, centroid (a + b)/3 and second moments.
    const double sector = 0.5 * (a.x() * b.y() - a.y() * b.x());
    const Vector<2> sum = a + b;
    shape.area += sector;
    shape.perimeter += (b - a).norm();
    first += sector / 3 * sum;
    second += sector / 12 * (sum * sum.transpose() + a * a.transpose() + b * b.transpose());
    a = b;
  }
  if (!(shape.area > 0)) {
    throw NumericalError(fmt::format(
        "step {}, time {:.6g} s: cell {} encloses the area {:.4g} m^2; it must be positive; the "
        "cell has been turned inside out: reduce the time step or stiffen its membrane",
        state.step, state.time, cell, shape.area));
  }
  const Vector<2> offset = first / shape.area;
  shape.centre = shape.node_mean + offset;
  shape.gyration = second / shape.area - offset * offset.transpose();
  const double mean = shape.gyration.trace() / 2;
  const double difference = (shape.gyration(0, 0) - shape.gyration(1, 1)) / 2;
  const double deviation = std::hypot(difference, shape.gyration(0, 1));
  shape.inclination = 0.5 * std::atan2(shape.gyration(0, 1), difference);
  // The smaller principal value is the determinant over the larger: it cannot become negative.
  const double larger = mean + deviation;
  const double longer = std::sqrt(larger);
  const double shorter = std::sqrt(shape.gyration.determinant() / larger);
  shape.deformation = (longer - shorter) / (longer + shorter);
  return shape;
}

std::vector<CellShape> measure_cells(const EnsembleState& state) {
  std::vector<CellShape> shapes;
  shapes.reserve(state.cells);
  for (std::size_t cell = 0; cell < state.cells; ++cell) {
    shapes.push_back(measure_cell(state, cell));
  }
  return shapes;
}

}  // namespace hemoscale::micro
