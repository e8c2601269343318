#include "micro/ensemble/flow/inflow_queue.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "micro/error.hpp"
#include "micro/random/philox.hpp"

namespace hemoscale::micro {
namespace {

constexpr std::size_t fewest_panels = 256;  // of the density across an opening

/// A panel of the opening: the density of centres is linear between its ends.
struct Panel {
  double begin = 0, end = 0;        // [m] along the opening
  double at_begin = 0, at_end = 0;  // [m/s]
  double mass() const { return 0.5 * (at_begin + at_end) * (end - begin); }
};

/// Where the integral of a linear density reaches a mass.
double place_in(const Panel& panel, double mass) {
  const double width = panel.end - panel.begin;
  const double slope = (panel.at_end - panel.at_begin) / width;
  // at_begin s + slope s^2 / 2 = mass, written without cancellation.
  const double root = std::sqrt(std::max(0.0, panel.at_begin * panel.at_begin + 2 * slope * mass));
  const double sum = panel.at_begin + root;
  const double s = sum > 0 ? 2 * mass / sum : 0;
  return panel.begin + std::min(s, width);
}

void check(const Feed& feed, const Opening& opening) {
  if (!(feed.hematocrit >= 0 && feed.hematocrit < 1)) {
    throw ParameterError(
        fmt::format("feed of opening {}: hematocrit {}; it must be at least 0 and below 1; correct "
                    "it",
                    opening.name, feed.hematocrit));
  }
  if (!(feed.clearance >= 0 && 2 * feed.clearance < opening.length())) {
    throw ParameterError(fmt::format(
        "feed of opening {}: clearance {} m on either side of an opening of {} m leaves "
        "no place for centres; reduce it",
        opening.name, feed.clearance, opening.length()));
  }
  double sum = 0;
  for (const double share : feed.profile) {
    if (!(share >= 0) || !std::isfinite(share)) {
      throw ParameterError(
          fmt::format("feed of opening {}: the profile has the value {}; concentrations must be "
                      "finite and not negative; correct it",
                      opening.name, share));
    }
    sum += share;
  }
  if (!feed.profile.empty() && !(sum > 0)) {
    throw ParameterError(
        fmt::format("feed of opening {}: the profile is zero throughout; give a positive value, or "
                    "leave it out for a uniform feed",
                    opening.name));
  }
}

}  // namespace

InflowQueue::InflowQueue(const Opening& opening, const Feed& feed,
                         std::shared_ptr<const GivenFlow> flow, std::uint64_t seed,
                         std::uint64_t stream)
    : opening_(opening), feed_(feed), flow_(std::move(flow)), seed_(seed), stream_(stream) {
  micro::check(opening_);
  check(feed_, opening_);
  if (flow_->is_steady()) steady_rate_ = feed_.hematocrit * inflow_flux(opening_, *flow_, 0);
}

double InflowQueue::area_rate(double time) const {
  return flow_->is_steady() ? steady_rate_ : feed_.hematocrit * inflow_flux(opening_, *flow_, time);
}

void InflowQueue::advance(double time, double dt) {
  if (flow_->is_steady()) {
    state_.area += steady_rate_ * dt;
    return;
  }
  state_.area += dt / 6 * (area_rate(time) + 4 * area_rate(time + 0.5 * dt) + area_rate(time + dt));
}

std::uint64_t InflowQueue::due(double cell_area) const {
  return static_cast<std::uint64_t>(state_.area / cell_area);
}

Arrival InflowQueue::take(double cell_area, double time) {
  if (due(cell_area) == 0) {
    throw NumericalError(
        fmt::format("opening {}: no cell is due at {} s: {} m^2 have entered, a cell needs {} m^2; "
                    "ask how many are due first",
                    opening_.name, time, state_.area, cell_area));
  }
  const double along = place_along(uniform({seed_, stream_, 2 * state_.arrivals}), time);
  const double angle = 2 * std::numbers::pi * uniform({seed_, stream_, 2 * state_.arrivals + 1});
  state_.area -= cell_area;
  ++state_.arrivals;
  return {point_at(opening_, along, 0), angle};
}

double InflowQueue::place_along(double draw, double time) const {
  const double length = opening_.length();
  const Vector<2> inward = opening_.inward();
  const std::size_t bins = std::max<std::size_t>(1, feed_.profile.size());
  const std::size_t panels_of_bin = (fewest_panels + bins - 1) / bins;
  std::vector<Panel> panels;
  double total = 0;
  for (std::size_t bin = 0; bin < bins; ++bin) {
    const double share = feed_.profile.empty() ? 1 : feed_.profile[bin];
    const double width = length / static_cast<double>(bins);
    const double from = std::max(static_cast<double>(bin) * width, feed_.clearance);
    const double to = std::min(static_cast<double>(bin + 1) * width, length - feed_.clearance);
    if (!(to > from) || share == 0) continue;
    const auto density = [&](double s) {
      const double u = flow_->at(point_at(opening_, s, 0), time).velocity.dot(inward);
      return share * std::max(u, 0.0);
    };
    double begin = from;
    double at_begin = density(from);
    for (std::size_t k = 1; k <= panels_of_bin; ++k) {
      const double end = k == panels_of_bin ? to
                                            : from + (to - from) * static_cast<double>(k) /
                                                         static_cast<double>(panels_of_bin);
      const double at_end = density(end);
      panels.push_back({begin, end, at_begin, at_end});
      total += panels.back().mass();
      begin = end;
      at_begin = at_end;
    }
  }
  if (!(total > 0)) {
    throw NumericalError(
        fmt::format("opening {}: a cell is due at {} s, but nothing flows in where centres may be; "
                    "reduce the clearance or correct the profile of the feed",
                    opening_.name, time));
  }
  double mass = draw * total;
  for (const Panel& panel : panels) {
    if (mass < panel.mass()) return place_in(panel, mass);
    mass -= panel.mass();
  }
  return panels.back().end;  // by rounding
}

}  // namespace hemoscale::micro
