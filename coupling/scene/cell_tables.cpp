#include <cmath>
#include <limits>

#include "coupling/scene/cell_results.hpp"
#include "micro/cells/ring_modes.hpp"
#include "micro/cells/ring_shape.hpp"
#include "micro/immersed/membrane_flow.hpp"
#include "micro/immersed/membrane_watch.hpp"
#include "micro/mps/least_squares.hpp"

namespace hemoscale::coupling {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// A rectangle of places around the first cell.
struct Grid {
  micro::Vector<2> lower, upper;
  double spacing = 0;  // [m]
};

Grid grid_around(const CellScene& scene, const micro::Cell& cell) {
  const micro::RingShape shape = micro::measure_shape(micro::RingCurve(cell.positions));
  Grid grid;
  if (scene.is_unbounded()) {
    const double reach = 3.5 * scene.radius;
    grid.lower = shape.centroid - micro::Vector<2>::Constant(reach);
    grid.upper = shape.centroid + micro::Vector<2>::Constant(reach);
    grid.spacing = scene.radius / 15;
    return grid;
  }
  const double height = scene.plasma.size;
  grid.lower = {shape.centroid.x() - 1.5 * height, 0};
  grid.upper = {shape.centroid.x() + 1.5 * height, height};
  if (scene.period() == 0) {
    double length = 0;
    for (const auto& line : scene.walls) length = std::max(length, line.back().x());
    grid.lower.x() = std::max(grid.lower.x(), 0.0);
    grid.upper.x() = std::min(grid.upper.x(), length);
  }
  grid.spacing = height / 60;
  return grid;
}

}  // namespace

void write_modes(const std::filesystem::path& path, const micro::CellsInPlasma& model) {
  std::vector<std::vector<double>> rows;
  for (std::size_t c = 0; c < model.cells().size(); ++c) {
    const micro::Cell& cell = model.cells()[c];
    const int order = std::min(8, static_cast<int>(cell.positions.size() / 3));
    const micro::RingModes modes = micro::fourier_modes(micro::RingCurve(cell.positions), order);
    for (int k = -order; k <= order; ++k) {
      rows.push_back(
          {static_cast<double>(c), static_cast<double>(k), modes(k).real(), modes(k).imag()});
    }
  }
  write_table(path, {{"cell", "-"}, {"mode", "-"}, {"real part", "-"}, {"imaginary part", "-"}},
              rows);
}

void write_walls(const std::filesystem::path& path, const CellScene& scene) {
  std::vector<std::vector<double>> rows;
  for (std::size_t w = 0; w < scene.walls.size(); ++w) {
    for (const micro::Vector<2>& x : scene.walls[w]) {
      rows.push_back({static_cast<double>(w), x.x(), x.y()});
    }
  }
  write_table(path, {{"piece", "-"}, {"x", "m"}, {"y", "m"}}, rows);
}

void write_flow(const std::filesystem::path& path, const CellScene& scene,
                const micro::CellsInPlasma& model) {
  const Grid grid = grid_around(scene, model.cells().front());
  const micro::MembraneBounds bounds(scene.plasma.domain, 0, 0);
  const auto steps = [&](int axis) {
    return static_cast<int>(std::floor((grid.upper[axis] - grid.lower[axis]) / grid.spacing + 0.5));
  };
  std::vector<micro::Vector<2>> all, inside;
  std::vector<char> is_inside;
  for (int j = 0; j <= steps(1); ++j) {
    for (int i = 0; i <= steps(0); ++i) {
      all.emplace_back(grid.lower + grid.spacing * micro::Vector<2>(i, j));
      is_inside.push_back(bounds.fault_at(all.back()).empty() ? 1 : 0);
      if (is_inside.back() != 0) inside.push_back(all.back());
    }
  }
  micro::FlowValues flow;
  if (model.implicit() != nullptr) {
    flow = micro::MembraneFlow(*model.implicit()).at(inside);
  } else {
    const micro::ParticleSet<2>& particles = *model.particles();
    const micro::LeastSquares fit{.radius = 2.5 * scene.plasma.domain.spacing};
    for (const auto& sample :
         micro::interpolate_flow<2>(fit, particles.positions, scene.plasma.domain.box,
                                    particles.velocities, particles.pressures, inside)) {
      flow.velocities.push_back(sample.velocity);
      flow.pressures.push_back(sample.pressure);
    }
  }
  std::vector<std::vector<double>> rows;
  std::size_t next = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    std::vector<double> row = {all[k].x(), all[k].y(), nan, nan, nan};
    if (is_inside[k] != 0) {
      row[2] = flow.velocities[next].x();
      row[3] = flow.velocities[next].y();
      row[4] = flow.pressures[next];
      ++next;
    }
    rows.push_back(std::move(row));
  }
  write_table(path, {{"x", "m"}, {"y", "m"}, {"u", "m/s"}, {"v", "m/s"}, {"p", "Pa"}}, rows);
}

}  // namespace hemoscale::coupling
