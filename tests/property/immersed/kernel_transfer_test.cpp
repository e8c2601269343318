#include <gtest/gtest.h>

#include <numeric>

#include "micro/error.hpp"
#include "micro/immersed/kernel_transfer.hpp"
#include "micro/mps/node_domains.hpp"
#include "micro/random/philox.hpp"

namespace hemoscale::micro {
namespace {

double random(std::uint64_t stream, std::size_t counter) {
  return 2 * uniform({.seed = 3, .stream = stream, .counter = counter}) - 1;
}

struct Case {
  const char* name;
  bool is_joined;
  double disorder;
  TransferKernel kernel;
};

void PrintTo(const Case& each, std::ostream* out) {
  *out << each.name;
}

/// Channel 6 x 4 of unit height scale with points all over it, on the walls too.
class Transfer : public testing::TestWithParam<Case> {
 protected:
  static constexpr double spacing = 0.25;
  Transfer()
      : domain(channel_nodes(6, 4, GetParam().is_joined,
                             {.spacing = spacing, .disorder = GetParam().disorder, .seed = 4})),
        transfer(domain.particles, domain.box, spacing, GetParam().kernel) {
    for (std::size_t k = 0; k < 200; ++k) {
      const double x = GetParam().is_joined ? 9 * random(0, k) : 3 + 2.99 * random(0, k);
      points.emplace_back(x, 2 + 2 * random(1, k));
    }
    points.emplace_back(3, 0);
    points.emplace_back(2.6, 4);
  }
  FlowDomain<2> domain;
  KernelTransfer transfer;
  std::vector<Vector<2>> points;
};

INSTANTIATE_TEST_SUITE_P(, Transfer,
                         testing::Values(Case{"lattice", true, 0, TransferKernel::four_point},
                                         Case{"disordered", true, 0.2, TransferKernel::four_point},
                                         Case{"open", false, 0.2, TransferKernel::four_point},
                                         Case{"narrow", true, 0.2, TransferKernel::three_point}),
                         [](const auto& each) { return each.param.name; });

TEST_P(Transfer, spreading_is_the_adjoint_of_interpolation) {
  constexpr double density = 7;
  std::vector<Vector<2>> field(domain.particles.size());
  for (std::size_t i = 0; i < field.size(); ++i) field[i] = {random(2, i), random(3, i)};
  std::vector<Vector<2>> forces(points.size());
  for (std::size_t k = 0; k < forces.size(); ++k) forces[k] = {random(4, k), random(5, k)};
  const KernelRows rows = transfer.rows(points);
  const std::vector<Vector<2>> seen = transfer.interpolate(rows, field);
  std::vector<Vector<2>> accelerations(field.size(), Vector<2>::Zero());
  transfer.spread(rows, forces, density, accelerations);
  double at_points = 0;
  double scale = 0;
  for (std::size_t k = 0; k < forces.size(); ++k) {
    at_points += forces[k].dot(seen[k]);
    scale += std::abs(forces[k].dot(seen[k]));
  }
  double at_nodes = 0;
  for (std::size_t i = 0; i < field.size(); ++i) {
    at_nodes += density * transfer.areas()[i] * accelerations[i].dot(field[i]);
  }
  EXPECT_NEAR(at_points, at_nodes, 1e-12 * scale);
  EXPECT_GT(std::abs(at_points), 1e-3 * scale);
}

TEST_P(Transfer, keeps_force_and_torque) {
  const double density = 2;
  const KernelRows rows = transfer.rows(points);
  for (std::size_t k = 0; k < points.size(); k += 17) {
    std::vector<Vector<2>> forces(points.size(), Vector<2>::Zero());
    forces[k] = {0.3, -0.8};
    std::vector<Vector<2>> accelerations(domain.particles.size(), Vector<2>::Zero());
    transfer.spread(rows, forces, density, accelerations);
    Vector<2> force = Vector<2>::Zero();
    double torque = 0;  // around the point
    for (std::size_t i = 0; i < accelerations.size(); ++i) {
      const Vector<2> f = density * transfer.areas()[i] * accelerations[i];
      const Vector<2> r = separation(domain.box, points[k], domain.particles.positions[i]);
      force += f;
      torque += r[0] * f[1] - r[1] * f[0];
    }
    EXPECT_NEAR((force - forces[k]).norm(), 0, 1e-13);
    EXPECT_NEAR(torque, 0, 1e-13);
  }
}

TEST_P(Transfer, interpolates_linear_fields_exactly) {
  if (GetParam().is_joined) {
    // Across the joint only y is linear.
    std::vector<Vector<2>> field;
    for (const Vector<2>& x : domain.particles.positions) field.emplace_back(1 + 2 * x[1], -x[1]);
    const std::vector<Vector<2>> seen = transfer.interpolate(transfer.rows(points), field);
    for (std::size_t k = 0; k < points.size(); ++k) {
      EXPECT_NEAR(seen[k][0], 1 + 2 * points[k][1], 1e-12);
      EXPECT_NEAR(seen[k][1], -points[k][1], 1e-12);
    }
    return;
  }
  const std::vector<Vector<2>> seen =
      transfer.interpolate(transfer.rows(points), domain.particles.positions);
  for (std::size_t k = 0; k < points.size(); ++k) {
    EXPECT_NEAR((seen[k] - points[k]).norm(), 0, 1e-12);
  }
}

TEST_P(Transfer, areas_add_up_to_the_domain) {
  const double sum = std::accumulate(transfer.areas().begin(), transfer.areas().end(), 0.0);
  EXPECT_NEAR(sum, 24, 1e-9);
  if (GetParam().disorder > 0) return;
  for (std::size_t i = 0; i < domain.particles.size(); ++i) {
    const bool is_wall = domain.particles.kinds[i] == ParticleKind::wall;
    EXPECT_NEAR(transfer.areas()[i], (is_wall ? 0.5 : 1) * spacing * spacing, 1e-12);
  }
}

TEST_P(Transfer, a_point_outside_the_fluid_is_named) {
  const std::vector<Vector<2>> outside = {{3, 4.6}};
  EXPECT_THROW(transfer.rows(outside), NumericalError);
}

TEST(TransferAreas, leave_out_what_is_behind_a_curved_wall) {
  const FlowDomain<2> domain = cylinder_nodes(8, 4, 1, 4, true, {.spacing = 0.2});
  const KernelTransfer transfer(domain.particles, domain.box, 0.2, TransferKernel::four_point);
  const double sum = std::accumulate(transfer.areas().begin(), transfer.areas().end(), 0.0);
  EXPECT_NEAR(sum, 32 - 3.14159, 0.05);
}

TEST(TransferBox, a_sliding_or_narrow_box_is_refused) {
  FlowDomain<2> box = periodic_nodes<2>({4, 4}, {.spacing = 0.5});
  EXPECT_NO_THROW(KernelTransfer(box.particles, box.box, 0.5, TransferKernel::four_point));
  EXPECT_THROW(KernelTransfer(box.particles, box.box, 0.9, TransferKernel::four_point),
               ParameterError);
  box.box.slide = 0.1;
  EXPECT_THROW(KernelTransfer(box.particles, box.box, 0.5, TransferKernel::four_point),
               ParameterError);
}

}  // namespace
}  // namespace hemoscale::micro
