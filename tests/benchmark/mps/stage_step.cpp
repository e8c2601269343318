// Motivation: what one step of the least-squares method costs, kernel by kernel and as a whole, how
// it grows with the number of nodes, and what share of the machine's limits it reaches. One line of
// JSON per case; CPU seconds of the process (of all threads), the best of three.
//   benchmark_stage [largest number of nodes]

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>

#include "micro/mps/node_domains.hpp"
#include "micro/mps/stage_stepper.hpp"

namespace {

using namespace hemoscale::micro;

double cpu_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

struct Cost {
  double cpu = 1e300;   // [s]
  double wall = 1e300;  // [s]
};

template <typename Work>
Cost best_of_three(const Work& work) {
  Cost best;
  for (int k = 0; k < 3; ++k) {
    const double cpu = cpu_seconds();
    const auto wall = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - wall;
    best.cpu = std::min(best.cpu, cpu_seconds() - cpu);
    best.wall = std::min(best.wall, passed.count());
  }
  return best;
}

/// Memory bandwidth of a = b + s c over arrays far larger than the caches [GB/s].
double triad_bandwidth() {
  const std::size_t n = 20'000'000;
  std::vector<double> a(n, 0.0);
  const std::vector<double> b(n, 1.0);
  const std::vector<double> c(n, 2.0);
  const Cost cost = best_of_three([&] {
#pragma omp parallel for schedule(static)
    for (std::size_t i = 0; i < n; ++i) a[i] = b[i] + 3 * c[i];
  });
  return 24e-9 * static_cast<double>(n) / cost.wall;
}

/// Multiplications and additions that the compiler's vectors reach on data in registers [Gflop/s].
double arithmetic_rate() {
  constexpr std::size_t lanes = 32;
  constexpr long rounds = 20'000'000;
  double sums[lanes];
  const Cost cost = best_of_three([&] {
    for (std::size_t k = 0; k < lanes; ++k) sums[k] = 1e-3 * static_cast<double>(k);
    for (long r = 0; r < rounds; ++r) {
      for (std::size_t k = 0; k < lanes; ++k) sums[k] = sums[k] * 0.999 + 1e-3;
    }
  });
  volatile double kept = sums[0];
  (void)kept;
  return 2e-9 * static_cast<double>(lanes) * static_cast<double>(rounds) / cost.wall;
}

/// A jittered channel 8:1 with about `wanted` nodes.
FlowDomain<2> channel_of(double wanted) {
  const double rows = std::round(std::sqrt(wanted / 8));
  FlowDomain<2> domain =
      channel_nodes(8, 1, false, {.spacing = 1 / rows, .disorder = 0.1, .seed = 1});
  domain.patches[inlet_patch].velocity = [](const Vector<2>& x, double) {
    return Vector<2>(6 * x[1] * (1 - x[1]), 0);
  };
  return domain;
}

void kernels(const FlowDomain<2>& domain, double bandwidth, double arithmetic) {
  const auto& positions = domain.particles.positions;
  const auto count = static_cast<double>(positions.size());
  const double radius = 2.5 * domain.spacing;
  NeighbourTable table;
  const auto line = [&](const char* name, const Cost& cost, double bytes, double flops) {
    fmt::print(
        "{{\"kernel\": \"{}\", \"nodes\": {}, \"threads\": {}, \"cpu_ns_per_node\": {:.1f}, "
        "\"wall_ns_per_node\": {:.1f}, \"share_of_bandwidth\": {:.3f}, \"share_of_arithmetic\": "
        "{:.3f}}}\n",
        name, positions.size(), omp_get_max_threads(), 1e9 * cost.cpu / count,
        1e9 * cost.wall / count, 1e-9 * bytes / cost.wall / bandwidth,
        1e-9 * flops / cost.wall / arithmetic);
  };
  const Cost search = best_of_three([&] { table.build<2>(positions, domain.box, radius); });
  const auto pairs = static_cast<double>(table.pairs());
  // Read and written once: positions, offsets, neighbours; nine cells are searched for 20 pairs.
  line("neighbours", search, 40 * count + 4 * pairs, 6 * 2.9 * pairs);
  Stencils<2> stencils;
  const Cost fit = best_of_three([&] {
    stencils = least_squares_stencils<2>({.radius = radius}, positions, domain.box, table);
  });
  // Fifteen distinct moments and the product of a 5 by 5 matrix for each pair; one inverse a node.
  line("least-squares operators", fit, 40 * count + 28 * pairs, 100 * pairs + 400 * count);
  std::vector<double> field(positions.size(), 1.0);
  std::vector<Vector<2>> gradient;
  const Cost apply = best_of_three([&] { apply_gradient(stencils, table, field, gradient); });
  line("gradient", apply, 40 * count + 20 * pairs, 5 * pairs);
  std::vector<Vector<2>> laplacian;
  const Cost laplace =
      best_of_three([&] { apply_laplacian(stencils, table, gradient, laplacian); });
  line("laplacian of a vector", laplace, 56 * count + 12 * pairs, 6 * pairs);
}

void whole_step(const FlowDomain<2>& domain, NodeMotion motion) {
  StageOptions options;
  options.coupling = PressureCoupling::incremental;
  options.linear_solver = LinearSolverKind::aggregate;
  options.tolerance.relative_residual = 1e-8;
  options.motion = motion;
  if (motion != NodeMotion::eulerian) {
    options.shifting = Shifting::concentration;
    options.shifting_strength = 0.3;
  }
  StageStepper<2> stepper(domain, {.density = 1, .kinematic_viscosity = 10}, options);
  const double step = 0.2 * domain.spacing / 1.5;
  stepper.step(step);  // with what is set up once
  const Cost cost = best_of_three([&] { stepper.step(step); });
  const auto count = static_cast<double>(stepper.particles().size());
  fmt::print(
      "{{\"step\": \"{}\", \"nodes\": {}, \"threads\": {}, \"cpu_s\": {:.4f}, \"wall_s\": {:.4f}, "
      "\"cpu_us_per_node\": {:.3f}, \"iterations\": {}}}\n",
      motion == NodeMotion::eulerian ? "resting nodes" : "moving nodes", stepper.particles().size(),
      omp_get_max_threads(), cost.cpu, cost.wall, 1e6 * cost.cpu / count,
      stepper.report().solve.iterations);
}

}  // namespace

int main(int count, char** arguments) {
  const double largest = count > 1 ? std::atof(arguments[1]) : 5e5;
  const double bandwidth = triad_bandwidth();
  const double arithmetic = arithmetic_rate();
  fmt::print(
      "{{\"triad_GB_per_s\": {:.2f}, \"arithmetic_Gflop_per_s\": {:.2f}, \"threads\": {}}}\n",
      bandwidth, arithmetic, omp_get_max_threads());
  for (const double nodes : {5e3, 5e4, 5e5}) {
    if (nodes > largest) continue;
    const FlowDomain<2> domain = channel_of(nodes);
    kernels(domain, bandwidth, arithmetic);
    whole_step(domain, NodeMotion::eulerian);
    whole_step(domain, NodeMotion::lagrangian);
  }
  return 0;
}
