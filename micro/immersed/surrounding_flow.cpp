#include "micro/immersed/surrounding_flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "micro/error.hpp"

namespace hemoscale::micro {

namespace {

void check_unbounded(const UnboundedFlow& flow) {
  if (!(flow.viscosity > 0) || !std::isfinite(flow.viscosity)) {
    throw ParameterError(
        fmt::format("the viscosity is {:g} Pa s; it must be positive and finite", flow.viscosity));
  }
  if (!flow.gradient.allFinite() || !flow.velocity.allFinite() ||
      std::abs(flow.gradient.trace()) > 1e-12 * flow.gradient.norm()) {
    throw ParameterError(
        "the velocity gradient must be finite and without trace: the plasma is incompressible");
  }
}

}  // namespace

Surroundings::Surroundings(Flow flow) : flow_(std::move(flow)) {
  if (const auto* unbounded = std::get_if<UnboundedFlow>(&flow_)) {
    check_unbounded(*unbounded);
    return;
  }
  const BoundedFlow& bounded = std::get<BoundedFlow>(flow_);
  const FlowDomain<2>& domain = bounded.nodes->domain();
  if (domain.box.periodic[1] || domain.sliding_rate != 0) {
    throw ParameterError(
        "cells need walls above and below, or unbounded flow; the domain is periodic across");
  }
  background_ = bounded.nodes->background(0);
  for (const Vector<2>& u : background_.velocities) fastest_ = std::max(fastest_, u.norm());
  if (!domain.box.periodic[0]) return;
  const double period = domain.box.extent()[0];
  kernel_ = PeriodicKernel{period};
  driving_pressure_ = bounded.nodes->fluid().density * body_acceleration(domain, 0)[0] * period;
  if (bounded.kept_flow_rate != 0) {
    drive_per_power_ = 1 / (driving_pressure_ * bounded.kept_flow_rate);
  }
}

const StokesNodes* Surroundings::nodes() const {
  const auto* bounded = std::get_if<BoundedFlow>(&flow_);
  return bounded == nullptr ? nullptr : bounded->nodes.get();
}

double Surroundings::viscosity() const {
  if (const auto* unbounded = std::get_if<UnboundedFlow>(&flow_)) return unbounded->viscosity;
  return nodes()->fluid().viscosity();
}

Surroundings::Places Surroundings::places(std::vector<Vector<2>> positions) const {
  Places places;
  places.positions = std::move(positions);
  places.flow.reserve(places.positions.size());
  if (const auto* unbounded = std::get_if<UnboundedFlow>(&flow_)) {
    for (const Vector<2>& x : places.positions) {
      places.flow.emplace_back(unbounded->velocity + unbounded->gradient * x);
    }
    return places;
  }
  places.weights = nodes()->sample(places.positions);
  for (std::size_t i = 0; i < places.positions.size(); ++i) {
    places.flow.push_back(places.weights.sample(i, background_.velocities));
  }
  return places;
}

double Surroundings::power_of(const RingSource& source) const {
  const RingSource::Points& ring = source.coarse();
  const Places here = places(ring.positions);
  double power = 0;
  for (std::size_t i = 0; i < ring.forces.size(); ++i) power += ring.forces[i].dot(here.flow[i]);
  const double contrast = 1 - source.viscosity_ratio();
  if (contrast == 0) return power;
  const std::vector<Tensor<2>> gradients = nodes()->gradients(ring.positions, background_);
  const double force = driving_pressure_ / nodes()->domain().box.extent()[0];  // [N/m^3]
  for (std::size_t i = 0; i < ring.forces.size(); ++i) {
    Tensor<2> stress = viscosity() * (gradients[i] + gradients[i].transpose());
    stress.diagonal().array() += force * (ring.positions[i].x() - ring.positions[0].x());
    power += contrast * ring.velocities[i].dot(stress * ring.normals[i]);
  }
  return power;
}

Surroundings::Reaction Surroundings::reaction(std::span<const RingSource> sources) const {
  Reaction reaction;
  if (!is_bounded()) return reaction;
  reaction.nodes = nodes()->reaction([&](const std::vector<Vector<2>>& places) {
    FlowValues sum{std::vector<Vector<2>>(places.size(), Vector<2>::Zero()),
                   std::vector<double>(places.size(), 0.0)};
    for (const RingSource& source : sources) {
      add_ring_flow(source, kernel_, viscosity(), places, sum);
    }
    return sum;
  });
  if (drive_per_power_ == 0) return reaction;
  for (const RingSource& source : sources) {
    reaction.extra_drive -= drive_per_power_ * power_of(source);
  }
  return reaction;
}

double Surroundings::extra_pressure_drop(const Reaction& reaction,
                                         std::span<const RingSource> sources) const {
  if (!is_bounded()) return 0;
  if (nodes()->domain().box.periodic[0]) return reaction.extra_drive * driving_pressure_;
  // The outlets hold their pressure and the inlet its velocity: the pressure at the inlet rises.
  const NodeGeometry<2>& all = nodes()->nodes();
  std::vector<Vector<2>> places;
  double sum = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all.kinds[i] != ParticleKind::inlet) continue;
    places.push_back(all.positions[i]);
    sum += reaction.nodes.pressures[i];
  }
  if (places.empty()) return 0;
  FlowValues rings{std::vector<Vector<2>>(places.size(), Vector<2>::Zero()),
                   std::vector<double>(places.size(), 0.0)};
  for (const RingSource& source : sources) {
    add_ring_flow(source, kernel_, viscosity(), places, rings);
  }
  for (const double p : rings.pressures) sum += p;
  return sum / static_cast<double>(places.size());
}

std::vector<Vector<2>> Surroundings::at(const Reaction& reaction, const Places& places) const {
  std::vector<Vector<2>> velocities(places.positions.size(), Vector<2>::Zero());
  if (!is_bounded()) return velocities;
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    velocities[i] =
        places.weights.sample(i, reaction.nodes.velocities) + reaction.extra_drive * places.flow[i];
  }
  return velocities;
}

}  // namespace hemoscale::micro
