#include "micro/cells/rest_shape.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "micro/cells/deflation_system.hpp"
#include "micro/cells/outline_checks.hpp"
#include "micro/error.hpp"
#include "micro/random/philox.hpp"

namespace hemoscale::micro {
namespace {

// In units of R0 and kappa / R0. The step of the iteration that finds it is still taken: it leaves
// round-off, 1e-14.
constexpr double tolerance = 1e-10;
constexpr int most_iterations = 12;
// Change of the reduced area from one minimum to the next. Newton's method reaches even 0.3 from
// the circle in one step; steps keep the path on the branch of the circle.
constexpr double largest_step = 0.25;
constexpr double smallest_step = 1e-3;
// Of the random part of the start, relative to the second harmonic.
constexpr double disturbance = 0.05;

void require_admissible(const Deflation& d, int nodes) {
  if (nodes < 8) {
    throw ParameterError(
        fmt::format("{} nodes per cell; at least 8 are needed to show its shape; use more", nodes));
  }
  if (!(d.perimeter > 0) || !std::isfinite(d.perimeter)) {
    throw ParameterError(fmt::format(
        "perimeter of the cell {} m; it must be finite and positive; a red cell has 19e-6",
        d.perimeter));
  }
  if (!(d.reduced_area > 0 && d.reduced_area <= 1)) {
    throw ParameterError(fmt::format(
        "reduced area {}; it must lie in (0, 1], where 1 is the circle; a red cell has 0.46",
        d.reduced_area));
  }
}

/// A point on the way: the minimum at one area.
struct Minimum {
  Eigen::VectorXd unknowns;
  Eigen::VectorXd tangent;  // d(unknowns) / d(area)
  double residual = 0;
};

/// Newton's method from a guess; nothing if it does not converge to a minimum.
std::optional<Minimum> minimum(const DeflationSystem& system, Eigen::VectorXd guess, double area) {
  Eigen::VectorXd gradient;
  Eigen::MatrixXd matrix;
  Eigen::MatrixXd steps(system.size(), 2);
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    system.assemble(guess, area, gradient, matrix);
    const double residual = gradient.cwiseAbs().maxCoeff();
    if (!std::isfinite(residual)) {
      return std::nullopt;
    }
    steps.col(0) = -gradient;
    steps.col(1).setZero();
    steps(system.nodes() + DeflationSystem::area_condition, 1) = 1;
    const int negative = solve_symmetric(matrix, steps);
    guess += steps.col(0);
    if (residual <= tolerance) {
      // As many negative eigenvalues as conditions: the energy rises along every motion that
      // keeps them.
      const bool lowest = negative == DeflationSystem::conditions;
      return lowest ? std::optional(Minimum{guess, steps.col(1), residual}) : std::nullopt;
    }
  }
  return std::nullopt;
}

/// The circle with a second harmonic that brings it to the wanted area, and a random part.
Eigen::VectorXd start(const DeflationSystem& system, double area, std::uint64_t seed) {
  double low = 0;
  double high = 1;  // reduced area 0.45
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (low + high);
    (system.area(system.start(middle)) > area ? low : high) = middle;
  }
  Eigen::VectorXd guess = system.start(low);
  for (int j = 0; j < system.nodes(); ++j) {
    const auto counter = static_cast<std::uint64_t>(j);
    guess(j) += disturbance * low * (2 * uniform({seed, 0, counter}) - 1);
  }
  return guess;
}

void require_simple(const DeflationSystem& system, const Minimum& found, double reduced_area,
                    double wanted) {
  if (const auto meeting = self_crossing(system.polygon(found.unknowns))) {
    throw ParameterError(fmt::format(
        "reduced area {}: on the way, at {:.4g}, opposite sides of the cell pass through each "
        "other "
        "(segments {} and {}); shapes of least energy touch at about 0.27; choose a larger one",
        wanted, reduced_area, meeting->first, meeting->second));
  }
}

/// Follows the minimum from just below the circle to the wanted area.
Minimum deflated(const DeflationSystem& system, const Deflation& deflation) {
  const double circle = system.area(system.start(0));
  const double wanted = deflation.reduced_area;
  double reached = 1;
  double step = largest_step;
  std::optional<Minimum> last;
  while (reached > wanted) {
    const double next = std::max(wanted, reached - step);
    std::optional<Minimum> found =
        minimum(system,
                last ? Eigen::VectorXd(last->unknowns + (next - reached) * circle * last->tangent)
                     : start(system, next * circle, deflation.seed),
                next * circle);
    if (found) {
      require_simple(system, *found, next, wanted);
      last = std::move(found);
      reached = next;
    } else if ((step *= 0.5) < smallest_step) {
      throw NumericalError(fmt::format(
          "deflation of a cell of {} nodes to the reduced area {}: no minimum of the bending "
          "energy "
          "found beyond {:.4g}, with steps down to {}; use more nodes or a larger reduced area",
          system.nodes(), wanted, reached, smallest_step));
    }
  }
  return *last;
}

/// Scales, and moves the centre of the enclosed area to the origin.
std::vector<Vector<2>> placed(std::vector<Vector<2>> polygon, double scale) {
  Vector<2> moment = Vector<2>::Zero();
  double twice_area = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Vector<2> a = polygon[i] - polygon[0];
    const Vector<2> b = polygon[i + 1] - polygon[0];
    const double part = a.x() * b.y() - a.y() * b.x();
    twice_area += part;
    moment += part / 3 * (a + b);
  }
  const Vector<2> centre = polygon[0] + moment / twice_area;
  for (auto& node : polygon) {
    node = (scale * (node - centre)).eval();
  }
  return polygon;
}

}  // namespace

RestShape deflate(const Deflation& deflation, int nodes) {
  require_admissible(deflation, nodes);
  const DeflationSystem system(nodes, deflation.bending_law);
  Minimum found;
  if (deflation.reduced_area < 1) {
    found = deflated(system, deflation);
  } else {
    found.unknowns = system.start(0);  // the circle is the only shape of this area
  }
  return {placed(system.polygon(found.unknowns), deflation.perimeter / (2 * std::numbers::pi)),
          system.energy(found.unknowns), found.residual};
}

}  // namespace hemoscale::micro
