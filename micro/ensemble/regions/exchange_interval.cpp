#include "micro/ensemble/regions/exchange_interval.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace hemoscale::micro::regions {
namespace {

constexpr double cutoff_over_straying = 80;
constexpr double nodes_per_contact = 8;
constexpr double most_steps = 1000;

double quotient(double numerator, double denominator) {
  return denominator > 0 ? numerator / denominator : std::numeric_limits<double>::infinity();
}

}  // namespace

double longest_copy_age(const blocks::BlockSettings& settings, CopyMotion motion) {
  double drag = std::numeric_limits<double>::infinity();
  double radius = 0;
  for (const blocks::KindSettings& kind : settings.kinds) {
    drag = std::min(drag, kind.node_drag);
    radius = std::max(radius, kind.mesh.rest_perimeter / (2 * std::numbers::pi));
  }
  const double straying = cutoff_of(settings.contact) / cutoff_over_straying;
  const double velocity = motion == CopyMotion::frozen
                              ? settings.flow->largest_speed()
                              : settings.flow->largest_shear_rate() * radius;
  const double stiffness = stiffness_at_rest(settings.contact);
  return std::min(quotient(straying, velocity), quotient(nodes_per_contact * drag, stiffness));
}

std::int64_t exchange_interval(const blocks::BlockSettings& settings, CopyMotion motion) {
  // A whole number of steps must not be lost to the last bit.
  const double steps = longest_copy_age(settings, motion) / settings.time_step * (1 + 1e-9);
  return static_cast<std::int64_t>(std::clamp(std::floor(steps), 1.0, most_steps));
}

}  // namespace hemoscale::micro::regions
