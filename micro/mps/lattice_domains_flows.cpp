#include "micro/mps/lattice_domains_flows.hpp"

#include <cmath>
#include <numbers>

namespace hemoscale::micro {

namespace {

PeriodicBox<2> channel_box(double from, double to, double gap, bool is_joined) {
  return {.lower = {from, 0}, .upper = {to, gap}, .periodic = {is_joined, false}};
}

Region<2> between_plates(double gap) {
  return [gap](const Vector<2>& x) { return x.y() > 0 && x.y() < gap; };
}

template <int dim>
bool is_fluid(const ParticleSet<dim>& particles, std::size_t i) {
  return particles.kinds[i] == ParticleKind::fluid;
}

}  // namespace

FlowDomain<2> lattice_periodic_channel(const Lattice& lattice, double length, double gap,
                                       double acceleration) {
  FlowDomain<2> domain =
      lattice_around<2>(lattice, channel_box(0, length, gap, true), between_plates(gap));
  domain.acceleration = [acceleration](double) { return Vector<2>(acceleration, 0); };
  return domain;
}

FlowDomain<2> lattice_couette(const Lattice& lattice, double length, double gap, double speed) {
  FlowDomain<2> domain =
      lattice_around<2>(lattice, channel_box(0, length, gap, true), between_plates(gap));
  domain.patches.push_back(
      {.name = "moving wall",
       .kind = ParticleKind::wall,
       .velocity = [speed](const Vector<2>&, double) { return Vector<2>(speed, 0); }});
  for (std::size_t i = 0; i < domain.particles.size(); ++i) {
    if (!is_fluid(domain.particles, i) && domain.particles.positions[i].y() > gap) {
      domain.particles.patches[i] = 1;
    }
  }
  return domain;
}

Inflow uniform_inflow(double speed) {
  return [speed](const Vector<2>&, double) { return Vector<2>(speed, 0); };
}

Inflow parabolic_inflow(double mean_speed, double gap) {
  return [mean_speed, gap](const Vector<2>& x, double) {
    const double s = x.y() / gap;
    return Vector<2>(6 * mean_speed * s * (1 - s), 0);
  };
}

FlowDomain<2> lattice_open_channel(const Lattice& lattice, double length, double gap,
                                   const Inflow& inflow) {
  // Inlet and outlet are as long as the kernels reach; the fluid then has all its neighbours.
  const double reach = lattice.wall_layers * lattice.spacing;
  Lattice even = lattice;
  even.disorder = 0;
  FlowDomain<2> all =
      lattice_around<2>(even, channel_box(-reach, length, gap, false), between_plates(gap));
  FlowDomain<2> domain = all;
  domain.particles = {};
  domain.patches.push_back({.name = "inlet", .kind = ParticleKind::inlet, .velocity = inflow});
  domain.patches.push_back({.name = "outlet", .kind = ParticleKind::outlet});
  for (std::size_t i = 0; i < all.particles.size(); ++i) {
    const Vector<2>& x = all.particles.positions[i];
    if (x.x() < -reach || x.x() > length) continue;  // nothing lies beyond the openings
    const auto identity = static_cast<std::int64_t>(domain.particles.size());
    if (!is_fluid(all.particles, i)) {
      // Walls beside the inlet layers have no pressure but next to the plane, as those layers.
      const bool is_behind = x.x() < -lattice.spacing;
      const ParticleKind kind = is_behind ? ParticleKind::dummy : all.particles.kinds[i];
      domain.particles.append(x, identity, kind, 0, all.particles.normals[i]);
    } else if (x.x() < 0) {
      domain.particles.append(x, identity, ParticleKind::inlet, 1, Vector<2>(-1, 0));
    } else if (x.x() > length - reach) {
      domain.particles.append(x, identity, ParticleKind::outlet, 2, Vector<2>(1, 0));
    } else {
      domain.particles.append(x, identity);
    }
    if (is_fluid(all.particles, i)) domain.particles.velocities.back() = inflow(x, 0);
  }
  disturb(lattice, domain.particles);
  return domain;
}

template <int dim>
FlowDomain<dim> lattice_taylor_green(const Lattice& lattice, double length, double speed) {
  PeriodicBox<dim> box;
  box.upper = Vector<dim>::Constant(length);
  box.periodic.fill(true);
  FlowDomain<dim> domain =
      lattice_around<dim>(lattice, box, [](const Vector<dim>&) { return true; });
  const double k = 2 * std::numbers::pi / length;
  for (std::size_t i = 0; i < domain.particles.size(); ++i) {
    const Vector<dim>& x = domain.particles.positions[i];
    double depth = 1;
    if constexpr (dim == 3) depth = std::cos(k * x[2]);
    domain.particles.velocities[i][0] = speed * std::sin(k * x[0]) * std::cos(k * x[1]) * depth;
    domain.particles.velocities[i][1] = -speed * std::cos(k * x[0]) * std::sin(k * x[1]) * depth;
  }
  return domain;
}

FlowDomain<2> lattice_tank(const Lattice& lattice, double width, double height, double gravity) {
  const double above = lattice.wall_layers * lattice.spacing;
  const PeriodicBox<2> box = {.lower = {0, 0}, .upper = {width, height + above}};
  FlowDomain<2> domain = lattice_around<2>(
      lattice, box, [width](const Vector<2>& x) { return x.x() > 0 && x.x() < width && x.y() > 0; },
      [height](const Vector<2>& x) { return x.y() < height; });
  domain.acceleration = [gravity](double) { return Vector<2>(0, -gravity); };
  return domain;
}

FlowDomain<2> lattice_rotating_square(const Lattice& lattice, double side, double rate) {
  const PeriodicBox<2> box = {.lower = {-side, -side}, .upper = {side, side}};
  FlowDomain<2> domain = lattice_around<2>(
      lattice, box, [](const Vector<2>&) { return true; },
      [side](const Vector<2>& x) { return x.cwiseAbs().maxCoeff() < side / 2; });
  for (std::size_t i = 0; i < domain.particles.size(); ++i) {
    const Vector<2>& x = domain.particles.positions[i];
    domain.particles.velocities[i] = rate * Vector<2>(-x.y(), x.x());
  }
  return domain;
}

template FlowDomain<2> lattice_taylor_green<2>(const Lattice&, double, double);
template FlowDomain<3> lattice_taylor_green<3>(const Lattice&, double, double);

}  // namespace hemoscale::micro
