#pragma once

#include "macro/analytic/plane_flow.hpp"

namespace hemoscale::macro {

/// u = U y / height: the wall y = 0 rests, the wall y = height moves along x with U.
struct PlaneCouetteProfile {
  double height = 0;         // [m] positive
  double wall_velocity = 0;  // [m/s] U
};

void check(const PlaneCouetteProfile& profile);

/// @param y  0 to height [m]; the time is not used
ProfilePoint evaluate(const PlaneCouetteProfile& profile, double y, double t);

template <int dim>
using PlaneCouette = PlaneFlow<dim, PlaneCouetteProfile>;

/// Unbounded simple shear u = (shear_rate y, 0, 0) at zero pressure; defined everywhere.
template <int dim>
class SimpleShear final : public FlowField<dim> {
 public:
  /// @param shear_rate  du/dy, of either sign [1/s]
  /// @throws ParameterError if it is not finite
  explicit SimpleShear(double shear_rate);

  std::optional<FlowState<dim>> at(const Vector<dim>& x, double t) const override;

  double shear_rate() const { return shear_rate_; }  // [1/s]

 private:
  double shear_rate_;  // [1/s]
};

extern template class SimpleShear<2>;
extern template class SimpleShear<3>;

}  // namespace hemoscale::macro
