#include "micro/mps/node_exchange.hpp"

#include "micro/particles/rearrange.hpp"

namespace hemoscale::micro {

namespace {

bool is_opening(ParticleKind kind) {
  return kind == ParticleKind::inlet || kind == ParticleKind::outlet;
}

// An opening needs two rows of nodes within the kernel radius, or its parabolas are not determined:
// rows at 1.25 and 2.25 spacings are the furthest.
constexpr double outlet_margin = 0.25;  // [-] spacings
constexpr double inlet_distance = 0.5;  // [-] spacings
constexpr double inlet_gap = 0.7;       // [-] spacings

/// Fluid nodes that have reached an outlet leave the set.
template <int dim>
std::size_t remove_leaving(FlowDomain<dim>& domain, double range) {
  ParticleSet<dim>& particles = domain.particles;
  NeighbourTable table;
  table.build<dim>(particles.positions, domain.box, range);
  std::vector<std::int32_t> staying;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    bool leaves = false;
    if (particles.kinds[i] == ParticleKind::fluid) {
      for (std::size_t k = table.begin(i); k < table.end(i); ++k) {
        const std::size_t j = table[k];
        if (particles.kinds[j] != ParticleKind::outlet) continue;
        const Vector<dim> r =
            separation(domain.box, particles.positions[i], particles.positions[j]);
        leaves = leaves || r.dot(particles.normals[j]) < outlet_margin * domain.spacing;
      }
    }
    if (!leaves) staying.push_back(static_cast<std::int32_t>(i));
  }
  const std::size_t removed = particles.size() - staying.size();
  if (removed > 0) rearrange(particles, staying);
  return removed;
}

/// Places at the inlets that are far from every node.
template <int dim>
std::vector<Vector<dim>> empty_places(const FlowDomain<dim>& domain) {
  const ParticleSet<dim>& particles = domain.particles;
  std::vector<Vector<dim>> all = particles.positions;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (particles.kinds[i] == ParticleKind::inlet) {
      all.push_back(particles.positions[i] -
                    inlet_distance * domain.spacing * particles.normals[i]);
    }
  }
  NeighbourTable table;
  table.build<dim>(all, domain.box, inlet_gap * domain.spacing);
  std::vector<Vector<dim>> places;
  std::vector<char> is_taken(all.size(), 0);
  for (std::size_t c = particles.size(); c < all.size(); ++c) {
    bool is_empty = true;
    for (std::size_t k = table.begin(c); k < table.end(c); ++k) {
      // Another candidate counts once it has been taken; the inlet node itself does not.
      const std::size_t j = table[k];
      const bool is_fluid = j < particles.size() && particles.kinds[j] == ParticleKind::fluid;
      if (is_fluid || is_taken[j] != 0) is_empty = false;
    }
    if (!is_empty) continue;
    is_taken[c] = 1;
    places.push_back(all[c]);
  }
  return places;
}

}  // namespace

template <int dim>
bool has_openings(const ParticleSet<dim>& particles) {
  for (const ParticleKind kind : particles.kinds) {
    if (is_opening(kind)) return true;
  }
  return false;
}

template <int dim>
ExchangeCount exchange_nodes(FlowDomain<dim>& domain, const LeastSquares& fit,
                             std::int64_t& next_identity) {
  ExchangeCount count;
  count.removed = remove_leaving(domain, fit.radius);
  const std::vector<Vector<dim>> places = empty_places(domain);
  if (places.empty()) return count;
  ParticleSet<dim>& particles = domain.particles;
  const auto flow = interpolate_flow<dim>(fit, particles.positions, domain.box,
                                          particles.velocities, particles.pressures, places);
  for (std::size_t k = 0; k < places.size(); ++k) {
    particles.append(places[k], next_identity++);
    particles.velocities.back() = flow[k].velocity;
    particles.pressures.back() = flow[k].pressure;
  }
  count.inserted = places.size();
  return count;
}

template bool has_openings<2>(const ParticleSet<2>&);
template bool has_openings<3>(const ParticleSet<3>&);
template ExchangeCount exchange_nodes<2>(FlowDomain<2>&, const LeastSquares&, std::int64_t&);
template ExchangeCount exchange_nodes<3>(FlowDomain<3>&, const LeastSquares&, std::int64_t&);

}  // namespace hemoscale::micro
