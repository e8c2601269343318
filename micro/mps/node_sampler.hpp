#pragma once

#include <cstdint>
#include <vector>

#include "micro/particles/node_bins.hpp"
#include "micro/particles/periodic_box.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// Weights of the nodes around each of some points: value at point p = sum over k of
/// weights[k] * value at node nodes[k], k from first[p] to first[p + 1].
struct SampleWeights {
  std::vector<std::size_t> first = {0};
  std::vector<std::int32_t> nodes;
  std::vector<double> weights;

  std::size_t size() const { return first.size() - 1; }

  template <typename Value>
  Value sample(std::size_t point, const std::vector<Value>& field) const {
    Value sum = weights[first[point]] * field[static_cast<std::size_t>(nodes[first[point]])];
    for (std::size_t k = first[point] + 1; k < first[point + 1]; ++k) {
      sum += weights[k] * field[static_cast<std::size_t>(nodes[k])];
    }
    return sum;
  }
};

/// Values between nodes that rest, by parabolas fitted to the nodes around each point with the
/// weight (1 - r/radius)^2: the fits of interpolate_flow(), for points that come again and again.
/// Exact for quadratic fields, third order for others.
template <int dim>
class NodeSampler {
 public:
  /// @param radius  of the fits [m]
  NodeSampler(std::vector<Vector<dim>> positions, const PeriodicBox<dim>& box, double radius);

  /// @throws NumericalError naming the point if too few nodes are near it
  SampleWeights weights(const std::vector<Vector<dim>>& points) const;

  /// L(i,j) = d u_i / d x_j of a field on the nodes, by the same fits: second order.
  std::vector<Tensor<dim>> gradients(const std::vector<Vector<dim>>& points,
                                     const std::vector<Vector<dim>>& field) const;

 private:
  struct Fit;
  Fit fit(const Vector<dim>& point) const;

  NodeBins<dim> bins_;
  double radius_;  // [m]
};

}  // namespace hemoscale::micro
