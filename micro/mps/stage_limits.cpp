#include "micro/mps/stage_limits.hpp"

#include <cmath>
#include <numbers>

#include "micro/mps/least_squares.hpp"
#include "micro/particles/lattice_points.hpp"

namespace hemoscale::micro {

template <int dim>
double largest_least_squares_eigenvalue(double ratio) {
  std::vector<Vector<dim>> points = lattice_points<dim>(ratio);
  points.push_back(Vector<dim>::Zero());
  const std::vector<double> weights =
      laplacian_weights<dim>({.radius = ratio, .condition_bound = 1e12}, points);
  // On a lattice the symbol is largest for waves of two spacings or near them; a grid that holds
  // the corners of the octant of wave vectors finds it to a few parts in a thousand.
  constexpr int divisions = dim == 2 ? 64 : 24;
  const int depth = dim == 3 ? divisions : 0;
  double largest = 0;
  for (int a = 0; a <= divisions; ++a) {
    for (int b = 0; b <= divisions; ++b) {
      for (int c = 0; c <= depth; ++c) {
        Vector<dim> wave;
        wave[0] = std::numbers::pi * a / divisions;
        wave[1] = std::numbers::pi * b / divisions;
        if constexpr (dim == 3) wave[2] = std::numbers::pi * c / divisions;
        double symbol = 0;
        for (std::size_t j = 0; j + 1 < points.size(); ++j) {
          symbol += weights[j] * (1 - std::cos(wave.dot(points[j])));
        }
        largest = std::max(largest, symbol);
      }
    }
  }
  return largest;
}

template <int dim>
std::vector<Limit> stage_limits(const StageOptions& options, const Fluid& fluid, double spacing,
                                double time_step, const FlowScales& scales) {
  std::vector<Limit> limits;
  const double nu = fluid.kinematic_viscosity;
  if (options.viscosity == ViscosityTreatment::explicit_euler && nu > 0) {
    limits.push_back({.name = "viscous limit",
                      .value = time_step,
                      .limit = 2 * spacing * spacing /
                               (nu * largest_least_squares_eigenvalue<dim>(options.kernel_ratio)),
                      .unit = "s",
                      .remedy = "reduce the time step, or use implicit viscosity"});
  }
  if (scales.speed > 0 && options.inertia == Inertia::unsteady) {
    const bool rests = options.motion == NodeMotion::eulerian;
    limits.push_back({.name = "advective limit",
                      .value = scales.speed * time_step / spacing,
                      .limit = rests ? 1.0 : 0.5,
                      .unit = "-",
                      .remedy = "reduce the time step"});
  }
  if (options.coupling == PressureCoupling::chorin && scales.gap > 0) {
    limits.push_back(splitting_limit(time_step, nu, scales.gap));
  }
  return limits;
}

template double largest_least_squares_eigenvalue<2>(double);
template double largest_least_squares_eigenvalue<3>(double);
template std::vector<Limit> stage_limits<2>(const StageOptions&, const Fluid&, double, double,
                                            const FlowScales&);
template std::vector<Limit> stage_limits<3>(const StageOptions&, const Fluid&, double, double,
                                            const FlowScales&);

}  // namespace hemoscale::micro
