#include "micro/mps/inlet_flux.hpp"

#include <algorithm>
#include <cmath>

#include "micro/mps/flow_figures.hpp"
#include "micro/mps/node_domains.hpp"
#include "micro/mps/stage_stepper.hpp"

namespace hemoscale::micro {

double uniform_inlet_factor(const StageOptions& options, double rows) {
  // The loss in spacings does not depend on n to within a hundredth: a small channel will do.
  const double n = std::min(std::round(rows), 20.0);
  StageOptions stokes;
  stokes.inertia = Inertia::quasi_steady;
  stokes.kernel_ratio = options.kernel_ratio;
  stokes.stabilisation = options.stabilisation;
  stokes.condition_bound = options.condition_bound;
  FlowDomain<2> channel = channel_nodes(2.5 * n, n, false, {.spacing = 1});
  channel.patches[inlet_patch].velocity = [](const Vector<2>&, double) { return Vector<2>(1, 0); };
  StageStepper<2> stepper(std::move(channel), {.density = 1, .kinematic_viscosity = 1}, stokes);
  stepper.step(1);
  const SectionFlow flow = section_flow({.radius = options.kernel_ratio}, stepper.particles(),
                                        stepper.domain().box, 1, 1.5 * n, n);
  const double lost = n - flow.flow_rate;
  return rows / (rows - lost);
}

}  // namespace hemoscale::micro
