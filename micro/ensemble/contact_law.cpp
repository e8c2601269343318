#include "micro/ensemble/contact_law.hpp"

#include <fmt/core.h>

#include <initializer_list>

namespace hemoscale::micro {
namespace {

// exp(2 b re) stays within single precision, and a law steeper than that is a wall.
constexpr double largest_steepness = 20;

// (re/core)^14 stays within single precision.
constexpr double smallest_core = 0.05;

struct Value {
  const char* name;
  double value;
  const char* unit;
};

std::string not_positive(std::initializer_list<Value> values, const char* law) {
  std::string faults;
  for (const Value& v : values) {
    if (!(v.value > 0) || !std::isfinite(v.value)) {
      faults += fmt::format("{}{} law of contact: {} is {} {}; it must be finite and positive",
                            faults.empty() ? "" : "\n", law, v.name, v.value, v.unit);
    }
  }
  return faults;
}

std::string not_below(const char* law, const Value& small, const Value& large) {
  if (small.value < large.value) return {};
  return fmt::format("{} law of contact: {} is {} {}; it must be below the {} of {} {}; reduce it",
                     law, small.name, small.value, small.unit, large.name, large.value, large.unit);
}

std::string faults_of(const PairPotential& law) {
  std::string faults;
  if (!(law.scale >= 0) || !std::isfinite(law.scale)) {
    faults = fmt::format("polynomial law of contact: scale is {} N/m^7; it must not be negative",
                         law.scale);
  }
  if (!(law.rest_squared > 0 && law.rest_squared < law.cutoff_squared)) {
    faults += fmt::format(
        "{}polynomial law of contact: squared rest distance {} m^2 and squared cutoff {} m^2; both "
        "must be positive, and the cutoff the larger",
        faults.empty() ? "" : "\n", law.rest_squared, law.cutoff_squared);
  }
  return faults;
}
std::string faults_of(const MorsePotential& law) {
  std::string faults = not_positive({{"energy scale", law.energy_scale, "N"},
                                     {"steepness", law.steepness, "1/m"},
                                     {"rest distance", law.rest_distance, "m"},
                                     {"cutoff", law.cutoff, "m"}},
                                    "Morse");
  if (!faults.empty()) return faults;
  // Where attraction is strongest: a well that is cut before it only repels.
  const double steepest = law.rest_distance + std::log(2.0) / law.steepness;
  faults = not_below("Morse", {"distance of strongest attraction", steepest, "m"},
                     {"cutoff", law.cutoff, "m"});
  if (law.steepness * law.cutoff > largest_steepness) {
    faults += fmt::format(
        "{}Morse law of contact: steepness times cutoff is {}; at most {} is admitted; reduce "
        "the steepness of {} 1/m or the cutoff of {} m",
        faults.empty() ? "" : "\n", law.steepness * law.cutoff, largest_steepness, law.steepness,
        law.cutoff);
  }
  return faults;
}
std::string faults_of(const LennardJonesPotential& law) {
  std::string faults = not_positive({{"energy scale", law.energy_scale, "N"},
                                     {"rest distance", law.rest_distance, "m"},
                                     {"core", law.core, "m"},
                                     {"cutoff", law.cutoff, "m"}},
                                    "Lennard-Jones");
  if (!faults.empty()) return faults;
  faults = not_below("Lennard-Jones", {"core", law.core, "m"},
                     {"rest distance", law.rest_distance, "m"});
  const double steepest = law.rest_distance * LennardJonesPotential::steepest;
  const std::string above =
      not_below("Lennard-Jones", {"distance of strongest attraction", steepest, "m"},
                {"cutoff", law.cutoff, "m"});
  faults += (faults.empty() || above.empty() ? "" : "\n") + above;
  if (law.core < smallest_core * law.rest_distance) {
    faults += fmt::format(
        "{}Lennard-Jones law of contact: core is {} m; at least {} times the rest distance of {} m "
        "is admitted, because stiffness grows with its -14th power; enlarge it",
        faults.empty() ? "" : "\n", law.core, smallest_core, law.rest_distance);
  }
  return faults;
}

}  // namespace

std::string contact_law_faults(const ContactLaw& law) {
  return std::visit([](const auto& l) { return faults_of(l); }, law);
}

}  // namespace hemoscale::micro
