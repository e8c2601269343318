#include "macro/analytic/flow_curve.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <string>

#include "macro/analytic/bracketed_root.hpp"
#include "macro/error.hpp"
#include "macro/parameter_check.hpp"
#include "macro/viscosity/kinks.hpp"

namespace hemoscale::macro {

namespace {

constexpr double panel_width = 0.5;  // [-] in log(shear rate)
constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();

[[noreturn]] void refuse_stress_not_increasing(const ViscosityLaw& law, double shear_rate) {
  throw NumericalError("viscosity law " + law.name() +
                       ": the shear stress does not increase with the shear rate at " +
                       as_text(shear_rate) +
                       " 1/s, so that the channel profile is not unique; allowed: d log(viscosity) "
                       "/ d log(shear rate) above -1 up to the wall; give a law that thins less "
                       "there, or a weaker flow");
}

}  // namespace

FlowCurve::FlowCurve(const ViscosityLaw& law, double hematocrit)
    : law_(law), hematocrit_(hematocrit), rule_(gauss_legendre()) {
  for (const double rate : kinks(law)) log_kinks_.push_back(std::log(rate));
}

double FlowCurve::stress_at(double log_rate) const {
  const double rate = std::exp(log_rate);
  return law_.viscosity(rate, hematocrit_) * rate;
}

double FlowCurve::stress_slope_at(double log_rate) const {
  return 1 + law_.logarithmic_slope(std::exp(log_rate), hematocrit_);
}

double FlowCurve::slip_density(double log_rate) const {
  return std::exp(log_rate) * stress_at(log_rate) * stress_slope_at(log_rate);
}

double FlowCurve::moment_density(double log_rate) const {
  return stress_at(log_rate) * slip_density(log_rate);
}

// Chooses the first panel end so far down that the fluid below it contributes less than rounding.
// There it counts as Newtonian, which every law tends to at rest.
void FlowCurve::start_below(double shear_rate) {
  const double power = shear_rate * law_.viscosity(shear_rate, hematocrit_) * shear_rate;
  double start = std::log(shear_rate);
  while (std::exp(start) * stress_at(start) > 1e-18 * power) start -= panel_width;
  const double stress = stress_at(start);
  log_rates_ = {start};
  stresses_ = {stress};
  moments_ = {std::exp(start) * stress * stress / 3};
}

double FlowCurve::panel_end() const {
  const double begin = log_rates_.back();
  const auto kink = std::upper_bound(log_kinks_.begin(), log_kinks_.end(), begin);
  return kink == log_kinks_.end() ? begin + panel_width : std::min(*kink, begin + panel_width);
}

void FlowCurve::add_panel() {
  const double begin = log_rates_.back();
  const double end = panel_end();
  for (const double node : rule_.nodes) {
    const double s = 0.5 * (begin + end) + 0.5 * (end - begin) * node;
    if (!(stress_slope_at(s) > 0)) refuse_stress_not_increasing(law_, std::exp(s));
  }
  const double stress = stress_at(end);
  if (!(stress > stresses_.back())) refuse_stress_not_increasing(law_, std::exp(end));
  const auto density = [this](double s) { return moment_density(s); };
  log_rates_.push_back(end);
  stresses_.push_back(stress);
  moments_.push_back(moments_.back() + integrate(rule_, density, begin, end));
}

void FlowCurve::end_last_panel_at(double log_rate) {
  const std::size_t last = log_rates_.size() - 1;
  const auto density = [this](double s) { return moment_density(s); };
  log_rates_[last] = log_rate;
  stresses_[last] = stress_at(log_rate);
  moments_[last] = moments_[last - 1] + integrate(rule_, density, log_rates_[last - 1], log_rate);
}

// Summed from the wall inwards: velocities near the wall keep their relative accuracy.
void FlowCurve::sum_slip_from_wall() {
  const auto density = [this](double s) { return slip_density(s); };
  slips_.assign(log_rates_.size(), 0.0);
  for (std::size_t i = log_rates_.size() - 1; i > 0; --i) {
    slips_[i - 1] = slips_[i] + integrate(rule_, density, log_rates_[i - 1], log_rates_[i]);
  }
}

double FlowCurve::log_rate_for(double stress, double low, double high) const {
  const auto excess = [this, stress](double s) {
    return ValueAndSlope{std::log(stress_at(s) / stress), stress_slope_at(s)};
  };
  return bracketed_root(excess, low, high, rounding);
}

FlowCurve FlowCurve::up_to_stress(const ViscosityLaw& law, double hematocrit, double wall_stress) {
  assert(wall_stress > 0);
  FlowCurve curve(law, hematocrit);
  // A law that thins reaches the wall stress above this shear rate, one that thickens below it.
  double below = std::log(wall_stress / law.viscosity(0, hematocrit));
  while (curve.stress_at(below) > wall_stress) below -= panel_width;
  curve.start_below(std::exp(below));
  while (curve.stresses_.front() >= wall_stress) curve.start_below(std::exp(curve.log_rates_[0]));
  while (curve.stresses_.back() < wall_stress) curve.add_panel();
  const std::size_t last = curve.log_rates_.size() - 1;
  curve.end_last_panel_at(
      curve.log_rate_for(wall_stress, curve.log_rates_[last - 1], curve.log_rates_[last]));
  curve.sum_slip_from_wall();
  return curve;
}

FlowCurve FlowCurve::up_to_mean_rate(const ViscosityLaw& law, double hematocrit, double mean_rate) {
  assert(mean_rate > 0);
  // The mean rate V / h is moment / (2 tau_wall^2), which grows with the wall shear rate at least
  // as fast as the moment's upper bound gamma_wall tau_wall^2 / 2 lets it: V / h <= gamma_wall / 4.
  FlowCurve curve(law, hematocrit);
  curve.start_below(4 * mean_rate);
  const auto mean_rate_at = [&curve](std::size_t i) {
    return curve.moments_[i] / (2 * curve.stresses_[i] * curve.stresses_[i]);
  };
  while (mean_rate_at(curve.log_rates_.size() - 1) < mean_rate) curve.add_panel();
  const std::size_t last = curve.log_rates_.size() - 1;
  const double begin = curve.log_rates_[last - 1];
  const double moment_below = curve.moments_[last - 1];
  const auto excess = [&](double s) {
    const auto density = [&curve](double log_rate) { return curve.moment_density(log_rate); };
    const double moment = moment_below + integrate(curve.rule_, density, begin, s);
    const double stress = curve.stress_at(s);
    return ValueAndSlope{std::log(moment / (2 * stress * stress) / mean_rate),
                         curve.moment_density(s) / moment - 2 * curve.stress_slope_at(s)};
  };
  curve.end_last_panel_at(bracketed_root(excess, begin, curve.log_rates_[last], rounding));
  curve.sum_slip_from_wall();
  return curve;
}

double FlowCurve::wall_shear_rate() const {
  return std::exp(log_rates_.back());
}

double FlowCurve::shear_rate(double stress) const {
  assert(stress >= 0);
  if (stress == 0) return 0;
  if (stress >= stresses_.back()) return wall_shear_rate();
  const auto above = std::upper_bound(stresses_.begin(), stresses_.end(), stress);
  const std::size_t i = static_cast<std::size_t>(above - stresses_.begin());
  if (i > 0) return std::exp(log_rate_for(stress, log_rates_[i - 1], log_rates_[i]));
  double low = log_rates_.front() - 1;
  while (stress_at(low) >= stress) low -= 1;
  return std::exp(log_rate_for(stress, low, log_rates_.front()));
}

double FlowCurve::slip(double shear_rate) const {
  if (shear_rate >= wall_shear_rate()) return 0;
  const double s = shear_rate > 0 ? std::log(shear_rate) : -std::numeric_limits<double>::infinity();
  if (s <= log_rates_.front()) {
    const double stress = law_.viscosity(shear_rate, hematocrit_) * shear_rate;
    const double to_front = std::exp(log_rates_.front()) * stresses_.front() - shear_rate * stress;
    return slips_.front() + 0.5 * to_front;
  }
  const auto above = std::upper_bound(log_rates_.begin(), log_rates_.end() - 1, s);
  const std::size_t i = static_cast<std::size_t>(above - log_rates_.begin());
  const auto density = [this](double log_rate) { return slip_density(log_rate); };
  return slips_[i] + integrate(rule_, density, s, log_rates_[i]);
}

}  // namespace hemoscale::macro
