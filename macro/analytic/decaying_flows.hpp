#pragma once

#include "macro/flow_field.hpp"

namespace hemoscale::macro {

/// Vortices in a periodic box that decay by viscosity (Taylor and Green 1937), k = 2 pi / length:
///
///   2-D   u =  U sin kx cos ky exp(-2 nu k^2 t),          exact at every Reynolds number
///         v = -U cos kx sin ky exp(-2 nu k^2 t)
///         p = (rho U^2 / 4) (cos 2kx + cos 2ky) exp(-4 nu k^2 t)
///   3-D   both velocities times cos kz, decay exp(-3 nu k^2 t), w = 0: the limit of small Reynolds
///         numbers, of which it misses a share of the order of U / (nu k); pressure zero in it
struct TaylorGreenFlow {
  double length = 0;     // [m] edge of the box, positive
  double speed = 0;      // [m/s] U
  double viscosity = 0;  // [Pa s] mu, not negative
  double density = 0;    // [kg/m^3] positive
};

template <int dim>
class TaylorGreen final : public FlowField<dim> {
 public:
  /// @throws ParameterError naming the first parameter that is not admissible
  explicit TaylorGreen(const TaylorGreenFlow& flow);

  std::optional<FlowState<dim>> at(const Vector<dim>& x, double t) const override;

 private:
  TaylorGreenFlow flow_;
};

/// Simple shear with a wave that viscosity damps, exact at every Reynolds number:
///
///   u = rate y + U sin(2 pi y / height) exp(-4 pi^2 nu t / height^2),   v = 0.
struct ShearWaveFlow {
  double height = 0;     // [m] of the wave, positive
  double rate = 0;       // [1/s]
  double speed = 0;      // [m/s] U
  double viscosity = 0;  // [Pa s] not negative
  double density = 0;    // [kg/m^3] positive
};

class ShearWave final : public FlowField<2> {
 public:
  /// @throws ParameterError naming the first parameter that is not admissible
  explicit ShearWave(const ShearWaveFlow& flow);

  std::optional<FlowState<2>> at(const Vector<2>& x, double t) const override;

 private:
  ShearWaveFlow flow_;
};

extern template class TaylorGreen<2>;
extern template class TaylorGreen<3>;

}  // namespace hemoscale::macro
