#include "micro/cells/ring_membrane.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "micro/error.hpp"
#include "tests/support/micro/rings.hpp"

namespace hemoscale::micro {
namespace {

using test::Polygon;
using testing::HasSubstr;

constexpr MembraneParameters parameters{.stretch_modulus = 3e-6,
                                        .bending_modulus = 2e-19,
                                        .natural_shape = NaturalShape::outline,
                                        .area_modulus = 40};

RingMembrane membrane_of(const Polygon& reference, const MembraneParameters& p) {
  return {make_ring_mesh(reference, p.natural_shape, p.spontaneous_curvature), p};
}

struct Forces {
  Polygon values;
  explicit Forces(const RingMembrane& membrane, const Polygon& polygon) : values(polygon.size()) {
    membrane.forces(polygon, values);
  }
};

double difference(const Polygon& a, const Polygon& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, (a[i] - b[i]).norm());
  }
  return largest;
}

template <class... Laws>
void expect_sum_of(const RingMembrane& membrane, const Polygon& polygon, const Laws&... laws) {
  const RingMesh& mesh = membrane.mesh();
  const double energy = (0.0 + ... + test::ring_energy_of(laws, mesh, polygon));
  EXPECT_NEAR(membrane.energy(polygon).total(), energy, 1e-14 * energy);
  Polygon sum(polygon.size(), Vector<2>::Zero());
  const auto add = [&](const Polygon& part) {
    for (std::size_t i = 0; i < sum.size(); ++i) {
      sum[i] += part[i];
    }
  };
  (add(test::ring_forces_of(laws, mesh, polygon)), ...);
  EXPECT_LE(difference(Forces(membrane, polygon).values, sum), 1e-13 * test::largest_norm(sum));
}

TEST(RingMembrane, adds_the_laws_of_its_parameters) {
  const Polygon reference = test::random_polygon(30, 1);
  const Polygon polygon = test::random_polygon(30, 2);
  const double mean_length = make_ring_mesh(reference, NaturalShape::flat).rest_perimeter / 30;
  MembraneParameters p = parameters;
  expect_sum_of(membrane_of(reference, p), polygon, Stretch{3e-6}, TurningAngleBending{2e-19},
                AreaPenalty{40});
  p.bending_law = BendingLaw::half_angle_tangent;
  p.stretch_law = StretchLaw::line_element;
  expect_sum_of(membrane_of(reference, p), polygon, LineElementStretch{3e-6 * mean_length},
                HalfAngleBending{2e-19}, AreaPenalty{40});
  p.stretch_law = StretchLaw::inextensible;
  p.area_law = AreaLaw::exact;
  expect_sum_of(membrane_of(reference, p), polygon, HalfAngleBending{2e-19});
  EXPECT_EQ(membrane_of(reference, p).energy(polygon).stretch, 0);
  EXPECT_EQ(membrane_of(reference, p).energy(polygon).area, 0);
}

TEST(RingMembrane, stiffness_is_overwritten_and_the_gradient_of_minus_the_force) {
  const Polygon polygon = test::random_polygon(30, 2);
  for (const StretchLaw stretch : {StretchLaw::linear, StretchLaw::inextensible}) {
    for (const AreaLaw area : {AreaLaw::penalty, AreaLaw::exact}) {
      MembraneParameters p = parameters;
      p.stretch_law = stretch;
      p.area_law = area;
      const RingMembrane membrane = membrane_of(test::random_polygon(30, 1), p);
      RingStiffness stiffness(30);
      membrane.stiffness(polygon, Compression::full, stiffness);
      membrane.stiffness(polygon, Compression::full, stiffness);
      // Along a random direction, by differences of fourth order.
      const Polygon direction = test::random_polygon(30, 3);
      Polygon product(30);
      multiply(stiffness, direction, product);
      const auto forces_at = [&](double step) {
        Polygon moved = polygon;
        for (std::size_t i = 0; i < 30; ++i) {
          moved[i] += step * direction[i];
        }
        return Forces(membrane, moved).values;
      };
      const double h = 1e-4;
      const Polygon f1 = forces_at(h);
      const Polygon b1 = forces_at(-h);
      const Polygon f2 = forces_at(2 * h);
      const Polygon b2 = forces_at(-2 * h);
      for (std::size_t i = 0; i < 30; ++i) {
        const Vector<2> slope = (8 * (f1[i] - b1[i]) - (f2[i] - b2[i])) / (12 * h);
        EXPECT_LE((product[i] + slope).norm(), 1e-7 * test::largest_norm(product));
      }
    }
  }
}

TEST(RingStiffness, multiplies_like_its_dense_matrix) {
  for (const int nodes : {3, 4, 5, 30}) {
    const auto count = static_cast<std::size_t>(nodes);
    const RingMembrane membrane = membrane_of(test::regular_polygon(nodes, 3e-6), parameters);
    RingStiffness stiffness(count);
    membrane.stiffness(test::random_polygon(nodes, 2), Compression::full, stiffness);
    const Polygon x = test::random_polygon(nodes, 3);
    Polygon product(count);
    multiply(stiffness, x, product);
    const Eigen::MatrixXd matrix = dense(stiffness);
    const Eigen::VectorXd expected =
        matrix * Eigen::Map<const Eigen::VectorXd>(x[0].data(), 2 * nodes);
    for (std::size_t i = 0; i < count; ++i) {
      const Vector<2> part = expected.segment<2>(static_cast<Eigen::Index>(2 * i));
      EXPECT_LE((product[i] - part).norm(), 1e-13 * expected.norm());
    }
  }
}

// A ring that is 10 % larger than at rest: the tension of every segment is E_l / 10.
TEST(RingMembrane, tension_is_the_modulus_times_the_strain) {
  const Polygon larger = test::regular_polygon(30, 3.3e-6);
  for (const StretchLaw law : {StretchLaw::linear, StretchLaw::line_element}) {
    MembraneParameters p = parameters;
    p.stretch_law = law;
    for (const double t : membrane_of(test::regular_polygon(30, 3e-6), p).tensions(larger)) {
      EXPECT_NEAR(t, 3e-7, 1e-19);
    }
  }
  MembraneParameters p = parameters;
  p.stretch_law = StretchLaw::inextensible;
  for (const double t : membrane_of(test::regular_polygon(30, 3e-6), p).tensions(larger)) {
    EXPECT_EQ(t, 0);
  }
}

std::string message_of(const MembraneParameters& p) {
  try {
    membrane_of(test::regular_polygon(30, 3e-6), p);
  } catch (const ParameterError& error) {
    return error.what();
  }
  return "nothing";
}

TEST(RingMembrane, names_all_moduli_that_are_not_admissible) {
  EXPECT_EQ(message_of(parameters), "nothing");
  MembraneParameters p = parameters;
  p.stretch_modulus = -1e-6;
  p.bending_modulus = std::numeric_limits<double>::quiet_NaN();
  p.area_modulus = std::numeric_limits<double>::infinity();
  const std::string message = message_of(p);
  EXPECT_THAT(message, HasSubstr("stretch modulus is -1e-06 N/m"));
  EXPECT_THAT(message, HasSubstr("bending modulus is nan J"));
  EXPECT_THAT(message, HasSubstr("area modulus is inf Pa"));
  EXPECT_THAT(message, HasSubstr("choose 0 for none"));
  p = parameters;
  p.stretch_modulus = p.bending_modulus = p.area_modulus = 0;
  EXPECT_EQ(message_of(p), "nothing");
}

TEST(RingMembrane, wants_the_mesh_of_its_natural_shape) {
  const Polygon circle = test::regular_polygon(30, 3e-6);
  MembraneParameters p = parameters;
  p.natural_shape = NaturalShape::curvature;
  p.spontaneous_curvature = 2e5;
  EXPECT_EQ(message_of(p), "nothing");
  EXPECT_THROW(RingMembrane(make_ring_mesh(circle, NaturalShape::flat), p), ParameterError);
  p.natural_shape = NaturalShape::flat;
  EXPECT_THROW(RingMembrane(make_ring_mesh(circle, NaturalShape::flat), p), ParameterError);
  p.spontaneous_curvature = 0;
  EXPECT_EQ(message_of(p), "nothing");
  EXPECT_THROW(RingMembrane(make_ring_mesh(circle, NaturalShape::outline), p), ParameterError);
}

TEST(RingMembrane, wants_one_position_for_each_node) {
  const RingMembrane membrane = membrane_of(test::regular_polygon(30, 3e-6), parameters);
  EXPECT_THROW(membrane.energy(test::regular_polygon(29, 3e-6)), ParameterError);
}

}  // namespace
}  // namespace hemoscale::micro
