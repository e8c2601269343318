#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

#include "micro/ensemble/ensemble_model.hpp"
#include "micro/ensemble/observables/observer.hpp"
#include "micro/ensemble/step_limit.hpp"
#include "micro/ensemble/system.hpp"

namespace hemoscale::test {

/// A flow u(y) along x with any lateral component; of the expansion only the velocity is given.
class PlainFlow final : public micro::GivenFlow {
 public:
  using Law = std::function<micro::Vector<2>(const micro::Vector<2>&)>;
  explicit PlainFlow(Law law) : law_(std::move(law)) {}

  micro::LocalFlow at(const micro::Vector<2>& x, double) const override {
    micro::LocalFlow flow;
    flow.velocity = law_(x);
    return flow;
  }
  bool is_steady() const override { return true; }
  double largest_shear_rate() const override { return 0; }
  double largest_speed() const override { return 0; }

 private:
  Law law_;
};

inline PlainFlow uniform_flow(double speed) {
  return PlainFlow([=](const micro::Vector<2>&) { return micro::Vector<2>(speed, 0); });
}

inline PlainFlow parabolic_flow(double height, double velocity_at_axis) {
  return PlainFlow([=](const micro::Vector<2>& x) {
    const double s = x.y() / height;
    return micro::Vector<2>(4 * velocity_at_axis * s * (1 - s), 0);
  });
}

/// Semi-axes a along the inclination and b across it.
struct Ellipse {
  micro::Vector<2> centre;
  double a = 0, b = 0, inclination = 0;
};

inline micro::EnsembleState ellipses(const std::vector<Ellipse>& list, std::size_t nodes) {
  micro::EnsembleState state;
  state.cells = list.size();
  state.nodes = nodes;
  for (const Ellipse& e : list) {
    for (std::size_t k = 0; k < nodes; ++k) {
      const double angle =
          2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(nodes);
      const double along = e.a * std::cos(angle);
      const double across = e.b * std::sin(angle);
      const double c = std::cos(e.inclination);
      const double s = std::sin(e.inclination);
      state.x.push_back(e.centre.x() + c * along - s * across);
      state.y.push_back(e.centre.y() + s * along + c * across);
    }
  }
  return state;
}

/// Area of a regular polygon in the ellipse, mapped with it.
inline double polygon_area(const Ellipse& e, std::size_t nodes) {
  const auto n = static_cast<double>(nodes);
  return 0.5 * n * std::sin(2 * std::numbers::pi / n) * e.a * e.b;
}

inline micro::EnsembleState rectangles(const std::vector<micro::Vector<2>>& corners, double width,
                                       double height) {
  micro::EnsembleState state;
  state.cells = corners.size();
  state.nodes = 4;
  for (const micro::Vector<2>& corner : corners) {
    for (const auto& [a, b] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}) {
      state.x.push_back(corner.x() + a * width);
      state.y.push_back(corner.y() + b * height);
    }
  }
  return state;
}

/// The laws of a reference model, for the forces on its states.
inline micro::EnsembleSystem system_of(const micro::EnsembleParameters& p) {
  const auto outline = micro::outline_nodes(p.outline, p.nodes);
  const micro::StepLimit limit = micro::step_limit(p);
  micro::EnsembleSystem system;
  system.mesh = micro::make_ring_mesh(outline, p.membrane.natural_shape);
  system.laws = micro::make_membrane_laws(p.membrane);
  system.contact = micro::make_pair_potential(p.contact.stiffness, p.contact.rest_distance,
                                              p.contact.cutoff, p.contact.attraction);
  system.wall = {.stiffness = p.wall.stiffness, .range = p.wall.range};
  system.node_drag = limit.drag;
  system.time_step = 0.8 * limit.time_step;
  system.explicit_limit = limit.time_step;
  system.segment_strain_limit = p.segment_strain_limit;
  return system;
}

inline micro::EnsembleState state_of(const micro::EnsembleModel& model,
                                     const micro::EnsembleParameters& p) {
  const micro::Snapshot snapshot = model.snapshot();
  micro::EnsembleState state;
  state.cells = static_cast<std::size_t>(p.cells);
  state.nodes = static_cast<std::size_t>(p.nodes);
  state.x = snapshot.reals.at("ensemble.x");
  state.y = snapshot.reals.at("ensemble.y");
  state.time = snapshot.reals.at("ensemble.time").front();
  return state;
}

inline micro::Box box_of(const micro::EnsembleModel& model) {
  const micro::EnsembleFrame frame = model.frame();
  return {.length = frame.length, .height = frame.height, .walls = frame.walls};
}

inline micro::ObservedKind kind_of(const micro::EnsembleSystem& system) {
  return {.name = "red cells",
          .rest_area = system.mesh.rest_area,
          .rest_perimeter = system.mesh.rest_perimeter,
          .node_drag = system.node_drag,
          .law = micro::make_pair_law(system.contact)};
}

/// No contacts.
inline micro::PairLaw no_contacts() {
  return {.force_over_distance = [](double) { return 0.0; }, .rest_distance = 0, .cutoff = 0};
}

}  // namespace hemoscale::test
