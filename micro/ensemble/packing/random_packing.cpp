#include "micro/ensemble/packing/random_packing.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <utility>

#include "micro/cells/outline_checks.hpp"
#include "micro/ensemble/blocks/block_ensemble.hpp"
#include "micro/ensemble/packing/area_fraction.hpp"
#include "micro/ensemble/packing/draws.hpp"
#include "micro/ensemble/packing/insertion.hpp"
#include "micro/ensemble/packing/state_checks.hpp"
#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

// Random insertion takes ever more attempts above this area fraction.
constexpr double inserted_fraction = 0.25;
// Approach of neighbours in a stroke over the rest distance of contacts; it is halved at most so
// often.
constexpr double first_stroke = 0.16;
constexpr int most_halvings = 5;
constexpr int steps_per_stroke = 5;
constexpr int strokes_between_looks = 6;
constexpr int settling_steps = 60;
// dt k / zeta of contacts: long enough to move cells apart at once, below 60 where the diagonal of
// the stiffness no longer keeps stacked contacts stable.
constexpr double contact_time = 25;
// Contacts are at most so stiff compared with a segment: softer ones relax whole cells faster.
constexpr double contact_over_segment = 0.05;
constexpr double skin = 0.2e-6;  // [m]

/// Fluid at rest.
class NoFlow final : public GivenFlow {
 public:
  LocalFlow at(const Vector<2>&, double) const override { return {}; }
  bool is_steady() const override { return true; }
  double largest_shear_rate() const override { return 0; }
  double largest_speed() const override { return 0; }
};

Box enlarged(const Box& box, double factor) {
  return {.length = box.length * factor, .height = box.height * factor, .walls = box.walls};
}

/// Moves every cell, without deforming it, as if its centre were glued to the box.
void move_centres(EnsembleState& state, double factor) {
  for (std::size_t cell = 0; cell < state.cells; ++cell) {
    const std::size_t first = cell * state.nodes;
    Vector<2> centre = Vector<2>::Zero();
    for (std::size_t i = first; i < first + state.nodes; ++i) {
      centre += Vector<2>(state.x[i], state.y[i]);
    }
    centre *= (factor - 1) / static_cast<double>(state.nodes);
    for (std::size_t i = first; i < first + state.nodes; ++i) {
      state.x[i] += centre.x();
      state.y[i] += centre.y();
    }
  }
}

blocks::BlockSettings relaxation(const RandomPacking& p) {
  blocks::BlockSettings s;
  s.kinds = {p.kind};
  PairPotential repulsion = p.contact;
  repulsion.attraction = 0;
  const double b = p.contact.cutoff_squared - p.contact.rest_squared;
  const double stiffness = 2 * p.contact.scale * p.contact.rest_squared * b * b;  // [Pa] at rest
  const double shortest =
      *std::min_element(p.kind.mesh.rest_length.begin(), p.kind.mesh.rest_length.end());
  const double used =
      std::min(stiffness, contact_over_segment * p.kind.laws.stretch.modulus / shortest);
  repulsion.scale *= used / stiffness;
  s.contact = repulsion;
  s.force = true;  // relaxation asks for stability, not for accuracy
  s.time_step = contact_time * p.kind.node_drag / used;
  s.flow = std::make_shared<NoFlow>();
  if (p.box.walls) s.plane_walls = p.wall;
  s.periodic_y = !p.box.walls;
  s.skin = skin;
  s.threads = p.threads;
  return s;
}

/// A state on the way, and how much smaller its box still has to become.
struct Stage {
  EnsembleState state;
  double dilation = 1;  // [-]
};

class Compactor {
 public:
  Compactor(const RandomPacking& packing, Stage start)
      : box_(packing.box), settings_(relaxation(packing)), sound_(std::move(start)) {}

  /// Compresses by so many strokes at most, each by a share of the size of the box, and keeps the
  /// result if no outlines cross.
  bool attempt(double share) {
    Stage trial = sound_;
    for (int k = 0; k < strokes_between_looks && trial.dilation > 1; ++k) {
      const double next = std::max(1.0, trial.dilation * (1 - share));
      move_centres(trial.state, next / trial.dilation);
      trial.dilation = next;
      if (!relax(trial, steps_per_stroke)) return false;
    }
    if (trial.dilation <= 1 && !relax(trial, settling_steps)) return false;
    const CellRoom room = room_of(enlarged(box_, trial.dilation));
    if (!overlaps(std::span(&trial.state, 1), room).empty()) return false;
    sound_ = std::move(trial);
    return true;
  }

  const Stage& sound() const { return sound_; }

 private:
  bool relax(Stage& stage, int steps) {
    const Box box = enlarged(box_, stage.dilation);
    settings_.length = box.length;
    settings_.height = box.height;
    try {
      BlockEnsemble ensemble(settings_, Precision::single, {stage.state});
      ensemble.advance(steps);
      stage.state = std::move(ensemble.states().front());
    } catch (const NumericalError&) {
      return false;  // cells were pushed into each other; shorter strokes will not do so
    }
    stage.state.time = 0;
    stage.state.step = 0;
    return true;
  }

  Box box_;
  blocks::BlockSettings settings_;
  Stage sound_;
};

void require_admissible(const RandomPacking& p) {
  const auto fault = [](const std::string& text) { throw ParameterError("packing: " + text); };
  if (p.cells < 1 || !(p.box.length > 0) || !(p.box.height > 0) || !std::isfinite(p.box.area())) {
    fault(
        fmt::format("{} cells in a box of {} m by {} m; at least one cell and finite positive "
                    "sizes are needed; correct them",
                    p.cells, p.box.length, p.box.height));
  }
  if (!(p.contact.scale > 0)) {
    fault(
        "cells without contact forces cannot be pressed together; give a contact stiffness for "
        "packing, and switch contacts off afterwards");
  }
  if (p.threads < 1) fault(fmt::format("{} threads; at least one is needed", p.threads));
  require_possible_fraction(p.cells, p.kind.mesh.rest_area, p.box);
}

Stage inserted(const RandomPacking& p, double fraction, std::uint64_t seed, std::uint64_t stream) {
  double radius = 0;
  for (const Vector<2>& node : p.outline) radius = std::max(radius, node.norm());
  Stage stage;
  stage.dilation = std::max(1.0, std::sqrt(fraction / inserted_fraction));
  const Box wide = enlarged(p.box, stage.dilation);
  Occupancy occupancy(room_of(wide),
                      {std::sqrt(p.contact.rest_squared), p.box.walls ? p.wall.range : 0},
                      2 * radius);
  Draws draws(seed, stream);
  stage.state =
      insert_at_random(occupancy, p.outline, p.cells, {0, wide.length, 0, wide.height}, draws);
  if (stage.state.cells < p.cells) {
    throw ParameterError(fmt::format(
        "packing: only {} of {} cells found a place in a box of {:.4g} m by {:.4g} m; use a longer "
        "or higher one, or a smaller contact rest distance",
        stage.state.cells, p.cells, wide.length, wide.height));
  }
  return stage;
}

}  // namespace

EnsembleState pack_at_random(const RandomPacking& packing, std::uint64_t seed,
                             std::uint64_t stream) {
  require_admissible(packing);
  const double area = packing.kind.mesh.rest_area;
  const double fraction = area_fraction(packing.cells, area, packing.box);
  const double rest_distance = std::sqrt(packing.contact.rest_squared);
  Compactor compactor(packing, inserted(packing, fraction, seed, stream));
  // Neighbours are about as far apart as cells of square shape.
  double share = first_stroke * rest_distance / std::sqrt(area / fraction);
  int halvings = 0;
  while (compactor.sound().dilation > 1) {
    if (compactor.attempt(share)) continue;
    if (++halvings > most_halvings) {
      const double layer = 0.5 * rest_distance * packing.kind.mesh.rest_perimeter;
      throw ParameterError(fmt::format(
          "packing: {}, {:.3g} with half the contact rest distance {:.3g} m around every cell; "
          "outlines cross beyond {:.3g}; lower the hematocrit or the contact rest distance, or {}",
          describe_fraction(packing.cells, area, packing.box), fraction * (1 + layer / area),
          rest_distance, fraction / std::pow(compactor.sound().dilation, 2),
          fraction_remedy(packing.cells, packing.box)));
    }
    share *= 0.5;
  }
  return compactor.sound().state;
}

}  // namespace hemoscale::micro
