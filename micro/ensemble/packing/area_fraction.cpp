#include "micro/ensemble/packing/area_fraction.hpp"

#include <fmt/core.h>

#include "micro/cells/outline.hpp"
#include "micro/cells/outline_checks.hpp"
#include "micro/error.hpp"

namespace hemoscale::micro {

double area_fraction(std::size_t cells, double cell_area, const Box& box) {
  return static_cast<double>(cells) * cell_area / box.area();
}

std::string describe_fraction(std::size_t cells, double cell_area, const Box& box) {
  return fmt::format("{} cells of {:.4g} m^2 would fill {:.3g} of the {} of {:.4g} m by {:.4g} m",
                     cells, cell_area, area_fraction(cells, cell_area, box),
                     box.walls ? "channel" : "box", box.length, box.height);
}

std::string fraction_remedy(std::size_t cells, const Box& box) {
  const OutlineParameters thin{.outline = Outline::deflated, .length = 7e-6, .reduced_area = 0.3};
  const double area = enclosed_area(outline_nodes(thin, 100));
  return fmt::format(
      "use fewer cells, a longer channel, or a thinner outline: deflated to the reduced area {} at "
      "a length of {:.2g} m (micro.shape.outline) a cell has {:.3g} m^2, and {} of them fill "
      "{:.3g}",
      thin.reduced_area, thin.length, area, cells, area_fraction(cells, area, box));
}

void require_possible_fraction(std::size_t cells, double cell_area, const Box& box) {
  const double fraction = area_fraction(cells, cell_area, box);
  if (fraction <= largest_area_fraction) return;
  throw ParameterError(
      fmt::format("packing: {}; at most {} can be packed, since red cells at rest "
                  "leave gaps; {}",
                  describe_fraction(cells, cell_area, box), largest_area_fraction,
                  fraction_remedy(cells, box)));
}

}  // namespace hemoscale::micro
