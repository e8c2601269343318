#pragma once

#include <optional>
#include <vector>

#include "macro/flow_state.hpp"

namespace hemoscale::macro {

/// Read-only answer to "what is the flow at x, t".
template <int dim>
class FlowField {
 public:
  virtual ~FlowField() = default;

  /// @param x  position [m]
  /// @param t  time [s]
  /// @returns  empty where the field is not defined (outside the mesh or the channel)
  virtual std::optional<FlowState<dim>> at(const Vector<dim>& x, double t) const = 0;

  /// The flow at many points. Distributed fields override it: the call is then collective over the
  /// ranks of the field, every rank passes the same points and receives the same answers.
  virtual std::vector<std::optional<FlowState<dim>>> sample(const std::vector<Vector<dim>>& points,
                                                            double t) const {
    std::vector<std::optional<FlowState<dim>>> states;
    states.reserve(points.size());
    for (const Vector<dim>& x : points) states.push_back(at(x, t));
    return states;
  }
};

}  // namespace hemoscale::macro
