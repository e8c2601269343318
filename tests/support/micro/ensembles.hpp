#pragma once

#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "micro/ensemble/ensemble_model.hpp"

namespace hemoscale::test {

/// Six coarse cells at 30 %: the cheapest box in which cells meet.
inline micro::EnsembleParameters small_ensemble() {
  micro::EnsembleParameters p;
  p.cells = 6;
  p.nodes = 24;
  p.hematocrit = 0.3;
  p.membrane.area_modulus = 20;
  p.contact = {.stiffness = 10, .rest_distance = 0.6e-6, .cutoff = 1e-6, .attraction = 0.05};
  return p;
}

/// One cell that meets nothing.
inline micro::EnsembleParameters lonely_cell() {
  micro::EnsembleParameters p = small_ensemble();
  p.cells = 1;
  p.hematocrit = 0.01;
  p.contact.stiffness = 0;
  return p;
}

inline micro::Forcing<2> shear(double rate, double hematocrit) {
  micro::Forcing<2> forcing;
  forcing.velocity_gradient(0, 1) = rate;
  forcing.hematocrit = hematocrit;
  return forcing;
}

/// Poiseuille flow in a channel.
inline micro::Forcing<2> poiseuille(double height, double velocity_at_axis, double hematocrit) {
  micro::Forcing<2> forcing = shear(0, hematocrit);
  micro::VelocityProfile profile;
  profile.height = height;
  for (int i = 0; i <= 20; ++i) {
    profile.velocities.push_back(velocity_at_axis * 4 * i * (20 - i) / 400);
  }
  forcing.profile = profile;
  return forcing;
}

/// Moves all nodes; the next homecoming brings the cells back into the box.
template <class Move>
void move_nodes(micro::EnsembleModel& model, const Move& move) {
  micro::Snapshot snapshot = model.snapshot();
  auto& x = snapshot.reals.at("ensemble.x");
  auto& y = snapshot.reals.at("ensemble.y");
  for (std::size_t i = 0; i < x.size(); ++i) {
    std::tie(x[i], y[i]) = move(i, x[i], y[i]);
  }
  model.restore(snapshot);
}

inline double deviation(const std::vector<micro::LedgerEntry>& ledger, const std::string& name) {
  for (const auto& entry : ledger) {
    if (entry.name == name) {
      return entry.deviation;
    }
  }
  throw std::runtime_error("no entry " + name);
}

}  // namespace hemoscale::test
