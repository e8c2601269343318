#include "micro/ensemble/check_parameters.hpp"

#include <fmt/core.h>

#include <cmath>
#include <string>

#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

/// Collects faults, one line each.
class Faults {
 public:
  void require(bool admissible, const std::string& message) {
    if (!admissible) {
      text_ += (text_.empty() ? "" : "\n") + message;
    }
  }
  void positive(double value, const char* name, const char* unit, const char* remedy) {
    require(
        value > 0 && std::isfinite(value),
        fmt::format("{} is {} {}; it must be finite and positive; {}", name, value, unit, remedy));
  }
  void not_negative(double value, const char* name, const char* unit, const char* remedy) {
    require(value >= 0 && std::isfinite(value),
            fmt::format("{} is {} {}; it must be finite and not negative; {}", name, value, unit,
                        remedy));
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

void check_laws(const EnsembleParameters& p, Faults& faults) {
  faults.positive(p.membrane.stretch_modulus, "stretch modulus", "N/m",
                  "without it the nodes of a membrane drift apart");
  faults.not_negative(p.membrane.bending_modulus, "bending modulus", "J", "choose 0 for none");
  faults.not_negative(p.membrane.area_modulus, "area modulus", "Pa", "choose 0 for none");
  faults.require(p.membrane.stretch_law == StretchLaw::linear &&
                     p.membrane.area_law == AreaLaw::penalty &&
                     p.membrane.natural_shape != NaturalShape::curvature,
                 "the ensemble knows linear stretching, the penalty of area and the natural shapes "
                 "flat and outline; choose those");
  faults.positive(p.drag.coefficient, "drag coefficient", "", "choose such as 12 for a cell");
  faults.not_negative(p.contact.stiffness, "contact stiffness", "Pa", "choose 0 for no contact");
  faults.positive(p.contact.rest_distance, "contact rest distance", "m",
                  "choose about a node spacing");
  faults.require(
      p.contact.cutoff > p.contact.rest_distance && std::isfinite(p.contact.cutoff),
      fmt::format("contact cutoff is {} m; it must exceed the rest distance {} m; raise it",
                  p.contact.cutoff, p.contact.rest_distance));
  faults.require(p.contact.attraction >= 0 && p.contact.attraction <= 10,
                 fmt::format("contact attraction is {}; it must lie in [0, 10]; choose 0 for none",
                             p.contact.attraction));
  faults.not_negative(p.wall.stiffness, "wall stiffness", "Pa", "choose 0 for no walls");
  faults.positive(p.wall.range, "wall range", "m", "choose about a node spacing");
}

void check_numerics(const EnsembleParameters& p, Faults& faults) {
  if (p.time_step) {
    faults.positive(*p.time_step, "time step", "s", "leave it out for the default");
  }
  faults.positive(p.sampling_strain, "sampling strain", "", "choose such as 0.05");
  faults.positive(p.segment_strain_limit, "segment strain limit", "", "choose such as 1");
  faults.require(p.threads >= 1 && p.threads <= 1024,
                 fmt::format("{} threads; the number must lie in 1..1024; choose 1", p.threads));
}

}  // namespace

void require_admissible(const EnsembleParameters& p) {
  Faults faults;
  faults.require(
      p.cells >= 1 && p.cells <= 1000000,
      fmt::format("{} cells; the number must lie in 1..1000000; choose such as 24", p.cells));
  faults.require(
      p.nodes >= 8 && p.nodes <= 1000,
      fmt::format("{} nodes per cell; the number must lie in 8..1000; choose such as 40", p.nodes));
  faults.require(
      p.hematocrit > 0 && p.hematocrit <= 0.75,
      fmt::format("hematocrit is {}; the area fraction must lie in (0, 0.75], since biconcave "
                  "sections do not pack more densely; lower it",
                  p.hematocrit));
  faults.positive(p.plasma_viscosity, "plasma viscosity", "Pa s", "plasma at 37 C has 1.2e-3");
  faults.positive(p.outline.length, "length of the outline", "m", "a red cell has 7.82e-6");
  if (const auto* box = std::get_if<ShearBox>(&p.domain)) {
    faults.positive(box->aspect_ratio, "aspect ratio of the box", "", "choose 1 for a square");
  } else {
    faults.positive(std::get<PlaneChannel>(p.domain).height, "height of the channel", "m",
                    "give the distance between the walls");
  }
  check_laws(p, faults);
  check_numerics(p, faults);
  if (!faults.text().empty()) {
    throw ParameterError("ensemble: " + faults.text());
  }
}

}  // namespace hemoscale::micro
