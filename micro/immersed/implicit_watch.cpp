#include <fmt/format.h>

#include <cmath>

#include "micro/cells/outline_checks.hpp"
#include "micro/error.hpp"
#include "micro/immersed/implicit_membranes.hpp"

namespace hemoscale::micro {

namespace {

using Points = std::vector<Vector<2>>;

Vector<2> mean(const Points& points) {
  Vector<2> sum = Vector<2>::Zero();
  for (const Vector<2>& x : points) sum += x;
  return sum / static_cast<double>(points.size());
}

/// Where a cell meets another, in the words of a message; empty if nowhere.
std::string meeting_of(const Points& one, Points other, const StokesKernel& kernel) {
  if (const auto* periodic = std::get_if<PeriodicKernel>(&kernel)) {
    const Vector<2> apart = mean(other) - mean(one);
    const Vector<2> shift = periodic->nearest(apart) - apart;
    for (Vector<2>& x : other) x += shift;
  }
  const auto meeting = crossing({.nodes = one}, {.nodes = other});
  if (!meeting) return "";
  return fmt::format("near ({:.6g}, {:.6g}) m", meeting->place.x(), meeting->place.y());
}

}  // namespace

/// Looks for the signs of failure at the places that a step has led to.
void ImplicitMembranes::watch() const {
  const MembraneThresholds& most = options_.thresholds;
  const auto fail = [](std::size_t cell, const std::string& what) {
    throw NumericalError(fmt::format("cell {}: {}", cell, what));
  };
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const Points& x = rings_[c].unknowns.positions;
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (!x[i].allFinite()) fail(c, fmt::format("the place of node {} is not finite", i));
      const std::string fault = bounds_.fault_at(x[i]);
      if (fault.empty()) continue;
      fail(c, fmt::format("node {} {}; end the run before, lengthen the channel, or refine the "
                          "particles where the gap is narrow",
                          i, fault));
    }
    if (const auto meeting = self_crossing(x)) {
      fail(c, fmt::format("its outline crosses itself near ({:.6g}, {:.6g}) m, segments {} and {}; "
                          "give it more nodes or a larger bending modulus, or shorten the step",
                          meeting->place.x(), meeting->place.y(), meeting->first, meeting->second));
    }
    const RingMesh& mesh = cells_[c].membrane->mesh();
    for (std::size_t k = 0; k < x.size(); ++k) {
      const double strain = (x[(k + 1) % x.size()] - x[k]).norm() / mesh.rest_length[k] - 1;
      if (std::abs(strain) <= most.strain) continue;
      fail(c, fmt::format("the strain of segment {} is {:.4g}, at most {:g} is admitted; give the "
                          "membrane a larger stretch modulus",
                          k, strain, most.strain));
    }
    const double area = enclosed_area(x) / mesh.rest_area - 1;
    if (!(std::abs(area) <= most.area)) {
      fail(c, fmt::format("its area is off by {:.4g} of itself, at most {:g} is admitted; keep it "
                          "exactly, or give it a larger modulus",
                          area, most.area));
    }
    for (std::size_t o = c + 1; o < cells_.size(); ++o) {
      const std::string place =
          meeting_of(x, rings_[o].unknowns.positions, surroundings_->kernel());
      if (place.empty()) continue;
      fail(c, fmt::format("it runs into cell {} {}; the gap between them is not resolved: give the "
                          "cells more nodes, or shorten the step",
                          o, place));
    }
  }
}

}  // namespace hemoscale::micro
