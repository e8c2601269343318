#include "micro/ensemble/flow/openings.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

/// Integral over the opening of what `part` makes of u.n.
template <typename Part>
double integrated(const Opening& opening, const GivenFlow& flow, double time, const Part& part) {
  constexpr int panels = 64;
  constexpr std::array<double, 2> places = {0.3399810435848563, 0.8611363115940526};
  constexpr std::array<double, 2> weights = {0.6521451548625461, 0.3478548451374538};
  const double half = 0.5 * opening.length() / panels;
  const Vector<2> inward = opening.inward();
  double sum = 0;
  for (int panel = 0; panel < panels; ++panel) {
    const double middle = (2 * panel + 1) * half;
    for (std::size_t k = 0; k < 2; ++k) {
      for (const double side : {-1.0, 1.0}) {
        const Vector<2> x = point_at(opening, middle + side * places[k] * half, 0);
        sum += weights[k] * half * part(flow.at(x, time).velocity.dot(inward));
      }
    }
  }
  return sum;
}

}  // namespace

Vector<2> Opening::inward() const {
  const Vector<2> t = tangent();
  return {-t[1], t[0]};
}

void check(const Opening& opening) {
  const double length = opening.length();
  if (length > 0 && std::isfinite(length)) return;
  throw ParameterError(
      fmt::format("opening {}: from ({}, {}) m to ({}, {}) m; its ends must be finite and apart; "
                  "give them from wall to wall",
                  opening.name, opening.a[0], opening.a[1], opening.b[0], opening.b[1]));
}

Vector<2> point_at(const Opening& opening, double along, double depth) {
  return opening.a + along * opening.tangent() + depth * opening.inward();
}

double depth(const Opening& opening, const Vector<2>& x) {
  return (x - opening.a).dot(opening.inward());
}

bool has_left(const Opening& opening, const Vector<2>& x, double overhang) {
  const double along = (x - opening.a).dot(opening.tangent());
  const double beyond = -depth(opening, x);
  return beyond > 0 && beyond <= overhang && along >= 0 && along <= opening.length();
}

double volume_flux(const Opening& opening, const GivenFlow& flow, double time) {
  return integrated(opening, flow, time, [](double u) { return u; });
}

double inflow_flux(const Opening& opening, const GivenFlow& flow, double time) {
  return integrated(opening, flow, time, [](double u) { return std::max(u, 0.0); });
}

}  // namespace hemoscale::micro
