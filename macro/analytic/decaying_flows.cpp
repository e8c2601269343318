#include "macro/analytic/decaying_flows.hpp"

#include <cmath>

#include "macro/parameter_check.hpp"

namespace hemoscale::macro {

namespace {

constexpr double pi = 3.14159265358979323846;

void check_fluid(const char* owner, double viscosity, double density) {
  require_not_negative({owner, "viscosity", viscosity, "Pa s"}, "give that of the fluid, or zero");
  require_positive({owner, "density", density, "kg/m^3"}, "give that of the fluid");
}

}  // namespace

template <int dim>
TaylorGreen<dim>::TaylorGreen(const TaylorGreenFlow& flow) : flow_(flow) {
  const char* owner = "Taylor-Green flow";
  require_positive({owner, "length", flow.length, "m"}, "give the edge of the box");
  require_finite({owner, "speed", flow.speed, "m/s"}, "give the amplitude of the velocity");
  check_fluid(owner, flow.viscosity, flow.density);
}

template <int dim>
std::optional<FlowState<dim>> TaylorGreen<dim>::at(const Vector<dim>& x, double t) const {
  const double k = 2 * pi / flow_.length;
  const double nu = flow_.viscosity / flow_.density;
  const double decay = std::exp(-dim * nu * k * k * t);
  double along = 1;
  double slope = 0;  // of `along` in z
  if constexpr (dim == 3) {
    along = std::cos(k * x[2]);
    slope = -k * std::sin(k * x[2]);
  }
  const double sx = std::sin(k * x[0]);
  const double cx = std::cos(k * x[0]);
  const double sy = std::sin(k * x[1]);
  const double cy = std::cos(k * x[1]);
  const double u = flow_.speed * decay;
  FlowState<dim> state;
  state.velocity[0] = u * sx * cy * along;
  state.velocity[1] = -u * cx * sy * along;
  state.velocity_gradient(0, 0) = u * k * cx * cy * along;
  state.velocity_gradient(0, 1) = -u * k * sx * sy * along;
  state.velocity_gradient(1, 0) = u * k * sx * sy * along;
  state.velocity_gradient(1, 1) = -u * k * cx * cy * along;
  if constexpr (dim == 3) {
    state.velocity_gradient(0, 2) = u * sx * cy * slope;
    state.velocity_gradient(1, 2) = -u * cx * sy * slope;
  } else {
    state.pressure = flow_.density * u * u / 4 * (std::cos(2 * k * x[0]) + std::cos(2 * k * x[1]));
  }
  return state;
}

ShearWave::ShearWave(const ShearWaveFlow& flow) : flow_(flow) {
  const char* owner = "shear wave";
  require_positive({owner, "height", flow.height, "m"}, "give the length of the wave");
  require_finite({owner, "rate", flow.rate, "1/s"}, "give du/dy");
  require_finite({owner, "speed", flow.speed, "m/s"}, "give the amplitude of the velocity");
  check_fluid(owner, flow.viscosity, flow.density);
}

std::optional<FlowState<2>> ShearWave::at(const Vector<2>& x, double t) const {
  const double k = 2 * pi / flow_.height;
  const double u = flow_.speed * std::exp(-k * k * flow_.viscosity / flow_.density * t);
  FlowState<2> state;
  state.velocity[0] = flow_.rate * x[1] + u * std::sin(k * x[1]);
  state.velocity_gradient(0, 1) = flow_.rate + u * k * std::cos(k * x[1]);
  return state;
}

template class TaylorGreen<2>;
template class TaylorGreen<3>;

}  // namespace hemoscale::macro
