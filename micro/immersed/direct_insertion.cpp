#include "micro/immersed/direct_insertion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "micro/error.hpp"
#include "micro/mps/mps_kernel.hpp"
#include "micro/mps/number_density.hpp"
#include "micro/mps/particle_shifting.hpp"
#include "micro/particles/node_bins.hpp"
#include "micro/particles/rearrange.hpp"

namespace hemoscale::micro {

namespace {

/// Share of l0^2 grad(n / n0) by which a sweep moves the plasma; 0.5 is the largest stable one.
constexpr double sweep_strength = 0.2;

/// How far from a membrane the plasma is settled [l0]: as far as the kernels feel it.
constexpr double settled_width = 3;

double distance_to(const Cell& cell, const PeriodicBox<2>& box, const Vector<2>& x) {
  double least = std::numeric_limits<double>::infinity();
  const std::size_t n = cell.positions.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vector<2>& a = cell.positions[i];
    const Vector<2> along = cell.positions[i + 1 < n ? i + 1 : 0] - a;
    const Vector<2> r = separation(box, a, x);
    const double share = std::clamp(r.dot(along) / along.squaredNorm(), 0.0, 1.0);
    least = std::min(least, (r - share * along).norm());
  }
  return least;
}

std::vector<double> distances_to(const std::vector<Cell>& cells, const FlowDomain<2>& domain) {
  const std::vector<Vector<2>>& positions = domain.particles.positions;
  std::vector<double> distances(positions.size(), std::numeric_limits<double>::infinity());
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < positions.size(); ++i) {
    for (const Cell& cell : cells) {
      distances[i] = std::min(distances[i], distance_to(cell, domain.box, positions[i]));
    }
  }
  return distances;
}

/// Velocity of the plasma particle nearest to each node.
std::vector<Vector<2>> plasma_velocities(const FlowDomain<2>& domain, const NodeBins<2>& bins,
                                         const Cell& cell, std::size_t number) {
  std::vector<Vector<2>> velocities;
  for (const Vector<2>& x : cell.positions) {
    double least = 2.25 * domain.spacing * domain.spacing;
    std::size_t nearest = domain.particles.size();
    bins.visit_around(x, 2, [&](std::size_t k, const Vector<2>& r) {
      if (domain.particles.kinds[k] != ParticleKind::fluid || r.squaredNorm() >= least) return;
      least = r.squaredNorm();
      nearest = k;
    });
    if (nearest == domain.particles.size()) {
      throw ParameterError(fmt::format(
          "cell {}: there is no plasma at its node at ({:.6g}, {:.6g}) m; move the cell", number,
          x[0], x[1]));
    }
    velocities.push_back(domain.particles.velocities[nearest]);
  }
  return velocities;
}

/// The domain with the nodes of the cells instead of the plasma nearer to them than `clearance`.
FlowDomain<2> replaced(const FlowDomain<2>& domain, const std::vector<double>& distances,
                       const std::vector<Cell>& cells,
                       const std::vector<std::vector<Vector<2>>>& velocities,
                       std::int64_t first_identity, double clearance) {
  std::vector<std::int32_t> staying;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const bool is_plasma = domain.particles.kinds[i] == ParticleKind::fluid;
    if (is_plasma && distances[i] < clearance * domain.spacing) continue;
    staying.push_back(static_cast<std::int32_t>(i));
  }
  FlowDomain<2> result = domain;
  rearrange(result.particles, staying);
  std::int64_t identity = first_identity;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const auto patch = static_cast<std::int32_t>(result.patches.size());
    result.patches.push_back({.name = fmt::format("cell {}", c), .kind = ParticleKind::fluid});
    for (std::size_t i = 0; i < cells[c].positions.size(); ++i) {
      result.particles.append(cells[c].positions[i], identity++, ParticleKind::fluid, patch);
      result.particles.velocities.back() = velocities[c][i];
    }
  }
  return result;
}

/// Density and pairs at the present positions.
struct Surroundings {
  NeighbourTable table;
  PairGeometry<2> pairs;
  std::vector<double> density;

  void look(const FlowDomain<2>& domain, const MpsKernel& kernel) {
    table.build(domain.particles.positions, domain.box, kernel.largest_radius());
    measure_pairs(domain.particles.positions, domain.box, table, pairs);
    number_density(kernel, pairs, table, density);
  }
};

void settle(FlowDomain<2>& domain, const std::vector<Cell>& cells, const MpsKernel& kernel,
            int sweeps) {
  ParticleSet<2>& particles = domain.particles;
  const std::vector<double> distances = distances_to(cells, domain);
  Surroundings around;
  std::vector<Vector<2>> shifts;
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    around.look(domain, kernel);
    shift_displacements(kernel, ShiftKind::concentration, sweep_strength, around.pairs,
                        around.table, particles.kinds, shifts);
    for (std::size_t i = 0; i < particles.size(); ++i) {
      const bool is_plasma = particles.kinds[i] == ParticleKind::fluid && particles.patches[i] < 0;
      if (is_plasma && distances[i] < settled_width * domain.spacing) {
        particles.positions[i] += shifts[i];
      }
    }
  }
}

double deviation_around(const FlowDomain<2>& domain, const std::vector<Cell>& cells,
                        const MpsKernel& kernel) {
  Surroundings around;
  around.look(domain, kernel);
  const std::vector<double> distances = distances_to(cells, domain);
  double squares = 0;
  double count = 0;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    if (domain.particles.kinds[i] != ParticleKind::fluid) continue;
    if (distances[i] >= settled_width * domain.spacing) continue;
    squares += std::pow(around.density[i] / kernel.gradient_density - 1, 2);
    count += 1;
  }
  return count > 0 ? std::sqrt(squares / count) : 0;
}

}  // namespace

InsertedMembranes insert_membranes(const FlowDomain<2>& domain, const std::vector<Cell>& cells,
                                   const DirectInsertion& insertion, double gradient_ratio,
                                   double laplacian_ratio) {
  InsertedMembranes result;
  const NodeBins<2> bins(domain.particles.positions, domain.box, domain.spacing);
  std::vector<std::vector<Vector<2>>> velocities;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    velocities.push_back(plasma_velocities(domain, bins, cells[c], c));
  }
  for (const std::int64_t identity : domain.particles.identities) {
    result.first_identity = std::max(result.first_identity, identity + 1);
  }
  const MpsKernel kernel = mps_kernel<2>(domain.spacing, gradient_ratio, laplacian_ratio);
  const std::vector<double> distances = distances_to(cells, domain);
  std::vector<double> clearances = {insertion.clearance};
  if (!(insertion.clearance > 0)) clearances = {0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2};
  result.deviation = std::numeric_limits<double>::infinity();
  for (const double clearance : clearances) {
    FlowDomain<2> candidate =
        replaced(domain, distances, cells, velocities, result.first_identity, clearance);
    const double deviation = deviation_around(candidate, cells, kernel);
    if (!(deviation < result.deviation)) continue;
    result.clearance = clearance;
    result.deviation = deviation;
    result.domain = std::move(candidate);
  }
  std::size_t nodes = 0;
  for (const Cell& cell : cells) nodes += cell.positions.size();
  result.removed = domain.particles.size() + nodes - result.domain.particles.size();
  settle(result.domain, cells, kernel, insertion.sweeps);
  result.deviation = deviation_around(result.domain, cells, kernel);
  return result;
}

}  // namespace hemoscale::micro
