#include "micro/cells/ring_membrane.hpp"

#include <fmt/core.h>

#include <cmath>
#include <string>
#include <utility>

#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

std::string fault(double value, const char* name, const char* unit) {
  if (value >= 0 && std::isfinite(value)) {
    return {};
  }
  return fmt::format("\n{} is {} {}; it must be finite and not negative; choose 0 for none", name,
                     value, unit);
}

/// The mesh holds the natural angles; they must be those that the parameters ask for.
std::string natural_shape_fault(const RingMesh& mesh, const MembraneParameters& p) {
  if (!std::isfinite(p.spontaneous_curvature)) {
    return fmt::format("\nspontaneous curvature is {} 1/m; it must be finite; choose 0 for none",
                       p.spontaneous_curvature);
  }
  if (p.natural_shape != NaturalShape::curvature && p.spontaneous_curvature != 0) {
    return fmt::format(
        "\nspontaneous curvature is {} 1/m, but the natural shape is not of uniform curvature; it "
        "must then be 0; choose the natural shape `curvature`",
        p.spontaneous_curvature);
  }
  if (p.natural_shape == NaturalShape::outline) {
    return {};
  }
  const double curvature = p.natural_shape == NaturalShape::flat ? 0 : p.spontaneous_curvature;
  for (std::size_t i = 0; i < mesh.natural_angle.size(); ++i) {
    const double wanted = curvature * mesh.node_length[i];
    if (std::abs(mesh.natural_angle[i] - wanted) > 1e-12) {
      return fmt::format(
          "\nnatural angle of node {} is {} rad, that of the natural shape {} rad; they must "
          "agree; "
          "make the mesh with the natural shape and curvature of the membrane",
          i, mesh.natural_angle[i], wanted);
    }
  }
  return {};
}

RingGeometry measured(std::span<const Vector<2>> positions, const RingMesh& mesh) {
  const std::size_t n = positions.size();
  if (n != static_cast<std::size_t>(mesh.nodes)) {
    throw ParameterError(
        fmt::format("{} positions for a ring of {} nodes; give one for each", n, mesh.nodes));
  }
  std::vector<double> coordinates(2 * n);
  double* const x = coordinates.data();
  double* const y = x + n;
  for (std::size_t i = 0; i < n; ++i) {
    x[i] = positions[i].x();
    y[i] = positions[i].y();
  }
  RingGeometry ring(mesh.nodes);
  measure(x, y, ring);
  return ring;
}

/// Applies `act` to the stretching law, if there is one.
template <class Laws, class Act>
void with_stretch(const Laws& laws, const Act& act) {
  if (const auto* linear = std::get_if<Stretch>(&laws)) {
    act(*linear);
  } else if (const auto* elements = std::get_if<LineElementStretch>(&laws)) {
    act(*elements);
  }
}

}  // namespace

RingMembrane::RingMembrane(RingMesh mesh, const MembraneParameters& parameters)
    : mesh_(std::move(mesh)), parameters_(parameters) {
  const std::string faults = fault(parameters.stretch_modulus, "stretch modulus", "N/m") +
                             fault(parameters.bending_modulus, "bending modulus", "J") +
                             fault(parameters.area_modulus, "area modulus", "Pa") +
                             natural_shape_fault(mesh_, parameters);
  if (!faults.empty()) {
    throw ParameterError("membrane:" + faults);
  }
  if (parameters.stretch_law == StretchLaw::linear) {
    stretch_ = Stretch{parameters.stretch_modulus};
  } else if (parameters.stretch_law == StretchLaw::line_element) {
    stretch_ = LineElementStretch{parameters.stretch_modulus * mesh_.rest_perimeter / mesh_.nodes};
  }
  if (parameters.bending_law == BendingLaw::turning_angle) {
    bending_ = TurningAngleBending{parameters.bending_modulus};
  } else {
    bending_ = HalfAngleBending{parameters.bending_modulus};
  }
  if (parameters.area_law == AreaLaw::penalty) {
    area_ = AreaPenalty{parameters.area_modulus};
  }
}

MembraneEnergy RingMembrane::energy(std::span<const Vector<2>> positions) const {
  RingGeometry ring = measured(positions, mesh_);
  MembraneEnergy sum;
  with_stretch(stretch_, [&](const auto& law) { sum.stretch = micro::energy(law, mesh_, ring); });
  sum.bending =
      std::visit([&](const auto& law) { return micro::energy(law, mesh_, ring); }, bending_);
  if (area_) {
    sum.area = micro::energy(*area_, mesh_, ring);
  }
  return sum;
}

void RingMembrane::forces(std::span<const Vector<2>> positions, std::span<Vector<2>> forces) const {
  RingGeometry ring = measured(positions, mesh_);
  with_stretch(stretch_, [&](const auto& law) { add_loads(law, mesh_, ring); });
  std::visit([&](const auto& law) { add_loads(law, mesh_, ring); }, bending_);
  if (area_) {
    add_loads(*area_, mesh_, ring);
  }
  const std::size_t n = positions.size();
  std::vector<double> components(2 * n);
  assemble(ring, components.data(), components.data() + n);
  for (std::size_t i = 0; i < n; ++i) {
    forces[i] = {components[i], components[n + i]};
  }
}

void RingMembrane::stiffness(std::span<const Vector<2>> positions, Compression compression,
                             RingStiffness& stiffness) const {
  RingGeometry ring = measured(positions, mesh_);
  stiffness.clear();
  with_stretch(stretch_,
               [&](const auto& law) { add_stiffness(law, mesh_, ring, compression, stiffness); });
  std::visit([&](const auto& law) { add_stiffness(law, mesh_, ring, compression, stiffness); },
             bending_);
  if (area_) {
    add_stiffness(*area_, mesh_, ring, compression, stiffness);
  }
}

std::vector<double> RingMembrane::tensions(std::span<const Vector<2>> positions) const {
  const RingGeometry ring = measured(positions, mesh_);
  std::vector<double> result(positions.size(), 0.0);
  with_stretch(stretch_, [&](const auto& law) {
    for (std::size_t j = 0; j < result.size(); ++j) {
      result[j] = tension(law, mesh_, ring, j);
    }
  });
  return result;
}

}  // namespace hemoscale::micro
