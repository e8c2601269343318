#include "micro/cells/outline.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "micro/cells/ring_mesh.hpp"
#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

// Perimeter 19.27 um and area 13.63 um^2 of the section of Evans and Fung with R = 3.91 um.
TEST(Outline, evans_fung_has_the_known_section) {
  const RingMesh mesh = make_ring_mesh(outline_nodes({}, 1000), NaturalShape::outline);
  EXPECT_NEAR(mesh.rest_perimeter, 19.27e-6, 0.006e-6);
  EXPECT_NEAR(mesh.rest_area, 13.63e-12, 0.006e-12);
}

TEST(Outline, nodes_lie_on_the_curve_equally_spaced) {
  const OutlineParameters section;
  const double radius = 0.5 * section.length;
  const auto nodes = outline_nodes(section, 400);
  const RingMesh mesh = make_ring_mesh(nodes, NaturalShape::outline);
  for (const auto& node : nodes) {
    const double s = std::pow(node.x() / radius, 2);
    const double z = 0.5 * radius * std::sqrt(std::max(0.0, 1 - s)) *
                     (0.207161 + 2.002558 * s - 1.122762 * s * s);
    EXPECT_NEAR(std::abs(node.y()), z, 1e-7 * radius);
  }
  // Chords are shorter than arcs by (curvature * spacing)^2 / 24.
  const double spacing = mesh.rest_perimeter / 400;
  for (const double length : mesh.rest_length) {
    EXPECT_NEAR(length, spacing, 2e-3 * spacing);
  }
  EXPECT_NEAR(nodes[0].x(), radius, 1e-12 * radius);
  EXPECT_NEAR(nodes[200].x(), -radius, 1e-9 * radius);
}

TEST(Outline, a_round_ellipse_is_a_circle) {
  const auto nodes = outline_nodes({.outline = Outline::ellipse, .length = 2e-6, .aspect = 1}, 12);
  for (std::size_t i = 0; i < 12; ++i) {
    const double angle = 2 * 3.14159265358979323846 * static_cast<double>(i) / 12;
    EXPECT_NEAR(nodes[i].x(), 1e-6 * std::cos(angle), 1e-17);
    EXPECT_NEAR(nodes[i].y(), 1e-6 * std::sin(angle), 1e-17);
  }
}

TEST(Outline, refuses_what_is_no_outline) {
  EXPECT_THROW(outline_nodes({}, 7), ParameterError);
  EXPECT_NO_THROW(outline_nodes({}, 8));
  EXPECT_THROW(outline_nodes({.length = 0}, 8), ParameterError);
  EXPECT_THROW(outline_nodes({.length = std::numeric_limits<double>::quiet_NaN()}, 8),
               ParameterError);
  EXPECT_THROW(outline_nodes({.outline = Outline::ellipse, .aspect = 1.5}, 8), ParameterError);
  EXPECT_THROW(outline_nodes({.outline = Outline::ellipse, .aspect = 0}, 8), ParameterError);
}

}  // namespace
}  // namespace hemoscale::micro
