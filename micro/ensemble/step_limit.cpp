#include "micro/ensemble/step_limit.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "micro/cells/half_angle_bending.hpp"
#include "micro/ensemble/check_parameters.hpp"

namespace hemoscale::micro {

double ring_stiffness(const RingMesh& mesh, const RingMesh& natural_outline,
                      const MembraneParameters& membrane) {
  const double l0 = *std::min_element(mesh.rest_length.begin(), mesh.rest_length.end());
  double stiffening = 1;
  if (membrane.bending_law == BendingLaw::half_angle_tangent) {
    for (std::size_t i = 0; i < mesh.natural_half_tangent.size(); ++i) {
      const double t = half_tangent_of_difference(natural_outline.natural_half_tangent[i],
                                                  mesh.natural_half_tangent[i]);
      stiffening = std::max(stiffening, (1 + t * t) * (1 + 3 * t * t));
    }
  }
  const double stretch = 4 * membrane.stretch_modulus / l0;
  const double bending = 16 * membrane.bending_modulus * stiffening / (l0 * l0 * l0);
  const double area = membrane.area_modulus * mesh.rest_perimeter * mesh.rest_perimeter /
                      (mesh.nodes * mesh.rest_area);
  return std::max({stretch, bending, area});
}

double contact_stiffness(const ContactLaw& law, double spacing) {
  constexpr int distances = 200;
  constexpr int offsets = 20;
  const double cutoff = cutoff_of(law);
  const int reach = static_cast<int>(cutoff / spacing) + 1;
  double largest = 0;
  for (int i = 0; i <= distances; ++i) {
    const double h = cutoff * i / distances;
    for (int j = 0; j <= offsets; ++j) {
      const double offset = 0.5 * spacing * j / offsets;
      double across = 0;
      double along = 0;
      for (int k = -reach; k <= reach; ++k) {
        const double a = k * spacing + offset;
        const double s = h * h + a * a;
        if (s >= cutoff * cutoff || s <= 0) {
          continue;
        }
        const double normal = pair_curvature(law, s);
        const double transverse = -force_over_distance(law, s);
        across += (normal * h * h + transverse * a * a) / s;
        along += (normal * a * a + transverse * h * h) / s;
      }
      largest = std::max({largest, across, along});
    }
  }
  return 2 * largest;
}

StepLimit step_limit(const EnsembleParameters& p) {
  require_admissible(p);
  const std::vector<Vector<2>> outline = outline_nodes(p.outline, p.nodes);
  const RingMesh mesh = make_ring_mesh(outline, p.membrane.natural_shape);
  const RingMesh natural = make_ring_mesh(outline, NaturalShape::outline);
  StepLimit limit;
  limit.drag = p.drag.coefficient * p.plasma_viscosity;
  if (p.drag.convention == DragConvention::cell) {
    limit.drag /= p.nodes;
  }
  limit.ring = ring_stiffness(mesh, natural, p.membrane);
  const PairPotential potential = make_pair_potential(p.contact.stiffness, p.contact.rest_distance,
                                                      p.contact.cutoff, p.contact.attraction);
  limit.contact = contact_stiffness(potential, mesh.rest_perimeter / p.nodes);
  if (std::holds_alternative<PlaneChannel>(p.domain)) {
    limit.wall = p.wall.stiffness;
  }
  limit.time_step = 2 * limit.drag / (limit.ring + limit.contact + limit.wall);
  return limit;
}

}  // namespace hemoscale::micro
