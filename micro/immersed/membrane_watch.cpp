#include "micro/immersed/membrane_watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "micro/cells/outline_checks.hpp"
#include "micro/error.hpp"

namespace hemoscale::micro {

namespace {

using Polygon = std::vector<Vector<2>>;

const Vector<2>& next_of(const Polygon& polygon, std::size_t i) {
  return polygon[i + 1 < polygon.size() ? i + 1 : 0];
}

bool overlap(const Polygon& one, const Polygon& other) {
  return crossing({.nodes = one}, {.nodes = other}) || encloses(one, other.front()) ||
         encloses(other, one.front());
}

Vector<2> centre_of(const Polygon& polygon) {
  Vector<2> sum = Vector<2>::Zero();
  for (const Vector<2>& x : polygon) sum += x;
  return sum / static_cast<double>(polygon.size());
}

/// dA/dX_i [m].
Polygon area_gradient(const Polygon& positions) {
  Polygon gradient;
  gradient.reserve(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Vector<2>& before = positions[i > 0 ? i - 1 : positions.size() - 1];
    const Vector<2> chord = next_of(positions, i) - before;
    gradient.emplace_back(chord[1] / 2, -chord[0] / 2);
  }
  return gradient;
}

double squared_norm(const Polygon& vectors) {
  double sum = 0;
  for (const Vector<2>& v : vectors) sum += v.squaredNorm();
  return sum;
}

std::string fault_of(const Cell& cell, const MembraneBounds& bounds) {
  if (!cell.membrane) return "has no membrane; give it one";
  const auto wanted = static_cast<std::size_t>(cell.membrane->mesh().nodes);
  if (cell.positions.size() != wanted) {
    return fmt::format("has {} nodes, its mesh {}; give it as many", cell.positions.size(), wanted);
  }
  if (wanted < 8) {
    return fmt::format("has {} nodes; at least 8 are needed, 59 are usual", wanted);
  }
  for (std::size_t i = 0; i < wanted; ++i) {
    const Vector<2>& x = cell.positions[i];
    if (!x.allFinite()) return fmt::format("node {} is not finite", i);
    if (x == next_of(cell.positions, i)) {
      return fmt::format("node {} coincides with the next; move them apart", i);
    }
    const std::string fault = bounds.fault_at(x);
    if (!fault.empty()) return fmt::format("node {} {}; move the cell", i, fault);
  }
  if (self_crossing(cell.positions)) return "crosses itself; give it a simple outline";
  if (!(enclosed_area(cell.positions) > 0)) return "runs clockwise; reverse its nodes";
  return "";
}

[[noreturn]] void fail(const MembraneStep& step, std::size_t cell, const std::string& what) {
  std::string remedy;
  for (const Limit& limit : *step.limits) {
    if (limit.exceeded()) remedy += "; " + describe(limit);
  }
  if (remedy.empty()) {
    remedy = "; no limit is exceeded: reduce the time step, or choose the implicit coupling";
  }
  throw NumericalError(
      fmt::format("step {}, time {:.6g} s: cell {}{}{}", step.step, step.time, cell, what, remedy));
}

}  // namespace

MembraneBounds::MembraneBounds(const FlowDomain<2>& domain, double wall_offset, double margin)
    : spacing_(domain.spacing), wall_offset_(wall_offset), margin_(margin) {
  const ParticleSet<2>& all = domain.particles;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const ParticleKind kind = all.kinds[i];
    if (kind == ParticleKind::fluid || kind == ParticleKind::dummy) continue;
    boundary_.append(all.positions[i], all.identities[i], kind, all.patches[i], all.normals[i]);
  }
  if (boundary_.size() > 0) {
    // Two bins reach as far as the margins.
    const double size = std::max({spacing_, margin_ / 2, wall_offset_});
    bins_.emplace(boundary_.positions, domain.box, size);
  }
}

std::string MembraneBounds::fault_at(const Vector<2>& x) const {
  if (!bins_) return "";
  double least = std::numeric_limits<double>::infinity();
  std::size_t nearest = boundary_.size();
  bool is_at_opening = false;
  Vector<2> from = Vector<2>::Zero();  // the nearest
  bins_->visit_around(x, 2, [&](std::size_t k, const Vector<2>& r) {
    const ParticleKind kind = boundary_.kinds[k];
    const double distance = r.norm();
    is_at_opening = is_at_opening || (kind != ParticleKind::wall && distance < margin_);
    if (kind != ParticleKind::wall || distance >= least) return;
    least = distance;
    nearest = k;
    from = -r;
  });
  if (is_at_opening) {
    return fmt::format("at ({:.6g}, {:.6g}) m is less than {:g} m from an opening", x[0], x[1],
                       margin_);
  }
  if (nearest == boundary_.size()) return "";
  // Positive beyond the wall.
  const double beyond = from.dot(boundary_.normals[nearest]) + wall_offset_;
  if (!(beyond >= 0)) return "";
  return fmt::format("at ({:.6g}, {:.6g}) m is {:.3g} m beyond a wall", x[0], x[1], beyond);
}

CellReport report_on(const Cell& cell) {
  const RingMesh& mesh = cell.membrane->mesh();
  CellReport report;
  report.area_error = enclosed_area(cell.positions) / mesh.rest_area - 1;
  double perimeter = 0;
  for (std::size_t i = 0; i < cell.positions.size(); ++i) {
    const double length = (next_of(cell.positions, i) - cell.positions[i]).norm();
    perimeter += length;
    const double strain = std::abs(length / mesh.rest_length[i] - 1);
    if (strain > report.largest_strain) {
      report.largest_strain = strain;
      report.segment = i;
    }
  }
  report.length_error = perimeter / mesh.rest_perimeter - 1;
  return report;
}

double project_area(const RingMesh& mesh, Polygon& positions) {
  const double error = enclosed_area(positions) - mesh.rest_area;
  const Polygon gradient = area_gradient(positions);
  const double squared = squared_norm(gradient);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    positions[i] -= error / squared * gradient[i];
  }
  return error / mesh.rest_area;
}

double project_velocities(const RingMesh& mesh, const Polygon& positions, Polygon& velocities) {
  const Polygon gradient = area_gradient(positions);
  const double squared = squared_norm(gradient);
  double rate = 0;
  for (std::size_t i = 0; i < positions.size(); ++i) rate += gradient[i].dot(velocities[i]);
  for (std::size_t i = 0; i < positions.size(); ++i) {
    velocities[i] -= rate / squared * gradient[i];
  }
  return rate / mesh.rest_area;
}

void require_admissible(const std::vector<Cell>& cells, const PeriodicBox<2>& box,
                        const MembraneBounds& bounds) {
  std::string faults;
  const auto add = [&](const std::string& fault) {
    faults += (faults.empty() ? "" : "\n") + fault;
  };
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const std::string fault = fault_of(cells[c], bounds);
    if (!fault.empty()) add(fmt::format("cell {}: {}", c, fault));
  }
  if (!faults.empty()) throw ParameterError(faults);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    for (std::size_t other = c + 1; other < cells.size(); ++other) {
      // The image of the other cell that is nearest to this one.
      Polygon image = cells[other].positions;
      const Vector<2> from = centre_of(cells[c].positions);
      const Vector<2> to = centre_of(image);
      const Vector<2> shift = separation(box, from, to) - (to - from);
      for (Vector<2>& x : image) x += shift;
      if (overlap(cells[c].positions, image)) {
        add(fmt::format("cell {} overlaps cell {}; move them apart", c, other));
      }
    }
  }
  if (!faults.empty()) throw ParameterError(faults);
}

std::vector<CellReport> watch(const std::vector<Cell>& cells, const std::vector<Cell>& before,
                              const MembraneBounds& bounds, const MembraneThresholds& thresholds,
                              const MembraneStep& step) {
  std::vector<CellReport> reports;
  reports.reserve(cells.size());
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const Polygon& positions = cells[c].positions;
    for (std::size_t i = 0; i < positions.size(); ++i) {
      if (!positions[i].allFinite()) {
        fail(step, c, fmt::format(", node {}: its position is not finite", i));
      }
      const double way = (positions[i] - before[c].positions[i]).norm() / step.spacing;
      if (way > thresholds.node_step) {
        fail(step, c,
             fmt::format(", node {}: it moved by {:.4g} spacings in one step, at most {:g} are "
                         "admitted",
                         i, way, thresholds.node_step));
      }
      const std::string fault = bounds.fault_at(positions[i]);
      if (!fault.empty()) fail(step, c, fmt::format(", node {}: {}", i, fault));
    }
    const CellReport report = report_on(cells[c]);
    if (report.largest_strain > thresholds.strain) {
      fail(step, c,
           fmt::format(", node {}: the strain of the segment behind it is {:.4g}, at most {:g} is "
                       "admitted",
                       report.segment, report.largest_strain, thresholds.strain));
    }
    if (std::abs(report.area_error) > thresholds.area) {
      fail(step, c,
           fmt::format(": its area is off by {:.4g} of itself, at most {:g} is admitted",
                       report.area_error, thresholds.area));
    }
    if (self_crossing(positions)) fail(step, c, ": its outline crosses itself");
    reports.push_back(report);
  }
  return reports;
}

}  // namespace hemoscale::micro
