// Cost of the semi-implicit particle method on one line of JSON for each size: neighbour search,
// operator loops and whole steps by stage, on a channel of the paper's kind made longer.
//
//   benchmark_mps [particles ...]

#include <fmt/format.h>
#include <omp.h>

#include <chrono>
#include <cstdio>
#include <string>
#include <vector>

#include "micro/mps/lattice_domains_flows.hpp"
#include "micro/mps/number_density.hpp"
#include "micro/mps/semi_implicit_neighbours.hpp"
#include "micro/mps/semi_implicit_stepper.hpp"

namespace hemoscale::micro {
namespace {

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Best of several rounds, in ns per particle.
template <typename Work>
double best(std::size_t particles, const Work& work) {
  double least = 1e300;
  for (int round = 0; round < 5; ++round) {
    const double start = seconds();
    work();
    least = std::min(least, seconds() - start);
  }
  return 1e9 * least / static_cast<double>(particles);
}

void measure_loops(const FlowDomain<2>& domain) {
  const std::vector<Vector<2>>& positions = domain.particles.positions;
  const std::size_t count = positions.size();
  const MpsKernel kernel = mps_kernel<2>(domain.spacing, 2.1, 3.1);
  NeighbourTable table;
  PairGeometry<2> pairs;
  LaplacianWeights laplacian;
  std::vector<Vector<2>> gradient;
  std::vector<double> density;
  const double search = best(count, [&] {
    table.build(positions, domain.box, kernel.largest_radius(), neighbour_skin * domain.spacing);
  });
  const double geometry = best(count, [&] { measure_pairs(positions, domain.box, table, pairs); });
  const double numbers = best(count, [&] { number_density(kernel, pairs, table, density); });
  const double weights = best(
      count, [&] { laplacian_weights(kernel, LaplacianScale::local, pairs, table, laplacian); });
  const double slopes = best(count, [&] { gradient_weights(kernel, pairs, table, gradient); });
  Stencils<2> stencils;
  stencils.gradient = gradient;
  stencils.laplacian = laplacian.weights;
  std::vector<Vector<2>> result;
  const double apply =
      best(count, [&] { apply_laplacian(stencils, table, domain.particles.velocities, result); });
  fmt::print(
      "{{\"particles\": {}, \"threads\": {}, \"pairs_per_particle\": {:.1f}, \"search_ns\": "
      "{:.0f}, "
      "\"geometry_ns\": {:.0f}, \"density_ns\": {:.0f}, \"laplacian_weights_ns\": {:.0f}, "
      "\"gradient_weights_ns\": {:.0f}, \"apply_laplacian_ns\": {:.0f}}}\n",
      count, omp_get_max_threads(), static_cast<double>(table.pairs()) / static_cast<double>(count),
      search, geometry, numbers, weights, slopes, apply);
}

void measure_steps(const FlowDomain<2>& domain, const char* name, SemiImplicitOptions options,
                   double dt, int steps) {
  options.speed = 0.01;
  SemiImplicitStepper<2> stepper(domain, {.density = 1000, .kinematic_viscosity = 1e-6}, options,
                                 {.relative_residual = 1e-8});
  int iterations = 0;
  const double start = seconds();
  for (int n = 0; n < steps; ++n) {
    stepper.step(dt);
    iterations += stepper.report().pressure_iterations;
  }
  const double unit = 1e6 / (static_cast<double>(domain.particles.size()) * steps);
  const SemiImplicitTimes& times = stepper.times();
  fmt::print(
      "{{\"scheme\": \"{}\", \"particles\": {}, \"threads\": {}, \"step_us\": {:.3f}, "
      "\"neighbours_us\": {:.3f}, \"coefficients_us\": {:.3f}, \"viscosity_us\": {:.3f}, "
      "\"pressure_us\": {:.3f}, \"shifting_us\": {:.3f}, \"other_us\": {:.3f}, "
      "\"pressure_iterations\": {:.1f}}}\n",
      name, domain.particles.size(), omp_get_max_threads(), unit * (seconds() - start),
      unit * times.neighbours, unit * times.coefficients, unit * times.viscosity,
      unit * times.pressure, unit * times.shifting, unit * times.other,
      static_cast<double>(iterations) / steps);
}

void measure(std::size_t particles) {
  const double l0 = 0.5e-6;
  const auto columns = static_cast<double>(std::max<std::size_t>(particles / 28, 20));
  const FlowDomain<2> domain =
      lattice_open_channel({.spacing = l0}, columns * l0, 10e-6, parabolic_inflow(0.01, 10e-6));
  measure_loops(domain);
  SemiImplicitOptions literal = paper_literal();
  literal.relaxation = 0.2;
  const int steps = static_cast<int>(std::max<std::size_t>(3, 500000 / particles));
  measure_steps(domain, "paper", literal, 5e-8, steps);
  measure_steps(domain, "repaired", best_repaired(), 9e-7, steps);
}

}  // namespace
}  // namespace hemoscale::micro

int main(int count, char** arguments) {
  const std::vector<std::string> sizes(arguments + 1, arguments + count);
  for (const std::string& size : sizes) hemoscale::micro::measure(std::stoul(size));
  if (sizes.empty()) {
    for (const std::size_t size : {std::size_t{5000}, std::size_t{50000}})
      hemoscale::micro::measure(size);
  }
}
