#include "micro/ensemble/observables/lateral_average.hpp"

#include <fmt/core.h>

#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

using Part = std::pair<const char*, std::vector<double> LateralContribution::*>;
using SumPart = std::pair<const char*, std::vector<double> LateralSums::*>;

const std::array<Part, 3> parts = {
    Part{"profile.flow_velocity", &LateralContribution::flow_velocity},
    Part{"profile.shear_stress", &LateralContribution::shear_stress},
    Part{"profile.normal_stress", &LateralContribution::normal_stress}};
const std::array<SumPart, 4> sum_parts = {SumPart{"profile.area", &LateralSums::area},
                                          SumPart{"profile.transport", &LateralSums::transport},
                                          SumPart{"profile.cosine", &LateralSums::cosine},
                                          SumPart{"profile.sine", &LateralSums::sine}};

void add_to(std::vector<double>& total, const std::vector<double>& values) {
  for (std::size_t b = 0; b < values.size(); ++b) total[b] += values[b];
}

const std::vector<double>& find(const Snapshot& snapshot, const char* name, std::size_t size) {
  const auto found = snapshot.reals.find(name);
  if (found == snapshot.reals.end() || found->second.size() != size) {
    throw ParameterError(fmt::format(
        "snapshot: {} numbers '{}'; this observer has {}; restore it into a run with the same bins",
        found == snapshot.reals.end() ? std::size_t{0} : found->second.size(), name, size));
  }
  return found->second;
}

}  // namespace

LateralAverage::LateralAverage(std::size_t bins) {
  const std::vector<double> zeros(bins, 0.0);
  for (const auto& [name, part] : parts) total_.*part = zeros;
  for (const auto& [name, part] : sum_parts) total_.sums.*part = zeros;
}

void LateralAverage::add(const LateralContribution& contribution, double length, double height) {
  for (const auto& [name, part] : parts) add_to(total_.*part, contribution.*part);
  for (const auto& [name, part] : sum_parts) add_to(total_.sums.*part, contribution.sums.*part);
  length_ += length;
  height_ += height;
  ++samples_;
}

LateralProfiles LateralAverage::profiles() const {
  if (samples_ == 0) {
    throw ParameterError(
        "observables: there is no sample to average; at least one is needed; average from an "
        "earlier time or run longer");
  }
  const auto samples = static_cast<double>(samples_);
  const std::size_t count = total_.sums.area.size();
  const LateralBins bins{.height = height_ / samples, .count = count};
  LateralProfiles profiles;
  for (std::size_t b = 0; b < count; ++b) {
    const double area = total_.sums.area[b];
    const double bin_area = length_ * bins.width();
    const bool is_empty = !(area > 0);
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    profiles.y.push_back(bins.middle(b));
    profiles.area_fraction.push_back(area / bin_area);
    profiles.cell_velocity.push_back(is_empty ? nan : total_.sums.transport[b] / area);
    profiles.flow_velocity.push_back(total_.flow_velocity[b] / samples);
    profiles.area_flux.push_back(total_.sums.transport[b] / bin_area);
    profiles.along_flow.push_back(is_empty ? nan : total_.sums.cosine[b] / area);
    profiles.inclination.push_back(
        is_empty ? nan : 0.5 * std::atan2(total_.sums.sine[b], total_.sums.cosine[b]));
    profiles.shear_stress.push_back(total_.shear_stress[b] / samples);
    profiles.normal_stress.push_back(total_.normal_stress[b] / samples);
  }
  return profiles;
}

void LateralAverage::store(Snapshot& snapshot) const {
  for (const auto& [name, part] : parts) snapshot.reals[name] = total_.*part;
  for (const auto& [name, part] : sum_parts) snapshot.reals[name] = total_.sums.*part;
  snapshot.reals["profile.size"] = {length_, height_};
  snapshot.integers["profile.samples"] = {samples_};
}

void LateralAverage::load(const Snapshot& snapshot) {
  const std::size_t bins = total_.sums.area.size();
  LateralAverage loaded(bins);
  for (const auto& [name, part] : parts) loaded.total_.*part = find(snapshot, name, bins);
  for (const auto& [name, part] : sum_parts) loaded.total_.sums.*part = find(snapshot, name, bins);
  const std::vector<double>& size = find(snapshot, "profile.size", 2);
  const auto samples = snapshot.integers.find("profile.samples");
  if (samples == snapshot.integers.end() || samples->second.size() != 1) {
    throw ParameterError(
        "snapshot: no number 'profile.samples'; one is needed; restore it into the kind of run "
        "that wrote it");
  }
  loaded.length_ = size[0];
  loaded.height_ = size[1];
  loaded.samples_ = samples->second.front();
  *this = std::move(loaded);
}

}  // namespace hemoscale::micro
