#include "macro/analytic/channel_profile.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "macro/parameter_check.hpp"

namespace hemoscale::macro {

namespace {

// The range keeps products of three of these numbers away from overflow and underflow.
void require_zero_or_ordinary(const CheckedParameter& parameter, double magnitude,
                              const char* what) {
  require(magnitude == 0 || (magnitude >= 1e-30 && magnitude <= 1e30), parameter,
          std::string("zero, or 1e-30 to 1e30 for ") + what, "check its unit and that of height");
}

struct DriveCheck {
  double height;
  void operator()(const PressureGradient& drive) const {
    require_zero_or_ordinary({"channel", "pressure gradient", drive.value, "Pa/m"},
                             0.5 * height * std::abs(drive.value), "the wall stress in Pa");
  }
  void operator()(const MeanVelocity& drive) const {
    require_zero_or_ordinary({"channel", "mean velocity", drive.value, "m/s"},
                             std::abs(drive.value) / height, "mean velocity / height in 1/s");
  }
};

struct CurveForDrive {
  const ViscosityLaw& law;
  const Channel& channel;
  FlowCurve operator()(const PressureGradient& drive) const {
    return FlowCurve::up_to_stress(law, channel.hematocrit,
                                   0.5 * channel.height * std::abs(drive.value));
  }
  FlowCurve operator()(const MeanVelocity& drive) const {
    return FlowCurve::up_to_mean_rate(law, channel.hematocrit,
                                      std::abs(drive.value) / channel.height);
  }
};

}  // namespace

void check(const Channel& channel) {
  require_positive({"channel", "height", channel.height, "m"},
                   "give the distance between the walls");
  require(channel.hematocrit >= 0 && channel.hematocrit < 1,
          {"channel", "hematocrit", channel.hematocrit, "-"}, "0 to less than 1",
          "give a volume fraction, not a percentage");
  std::visit(DriveCheck{channel.height}, channel.drive);
}

ChannelProfile::ChannelProfile(const ViscosityLaw& law, const Channel& channel)
    : height_(channel.height) {
  check(channel);
  const double drive = std::visit([](const auto& d) { return d.value; }, channel.drive);
  if (drive == 0) return;
  sign_ = drive > 0 ? 1 : -1;
  curve_ = std::visit(CurveForDrive{law, channel}, channel.drive);
  const double wall_stress = curve_->wall_stress();
  pressure_gradient_ = sign_ * 2 * wall_stress / height_;
  mean_velocity_ = sign_ * height_ * curve_->moment() / (2 * wall_stress * wall_stress);
}

double ChannelProfile::wall_shear_rate() const {
  return curve_ ? curve_->wall_shear_rate() : 0;
}

ChannelProfile::Point ChannelProfile::at(double y) const {
  assert(y >= 0 && y <= height_);
  if (!curve_) return {};
  const double G = std::abs(pressure_gradient_);
  const double from_axis = 0.5 * height_ - y;  // positive in the lower half
  const double stress = y == 0 || y == height_ ? curve_->wall_stress() : G * std::abs(from_axis);
  const double shear_rate = curve_->shear_rate(stress);
  const double slope = from_axis > 0 ? shear_rate : from_axis < 0 ? -shear_rate : 0;
  return {sign_ * curve_->slip(shear_rate) / G, shear_rate, sign_ * slope};
}

}  // namespace hemoscale::macro
