#include "micro/ensemble/observables/orientation.hpp"

#include <cmath>

namespace hemoscale::micro {

Orientation orientation(std::span<const CellShape> shapes, double axis) {
  double cosine = 0;
  double sine = 0;
  for (const CellShape& shape : shapes) {
    const double mirror = shape.centre.y() > axis ? -1 : 1;
    cosine += std::cos(2 * shape.inclination);
    sine += mirror * std::sin(2 * shape.inclination);
  }
  const auto cells = static_cast<double>(shapes.size());
  return {.order = std::hypot(cosine, sine) / cells,
          .angle = 0.5 * std::atan2(sine, cosine),
          .along_flow = cosine / cells};
}

}  // namespace hemoscale::micro
