#include "coupling/transfer/channel_forcing.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "coupling/error.hpp"

namespace hemoscale::coupling {

ChannelForcing to_channel_forcing(const macro::FlowField<2>& flow, const InletSection& section,
                                  double t) {
  const macro::Vector<2> across = section.upper - section.lower;
  const double height = across.norm();
  if (!(height > 0) || section.points < 4) {
    throw NumericalError(
        "section of a micro channel: its ends coincide, or fewer than 4 points are "
        "asked for; give the walls of the channel");
  }
  // Turned by a right angle: along the channel, if its lower wall is on the right of the flow.
  const macro::Vector<2> along(across[1] / height, -across[0] / height);
  std::vector<macro::Vector<2>> points;
  for (int k = 0; k < section.points; ++k) {
    points.push_back(section.lower + across * k / (section.points - 1));
  }
  ChannelForcing result;
  micro::VelocityProfile profile{.height = height, .velocities = {}};
  double largest = 0;
  double sideways = 0;
  for (const auto& state : flow.sample(points, t)) {
    if (!state) {
      throw NumericalError(
          "section of a micro channel: a point of it lies outside the macro flow; move its ends "
          "into "
          "the flow");
    }
    const double speed = state->velocity.dot(along);
    if (!std::isfinite(speed)) {
      throw NumericalError(
          "section of a micro channel: the macro velocity is not finite; the macro flow has "
          "failed");
    }
    profile.velocities.push_back(speed);
    largest = std::max(largest, std::abs(speed));
    sideways = std::max(sideways, std::abs(state->velocity.dot(across) / height));
  }
  if (!(largest > 0)) {
    throw NumericalError(
        "section of a micro channel: nothing flows through it; turn it across the macro flow");
  }
  result.transverse = sideways / largest;
  result.forcing.profile = std::move(profile);
  return result;
}

}  // namespace hemoscale::coupling
