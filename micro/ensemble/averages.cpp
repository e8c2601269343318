#include "micro/ensemble/averages.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "micro/ensemble/interpenetration.hpp"
#include "micro/error.hpp"

namespace hemoscale::micro {

Tensor<2> particle_stress(const StepSums& sums, const Box& box) {
  return -(sums.membrane_virial + sums.contact_virial) / box.area();
}

ConservationLedger::ConservationLedger(const EnsembleSystem& system, const Box& box,
                                       std::int64_t interpenetration_interval)
    : system_(&system), box_(box), interval_(interpenetration_interval) {}

void ConservationLedger::record_shapes(const EnsembleState& state) {
  for (std::size_t cell = 0; cell < state.cells; ++cell) {
    const double* const x = state.x.data() + cell * state.nodes;
    const double* const y = state.y.data() + cell * state.nodes;
    double perimeter = 0;
    double area = 0;
    for (std::size_t k = 0; k < state.nodes; ++k) {
      const std::size_t next = k + 1 == state.nodes ? 0 : k + 1;
      const double dx = x[next] - x[k];
      const double dy = y[next] - y[k];
      perimeter += std::sqrt(dx * dx + dy * dy);
      area += 0.5 * ((x[k] - x[0]) * dy - (y[k] - y[0]) * dx);
    }
    area_ = std::max(area_, std::abs(area / system_->mesh.rest_area - 1));
    perimeter_ = std::max(perimeter_, std::abs(perimeter / system_->mesh.rest_perimeter - 1));
  }
  if (samples_++ % interval_ == 0 && system_->contact.scale > 0) {
    const auto inside = static_cast<double>(count_interpenetrating_nodes(state, box_));
    inside_ = std::max(inside_, inside / static_cast<double>(state.x.size()));
  }
}

void ConservationLedger::record_power(double before, double after, double power,
                                      double dissipation) {
  const double dt = system_->time_step;
  const double roundoff = 1e-13 * (std::abs(before) + std::abs(after));
  imbalance_ += std::max(0.0, std::abs(after - before - dt * (power - dissipation)) - roundoff);
  dissipated_ += dt * dissipation;
}

std::vector<LedgerEntry> ConservationLedger::entries() const {
  std::vector<LedgerEntry> result = {
      {.name = "area of the worst cell", .deviation = area_, .warn_above = 0.1, .stop_above = 0.5},
      {.name = "perimeter of the worst cell",
       .deviation = perimeter_,
       .warn_above = 0.1,
       .stop_above = 0.8},
      {.name = "nodes inside another cell",
       .deviation = inside_,
       .warn_above = 0,
       .stop_above = 0.05}};
  constexpr std::int64_t fewest_samples = 20;
  if (dissipated_ > 0 && samples_ >= fewest_samples) {
    result.push_back({.name = "power balance",
                      .deviation = imbalance_ / dissipated_,
                      .warn_above = 0.05,
                      .stop_above = 0.95});
  }
  return result;
}

void ConservationLedger::require_sound(const EnsembleState& state) const {
  for (const LedgerEntry& entry : entries()) {
    if (!(entry.deviation <= entry.stop_above)) {
      throw NumericalError(
          fmt::format("step {}, time {:.6g} s: the deviation of '{}' is {:.4g}; at most {:.4g} is "
                      "admitted; the time "
                      "step is {:.4g} s and its explicit limit {:.4g} s: {}",
                      state.step, state.time, entry.name, entry.deviation, entry.stop_above,
                      system_->time_step, system_->explicit_limit,
                      entry.name == "power balance" || system_->time_step > system_->explicit_limit
                          ? "reduce the time step"
                          : "stiffen membrane, area or contact, or lower the shear rate"));
    }
  }
}

}  // namespace hemoscale::micro
