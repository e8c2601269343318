#include "micro/ensemble/blocks/block_limits.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <variant>

#include "micro/ensemble/blocks/chebyshev_weights.hpp"
#include "micro/ensemble/step_limit.hpp"
#include "micro/error.hpp"

namespace hemoscale::micro::blocks {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

// dt k / zeta from which nodes tremble at the edge of what pushes them, as measured, with a margin.
constexpr double most_contact_times = 60;
constexpr double most_wall_times = 100;

double quotient(double numerator, double denominator) {
  return denominator > 0 ? numerator / denominator : infinite;
}

MembraneParameters parameters_of(const MembraneLaws& laws) {
  MembraneParameters p;
  p.stretch_modulus = laws.stretch.modulus;
  p.area_modulus = laws.area.modulus;
  if (const auto* half_angle = std::get_if<HalfAngleBending>(&laws.bending)) {
    p.bending_law = BendingLaw::half_angle_tangent;
    p.bending_modulus = half_angle->modulus;
  } else {
    p.bending_law = BendingLaw::turning_angle;
    p.bending_modulus = std::get<TurningAngleBending>(laws.bending).modulus;
  }
  return p;
}

double radius_of(const RingMesh& mesh) {
  return mesh.rest_perimeter / (2 * std::numbers::pi);
}

/// Root of dt K/zeta + 4 k U/zeta = 2 coth(dt zeta / (2 m)) by bisection: the left side grows with
/// the step, the right side falls.
double inertial_step(const BlockLimit& limit, const KindSettings& kind, double velocity) {
  const double stiffness = limit.ring + limit.contact + limit.wall;
  const double excess = 4 * kind.momentum_drag * velocity / limit.drag;
  const auto is_stable = [&](double dt) {
    return dt * stiffness / limit.drag + excess <=
           2 / std::tanh(0.5 * dt * limit.drag / kind.node_mass);
  };
  double stable = 0;
  double beyond = std::max(4 * limit.drag / stiffness, 4 * std::sqrt(kind.node_mass / stiffness));
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (stable + beyond);
    (is_stable(middle) ? stable : beyond) = middle;
  }
  return stable;
}

void restrict(BlockLimit& limit, double step, const std::string& because) {
  if (step < limit.time_step) {
    limit.time_step = step;
    limit.because = because;
  }
}

BlockLimit limit_of(const BlockSettings& s, const KindSettings& kind) {
  BlockLimit limit;
  limit.time_step = infinite;
  limit.drag = kind.node_drag * std::min(1.0, kind.normal_drag);
  limit.ring = ring_stiffness(kind.mesh, kind.mesh, parameters_of(kind.laws));
  limit.contact = contact_stiffness(s.contact, kind.mesh.rest_perimeter / kind.mesh.nodes);
  if (s.plane_walls) limit.wall = s.plane_walls->stiffness;
  if (s.geometry) limit.wall = std::max(limit.wall, s.geometry_wall.stiffness);
  const double all = limit.ring + limit.contact + limit.wall;
  const double rate = s.flow->largest_shear_rate();
  const std::string parts = fmt::format(
      "node drag {:.4g} Pa s, stiffness of membrane {:.4g} Pa, contacts {:.4g} Pa, walls "
      "{:.4g} Pa",
      limit.drag, limit.ring, limit.contact, limit.wall);
  switch (s.integrator) {
    case Integrator::explicit_euler:
      restrict(limit, 2 * limit.drag / all, "explicit limit 2 drag / stiffness, " + parts);
      break;
    case Integrator::inertial:
      restrict(limit, inertial_step(limit, kind, rate * radius_of(kind.mesh)),
               fmt::format("limit of nodes with a mass of {:.4g} kg/m, {}", kind.node_mass, parts));
      break;
    case Integrator::chebyshev:
      restrict(limit, chebyshev_reach(s.stages) * limit.drag / (limit.ring + limit.wall),
               fmt::format("limit of {} stages, {}", s.stages, parts));
      restrict(limit, quotient(2 * limit.drag, limit.contact),
               "limit 2 drag / stiffness of contacts, which are frozen within a step, " + parts);
      break;
    case Integrator::constant_operator:
    case Integrator::constant_operator_second_order:
      restrict(limit, quotient(most_wall_times * limit.drag, limit.wall),
               fmt::format("limit {} drag / stiffness of walls, beyond which nodes tremble, {}",
                           most_wall_times, parts));
      [[fallthrough]];
    case Integrator::linearly_implicit:
      restrict(limit, quotient(most_contact_times * limit.drag, stiffness_at_rest(s.contact)),
               fmt::format("limit {} drag / stiffness of contacts at rest, {:.4g} Pa, beyond which "
                           "nodes tremble, {}",
                           most_contact_times, stiffness_at_rest(s.contact), parts));
      break;
  }
  const double gap = cutoff_of(s.contact) - rest_distance_of(s.contact);
  restrict(
      limit, quotient(gap, rate * 2 * radius_of(kind.mesh)),
      fmt::format("in a step the shear of {:.4g} 1/s moves cells past each other by more than the "
                  "range of contacts, {:.4g} m",
                  rate, gap));
  if (s.migration.wall_lift && s.plane_walls) {
    restrict(limit, quotient(std::pow(s.plane_walls->range, 3), s.migration.wall_lift->coefficient),
             fmt::format("limit range^3 / k of the wall lift of {:.4g} m^3/s",
                         s.migration.wall_lift->coefficient));
  }
  return limit;
}

}  // namespace

BlockLimit block_limit(const BlockSettings& settings) {
  BlockLimit strictest;
  strictest.time_step = infinite;
  for (const KindSettings& kind : settings.kinds) {
    const BlockLimit limit = limit_of(settings, kind);
    if (limit.time_step <= strictest.time_step) strictest = limit;
  }
  return strictest;
}

double default_step(const GivenFlow& flow) {
  return quotient(3e-4, flow.largest_shear_rate());
}

double smallest_single_step(const GivenFlow& flow) {
  return quotient(6e-5, flow.largest_shear_rate());
}

std::string step_fault(const BlockSettings& settings) {
  const BlockLimit limit = block_limit(settings);
  if (settings.time_step <= limit.time_step) return {};
  return fmt::format(
      "block ensemble: time step {:.4g} s exceeds {:.4g} s: {}; reduce the time step, choose an "
      "implicit integrator if this one is explicit, or force the run",
      settings.time_step, limit.time_step, limit.because);
}

std::string single_precision_fault(const BlockSettings& settings) {
  const double least = smallest_single_step(*settings.flow);
  if (settings.integrator != Integrator::inertial || settings.time_step >= least) return {};
  return fmt::format(
      "block ensemble: time step {:.4g} s of nodes with mass in single precision; rounding moves "
      "them by more than a thousandth of their motion below {:.4g} s; choose double precision",
      settings.time_step, least);
}

void require_step(const BlockSettings& settings, bool force) {
  const std::string fault = force ? std::string() : step_fault(settings);
  if (!fault.empty()) throw ParameterError(fault);
}

}  // namespace hemoscale::micro::blocks
