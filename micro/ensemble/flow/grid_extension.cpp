#include "micro/ensemble/flow/grid_extension.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace hemoscale::micro {
namespace {

constexpr int window = 2;  // nodes of the fit on either side of its centre
constexpr int width = 2 * window + 1;
constexpr double wall_weight = 4;  // of a point at rest on a wall over that of a node beside it

struct Node {
  long column = 0;
  long row = 0;
};

/// One equation of the fit.
struct Observation {
  Vector<2> place = Vector<2>::Zero();     // [m]
  Vector<2> velocity = Vector<2>::Zero();  // [m/s]
  double weight = 1;
};

class Extension {
 public:
  Extension(const GridSamples& samples, const WallGeometry* walls)
      : samples_(samples), walls_(walls) {}

  std::optional<Vector<2>> at(Node ghost) const {
    const std::optional<Node> centre = nearest_in_fluid(ghost);
    if (!centre) return std::nullopt;
    const Vector<2> x = place(ghost);
    std::vector<Observation> observations;
    for (const Node& node : connected_window(*centre)) {
      const Vector<2> y = place(node);
      observations.push_back({y, *velocity(node), weight(y - x)});
      add_wall_point(y, x, observations);
    }
    add_wall_point(x, x, observations);
    return fitted(observations, x);
  }

 private:
  bool is_inside(Node node) const {
    return node.column >= 0 && node.row >= 0 && node.column < static_cast<long>(samples_.columns) &&
           node.row < static_cast<long>(samples_.rows);
  }
  const std::optional<Vector<2>>& velocity(Node node) const {
    return samples_.velocities[samples_.index(static_cast<std::size_t>(node.column),
                                              static_cast<std::size_t>(node.row))];
  }
  bool is_fluid(Node node) const { return is_inside(node) && velocity(node).has_value(); }
  Vector<2> place(Node node) const {
    return samples_.place(static_cast<std::size_t>(node.column),
                          static_cast<std::size_t>(node.row));
  }
  double weight(const Vector<2>& d) const {
    return 1 / (1 + d.squaredNorm() / (samples_.spacing * samples_.spacing));
  }

  std::optional<Node> nearest_in_fluid(Node ghost) const {
    std::optional<Node> nearest;
    long least = std::numeric_limits<long>::max();
    for (long j = -extension_layers; j <= extension_layers; ++j) {
      for (long i = -extension_layers; i <= extension_layers; ++i) {
        const Node node{ghost.column + i, ghost.row + j};
        const long squared = i * i + j * j;
        if (squared < least && is_fluid(node)) {
          least = squared;
          nearest = node;
        }
      }
    }
    return nearest;
  }

  /// Nodes of the window that the centre is joined to by steps along the grid within the fluid: a
  /// thin divider hides what flows beyond it.
  std::vector<Node> connected_window(Node centre) const {
    std::array<std::array<bool, width>, width> seen{};
    std::vector<Node> nodes = {centre};
    seen[window][window] = true;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      for (const auto& [i, j] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        const Node node{nodes[k].column + i, nodes[k].row + j};
        const long a = node.column - centre.column + window;
        const long b = node.row - centre.row + window;
        if (a < 0 || b < 0 || a >= width || b >= width || !is_fluid(node)) continue;
        bool& is_seen = seen[static_cast<std::size_t>(b)][static_cast<std::size_t>(a)];
        if (is_seen) continue;
        is_seen = true;
        nodes.push_back(node);
      }
    }
    return nodes;
  }

  /// The fluid rests on the point of the wall next to y.
  void add_wall_point(const Vector<2>& y, const Vector<2>& x,
                      std::vector<Observation>& observations) const {
    if (walls_ == nullptr) return;
    const WallDistance wall = walls_->at(y);
    // Beyond the reach of the walls it is not known where they are.
    const double furthest = std::min(2 * samples_.spacing, walls_->reach());
    if (!(std::abs(wall.distance) < furthest)) return;
    const Vector<2> foot = y - wall.distance * wall.normal;
    observations.push_back({foot, Vector<2>::Zero(), wall_weight * weight(foot - x)});
  }

  Vector<2> fitted(const std::vector<Observation>& observations, const Vector<2>& x) const {
    const auto count = static_cast<Eigen::Index>(observations.size());
    Eigen::MatrixXd matrix(count, 6);
    Eigen::MatrixXd values(count, 2);
    for (Eigen::Index k = 0; k < count; ++k) {
      const Observation& point = observations[static_cast<std::size_t>(k)];
      const Vector<2> d = (point.place - x) / samples_.spacing;
      const double root = std::sqrt(point.weight);
      matrix.row(k) << 1, d[0], d[1], d[0] * d[0], d[0] * d[1], d[1] * d[1];
      matrix.row(k) *= root;
      values.row(k) = root * point.velocity.transpose();
    }
    return matrix.completeOrthogonalDecomposition().solve(values).row(0).transpose();
  }

  const GridSamples& samples_;
  const WallGeometry* walls_;
};

}  // namespace

std::vector<std::optional<Vector<2>>> extended(const GridSamples& samples,
                                               const WallGeometry* walls) {
  const Extension extension(samples, walls);
  std::vector<std::optional<Vector<2>>> velocities = samples.velocities;
  for (std::size_t row = 0; row < samples.rows; ++row) {
    for (std::size_t column = 0; column < samples.columns; ++column) {
      std::optional<Vector<2>>& velocity = velocities[samples.index(column, row)];
      if (velocity) continue;
      velocity = extension.at({static_cast<long>(column), static_cast<long>(row)});
    }
  }
  return velocities;
}

}  // namespace hemoscale::micro
