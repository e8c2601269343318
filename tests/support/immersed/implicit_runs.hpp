#pragma once

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "micro/cells/curve_distance.hpp"
#include "micro/cells/rest_shape.hpp"
#include "micro/cells/ring_motion.hpp"
#include "micro/cells/ring_shape.hpp"
#include "micro/cells/ring_strain.hpp"
#include "micro/immersed/implicit_membranes.hpp"
#include "micro/immersed/membrane_flow.hpp"
#include "micro/mps/node_domains.hpp"

// Cells for the implicit coupling, what surrounds them, and what is seen of them.
namespace hemoscale::micro::test {

inline constexpr double micron = 1e-6;
inline constexpr Fluid water{.density = 1000, .kinematic_viscosity = 1e-6};

/// Perimeter of the cells of cases/capillary-red-cell/reference.
inline constexpr double reference_perimeter = 2 * std::numbers::pi * 2.95e-6;

struct CellPlan {
  double reduced_area = 0.70;
  int nodes = 59;
  double stretch_modulus = 0;  // [N/m] 0: inextensible
  double bending_modulus = 0;  // [J]
  double viscosity_ratio = 1;
  double perimeter = reference_perimeter;
  double angle = std::numbers::pi / 2;  // of the long axis
  Vector<2> centre = Vector<2>::Zero();
};

inline Cell cell_of(const std::vector<Vector<2>>& outline, const CellPlan& plan) {
  MembraneParameters p{.stretch_modulus = plan.stretch_modulus,
                       .bending_modulus = plan.bending_modulus,
                       .natural_shape = NaturalShape::flat,
                       .area_law = AreaLaw::exact};
  if (plan.stretch_modulus == 0) p.stretch_law = StretchLaw::inextensible;
  Cell cell;
  cell.membrane = std::make_shared<RingMembrane>(make_ring_mesh(outline, NaturalShape::flat), p);
  cell.viscosity_ratio = plan.viscosity_ratio;
  const double c = std::cos(plan.angle);
  const double s = std::sin(plan.angle);
  for (const Vector<2>& x : outline) {
    cell.positions.push_back(plan.centre + Vector<2>(c * x.x() - s * x.y(), s * x.x() + c * x.y()));
  }
  return cell;
}

/// A cell at its rest shape; its bending vanishes on a flat membrane, as in the references.
inline Cell deflated_cell(const CellPlan& plan) {
  return cell_of(
      deflate({.perimeter = plan.perimeter, .reduced_area = plan.reduced_area}, plan.nodes).nodes,
      plan);
}

inline std::vector<Vector<2>> circle(double radius, int nodes) {
  std::vector<Vector<2>> outline;
  for (int i = 0; i < nodes; ++i) {
    const double angle = 2 * std::numbers::pi * i / nodes;
    outline.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return outline;
}

inline StageOptions stokes_options() {
  StageOptions options;
  options.inertia = Inertia::quasi_steady;
  return options;
}

/// Plane channel joined at its ends, whose mean velocity is kept.
inline std::shared_ptr<const Surroundings> kept_channel(double length, double height,
                                                        double spacing, double speed,
                                                        bool is_kept = true) {
  FlowDomain<2> domain = channel_nodes(length, height, true, {.spacing = spacing});
  const double force = 12 * water.kinematic_viscosity * speed / (height * height);
  domain.acceleration = [force](double) { return Vector<2>(force, 0); };
  return std::make_shared<Surroundings>(
      BoundedFlow{std::make_shared<StokesNodes>(std::move(domain), water, stokes_options()),
                  is_kept ? speed * height : 0});
}

/// Gives the inlet the developed profile of a mean velocity.
inline void give_inlet(FlowDomain<2>& domain, double height, double speed) {
  domain.patches[inlet_patch].velocity = [=](const Vector<2>& x, double) {
    const double s = x.y() / height;
    return Vector<2>(6 * speed * s * (1 - s), 0);
  };
}

inline std::shared_ptr<const Surroundings> around(FlowDomain<2> domain) {
  return std::make_shared<Surroundings>(
      BoundedFlow{std::make_shared<StokesNodes>(std::move(domain), water, stokes_options()), 0});
}

inline std::shared_ptr<const Surroundings> open_channel(double length, double height,
                                                        double spacing, double speed) {
  FlowDomain<2> domain = channel_nodes(length, height, false, {.spacing = spacing});
  give_inlet(domain, height, speed);
  return around(std::move(domain));
}

inline std::shared_ptr<const Surroundings> shear(double rate) {
  UnboundedFlow flow{.viscosity = water.viscosity()};
  flow.gradient(0, 1) = rate;
  return std::make_shared<Surroundings>(flow);
}

/// What is seen of one cell.
struct Seen {
  RingShape shape;
  RingMotion motion;
  RingStrain strain;
};

inline Seen look_at(const ImplicitMembranes& membranes, std::size_t cell = 0) {
  const Cell& c = membranes.cells()[cell];
  const RingCurve curve(c.positions);
  return {measure_shape(curve), measure_motion(curve, RingCurve(c.velocities)),
          measure_strain(c.positions, c.membrane->mesh())};
}

/// Distance along x from the rearmost membrane to that on the axis; the flow is along x.
inline double dimple(const RingCurve& curve, double axis) {
  double rearmost = std::numeric_limits<double>::infinity();
  double on_axis = rearmost;
  const auto n = static_cast<double>(curve.segments());
  Vector<2> last = curve.position(0);
  for (double s = 0.01; s < n + 0.005; s += 0.01) {
    const Vector<2> x = curve.position(s);
    rearmost = std::min(rearmost, x.x());
    if ((x.y() - axis) * (last.y() - axis) <= 0) on_axis = std::min(on_axis, x.x());
    last = x;
  }
  return on_axis - rearmost;
}

/// The slope of log(error) over log(step) of three solutions whose step halves.
inline double halving_order(double coarse, double middle, double fine) {
  return std::log2(std::abs((coarse - middle) / (middle - fine)));
}

}  // namespace hemoscale::micro::test
