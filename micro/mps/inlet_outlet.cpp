#include "micro/mps/inlet_outlet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>

#include "micro/error.hpp"
#include "micro/particles/rearrange.hpp"

namespace hemoscale::micro {

namespace {

struct Extent {
  double least = std::numeric_limits<double>::infinity();
  double most = -std::numeric_limits<double>::infinity();
};

/// Extent along the normal of the particles of one kind, patch by patch.
template <int dim>
std::map<std::int32_t, std::pair<Vector<dim>, Extent>> extents(const ParticleSet<dim>& particles,
                                                               ParticleKind kind) {
  std::map<std::int32_t, std::pair<Vector<dim>, Extent>> found;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (particles.kinds[i] != kind) continue;
    auto& [normal, extent] =
        found.try_emplace(particles.patches[i], particles.normals[i], Extent{}).first->second;
    if ((normal - particles.normals[i]).norm() > 1e-12) {
      throw ParameterError(fmt::format(
          "patch {}: particle {} has another normal than those before; the openings of the "
          "semi-implicit stepper are planes; make a patch of each",
          particles.patches[i], i));
    }
    const double along = normal.dot(particles.positions[i]);
    extent.least = std::min(extent.least, along);
    extent.most = std::max(extent.most, along);
  }
  return found;
}

bool is_moving(ParticleKind kind) {
  return kind == ParticleKind::fluid || kind == ParticleKind::surface ||
         kind == ParticleKind::outlet;
}

template <int dim>
void become(ParticleSet<dim>& particles, std::size_t i, ParticleKind kind, std::int32_t patch,
            const Vector<dim>& normal) {
  particles.kinds[i] = kind;
  particles.patches[i] = patch;
  particles.normals[i] = normal;
}

template <int dim>
void enter(const Inlet<dim>& inlet, ParticleSet<dim>& particles, std::vector<double>& depths,
           ParticleLedger& ledger) {
  const std::size_t count = particles.size();
  for (std::size_t i = 0; i < count; ++i) {
    if (particles.kinds[i] != ParticleKind::inlet || particles.patches[i] != inlet.patch) continue;
    if (inlet.normal.dot(particles.positions[i]) > inlet.plane) continue;
    const Vector<dim> tail = particles.positions[i] + inlet.depth * inlet.normal;
    particles.append(tail, ledger.next_identity++, ParticleKind::inlet, inlet.patch, inlet.normal);
    particles.velocities.back() = particles.velocities[i];
    depths.push_back(0);
    become<dim>(particles, i, ParticleKind::fluid, -1, Vector<dim>::Zero());
    ++ledger.entered;
  }
}

template <int dim>
bool approach(const Outlet<dim>& outlet, ParticleSet<dim>& particles) {
  bool has_changed = false;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const bool is_beyond = outlet.normal.dot(particles.positions[i]) > outlet.edge;
    const ParticleKind kind = particles.kinds[i];
    if (is_beyond && (kind == ParticleKind::fluid || kind == ParticleKind::surface)) {
      if (particles.patches[i] >= 0) {
        const Vector<dim>& x = particles.positions[i];
        throw NumericalError(fmt::format(
            "particle {} of a membrane (patch {}) has come to {:.6g} m along the outlet, whose "
            "zone "
            "begins at {:.6g} m; end the run before, or lengthen the channel",
            particles.identities[i], particles.patches[i], outlet.normal.dot(x), outlet.edge));
      }
      become(particles, i, ParticleKind::outlet, outlet.patch, outlet.normal);
      has_changed = true;
    } else if (!is_beyond && kind == ParticleKind::outlet && particles.patches[i] == outlet.patch) {
      become<dim>(particles, i, ParticleKind::fluid, -1, Vector<dim>::Zero());
      has_changed = true;
    }
  }
  return has_changed;
}

/// Particles that stay, in order.
template <int dim>
std::vector<std::int32_t> staying(const Openings<dim>& openings,
                                  const ParticleSet<dim>& particles) {
  std::vector<std::int32_t> order;
  order.reserve(particles.size());
  for (std::size_t i = 0; i < particles.size(); ++i) {
    bool leaves = false;
    for (const Outlet<dim>& outlet : openings.outlets) {
      leaves = leaves || (particles.kinds[i] == ParticleKind::outlet &&
                          particles.patches[i] == outlet.patch &&
                          outlet.normal.dot(particles.positions[i]) > outlet.plane);
    }
    if (!leaves) order.push_back(static_cast<std::int32_t>(i));
  }
  return order;
}

}  // namespace

template <int dim>
std::int64_t count_moving(const ParticleSet<dim>& particles) {
  return std::count_if(particles.kinds.begin(), particles.kinds.end(), is_moving);
}

template <int dim>
Openings<dim> find_openings(const FlowDomain<dim>& domain) {
  Openings<dim> openings;
  const double half = domain.spacing / 2;
  for (const auto& [patch, found] : extents(domain.particles, ParticleKind::inlet)) {
    const auto& [normal, extent] = found;
    openings.inlets.push_back({.patch = patch,
                               .normal = normal,
                               .plane = extent.least - half,
                               .depth = extent.most - extent.least + domain.spacing});
  }
  for (const auto& [patch, found] : extents(domain.particles, ParticleKind::outlet)) {
    const auto& [normal, extent] = found;
    openings.outlets.push_back({.patch = patch,
                                .normal = normal,
                                .edge = extent.least - half,
                                .plane = extent.most + half});
  }
  return openings;
}

template <int dim>
bool pass_openings(const Openings<dim>& openings, ParticleSet<dim>& particles,
                   std::vector<double>& depths, ParticleLedger& ledger) {
  const std::size_t before = particles.size();
  for (const Inlet<dim>& inlet : openings.inlets) enter(inlet, particles, depths, ledger);
  bool has_changed = particles.size() != before;
  for (const Outlet<dim>& outlet : openings.outlets) {
    has_changed = approach(outlet, particles) || has_changed;
  }
  const std::vector<std::int32_t> order = staying(openings, particles);
  if (order.size() != particles.size()) {
    ledger.left += static_cast<std::int64_t>(particles.size() - order.size());
    rearrange(particles, order);
    rearrange(depths, order);
    has_changed = true;
  }
  return has_changed;
}

#define HEMOSCALE_INSTANTIATE(dim)                                                                \
  template std::int64_t count_moving<dim>(const ParticleSet<dim>&);                               \
  template Openings<dim> find_openings<dim>(const FlowDomain<dim>&);                              \
  template bool pass_openings<dim>(const Openings<dim>&, ParticleSet<dim>&, std::vector<double>&, \
                                   ParticleLedger&);
HEMOSCALE_INSTANTIATE(2)
HEMOSCALE_INSTANTIATE(3)
#undef HEMOSCALE_INSTANTIATE

}  // namespace hemoscale::micro
