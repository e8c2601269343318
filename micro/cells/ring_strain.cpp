#include "micro/cells/ring_strain.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "micro/error.hpp"

namespace hemoscale::micro {

RingStrain measure_strain(std::span<const Vector<2>> nodes, const RingMesh& mesh) {
  const std::size_t n = nodes.size();
  if (n != mesh.rest_length.size()) {
    throw ParameterError(fmt::format("{} positions for a ring of {} nodes; give one for each node",
                                     n, mesh.rest_length.size()));
  }
  RingStrain strain;
  strain.smallest_stretch = std::numeric_limits<double>::infinity();
  double perimeter = 0;
  double sectors = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Vector<2> here = nodes[i] - nodes[0];
    const Vector<2> next = nodes[(i + 1) % n] - nodes[0];
    const double length = (next - here).norm();
    const double stretch = length / mesh.rest_length[i];
    strain.smallest_stretch = std::min(strain.smallest_stretch, stretch);
    strain.largest_stretch = std::max(strain.largest_stretch, stretch);
    perimeter += length;
    sectors += here.x() * next.y() - here.y() * next.x();
  }
  strain.mean_stretch = perimeter / mesh.rest_perimeter;
  strain.length_error =
      std::max(std::abs(strain.largest_stretch - 1), std::abs(strain.smallest_stretch - 1));
  strain.perimeter_error = strain.mean_stretch - 1;
  strain.area_error = 0.5 * sectors / mesh.rest_area - 1;
  return strain;
}

}  // namespace hemoscale::micro
