#include "micro/immersed/stokes_nodes.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <complex>
#include <numbers>

#include "micro/error.hpp"
#include "tests/support/immersed/implicit_runs.hpp"

namespace hemoscale::micro {
namespace {

using std::numbers::pi;
using Complex = std::complex<double>;
using Points = std::vector<Vector<2>>;

// In units of the channel height, the viscosity and the force.
constexpr Fluid fluid{.density = 1, .kinematic_viscosity = 1};
constexpr double length = 3;

FlowDomain<2> channel(double rows, bool is_periodic = true) {
  return channel_nodes(length, 1, is_periodic, {.spacing = 1 / rows});
}

StokesNodes nodes_of(FlowDomain<2> domain) {
  return {std::move(domain), fluid, test::stokes_options()};
}

/// Point forces, with their images at distances of the channel's length or alone.
struct PointForces {
  StokesKernel kernel;
  Points places, forces;

  FlowValues operator()(const Points& at) const {
    FlowValues flow{Points(at.size(), Vector<2>::Zero()), std::vector<double>(at.size(), 0.0)};
    std::visit(
        [&](const auto& k) {
          for (std::size_t i = 0; i < at.size(); ++i) {
            for (std::size_t j = 0; j < places.size(); ++j) {
              const Vector<2> r = at[i] - places[j];
              const LogPotential a = k(r);
              flow.velocities[i] += stokeslet(a, r.y()) * forces[j] / (4 * pi);
              flow.pressures[i] += pressure_of_force(a).dot(forces[j]) / (4 * pi);
            }
          }
        },
        kernel);
    return flow;
  }
};

/// A force along the channel and a pair across it, as near to the wall as gaps of cells are wide.
PointForces some_forces(StokesKernel kernel) {
  return {std::move(kernel),
          {{1.3, 0.35}, {1.5, 0.7}, {1.6, 0.55}},
          {{1, 0}, {0.4, 0.8}, {-0.4, -0.8}}};
}

/// The reaction of the two walls of a periodic channel, wave by wave along x: a stream function
/// ((a + b y) e^(-ky) + (c + d z) e^(-kz)) e^(ikx), z = 1 - y, for each, without growth of the
/// pressure from period to period. From 256 values on each wall: exact to rounding.
class ExactReaction {
 public:
  explicit ExactReaction(const PointForces& forces, double period = length) {
    constexpr int count = 256;
    Points walls;
    for (const double y : {0.0, 1.0}) {
      for (int i = 0; i < count; ++i) walls.emplace_back(period * i / count, y);
    }
    const FlowValues imposed = forces(walls);
    for (int n = 0; n <= 40; ++n) {
      Eigen::Vector4cd given = Eigen::Vector4cd::Zero();  // u, v below; u, v above
      for (int i = 0; i < 2 * count; ++i) {
        const Complex phase = std::polar(1.0 / count, -2 * pi * n * i / count);
        const int row = i < count ? 0 : 2;
        given[row] -= phase * imposed.velocities[static_cast<std::size_t>(i)].x();
        given[row + 1] -= phase * imposed.velocities[static_cast<std::size_t>(i)].y();
      }
      if (n == 0) {
        below_ = given[0].real();
        above_ = given[2].real();
        continue;
      }
      const double k = 2 * pi * n / period;
      Eigen::Matrix4cd m;
      m << velocity(k, 0), velocity(k, 1);
      waves_.push_back({k, m.partialPivLu().solve(given)});
    }
  }

  Vector<2> velocity_at(const Vector<2>& x) const {
    Vector<2> sum(below_ + (above_ - below_) * x.y(), 0);
    for (const auto& [k, c] : waves_) {
      const Eigen::Vector2cd u = velocity(k, x.y()) * c * std::polar(2.0, k * x.x());
      sum += u.real();
    }
    return sum;
  }

  double pressure_at(const Vector<2>& x) const {
    double sum = 0;
    for (const auto& [k, c] : waves_) {
      const Complex p = -2.0 * Complex(0, k) *
                        (c[1] * std::exp(-k * x.y()) - c[3] * std::exp(-k * (1 - x.y()))) *
                        std::polar(2.0, k * x.x());
      sum += p.real();
    }
    return sum;
  }

 private:
  struct Wave {
    double k;
    Eigen::Vector4cd coefficients;
  };

  /// u = d psi/dy and v = -d psi/dx over e^(ikx) by the four coefficients.
  static Eigen::Matrix<Complex, 2, 4> velocity(double k, double y) {
    const double z = 1 - y;
    const double below = std::exp(-k * y);
    const double above = std::exp(-k * z);
    Eigen::Matrix<Complex, 2, 4> m;
    m.row(0) << -k * below, (1 - k * y) * below, k * above, (k * z - 1) * above;
    m.row(1) << below, y * below, above, z * above;
    m.row(1) *= Complex(0, -k);
    return m;
  }

  double below_ = 0;
  double above_ = 0;
  std::vector<Wave> waves_;
};

/// Largest errors among the points where cells are.
struct Errors {
  double velocity = 0;
  double pressure = 0;
};

const Points inner = {{0.1, 0.5}, {1.3, 0.2}, {1.3, 0.36}, {1.45, 0.8},
                      {1.6, 0.5}, {2.2, 0.1}, {1.5, 0.9},  {2.9, 0.3}};

Errors channel_errors(double rows) {
  const StokesNodes nodes = nodes_of(channel(rows));
  const PointForces forces = some_forces(PeriodicKernel{length});
  const FlowValues reaction = nodes.reaction(forces);
  const ExactReaction exact(forces);
  const SampleWeights weights = nodes.sample(inner);
  // The pressure is known up to a constant.
  const double level = weights.sample(0, reaction.pressures) - exact.pressure_at(inner[0]);
  Errors errors;
  for (std::size_t i = 0; i < inner.size(); ++i) {
    errors.velocity =
        std::max(errors.velocity,
                 (weights.sample(i, reaction.velocities) - exact.velocity_at(inner[i])).norm());
    errors.pressure = std::max(errors.pressure, std::abs(weights.sample(i, reaction.pressures) -
                                                         level - exact.pressure_at(inner[i])));
  }
  return errors;
}

TEST(StokesNodes, reaction_of_a_channel_is_of_second_order) {
  const Errors coarse = channel_errors(10);
  const Errors middle = channel_errors(20);
  const Errors fine = channel_errors(40);
  EXPECT_LT(middle.velocity, 1e-3);
  EXPECT_GT(std::log2(coarse.velocity / middle.velocity), 1.8);
  EXPECT_GT(std::log2(middle.velocity / fine.velocity), 1.8);
  EXPECT_GT(std::log2(middle.pressure / fine.pressure), 1.5);
}

TEST(StokesNodes, forces_and_reaction_rest_on_the_walls) {
  const StokesNodes nodes = nodes_of(channel(20));
  const PointForces forces = some_forces(PeriodicKernel{length});
  const FlowValues reaction = nodes.reaction(forces);
  const FlowValues imposed = forces(nodes.nodes().positions);
  double largest = 0;
  std::size_t walls = 0;
  for (std::size_t i = 0; i < nodes.nodes().size(); ++i) {
    if (nodes.nodes().kinds[i] != ParticleKind::wall) continue;
    largest = std::max(largest, (reaction.velocities[i] + imposed.velocities[i]).norm());
    ++walls;
  }
  EXPECT_EQ(walls, 120U);
  EXPECT_LT(largest, 1e-9);
}

// An inlet at rest lets no net flow through: that of the periodic channel less the parabola which
// carries it. Beyond a height from the forces the openings are not felt (they fade by
// exp(-4.2 x)).
TEST(StokesNodes, reaction_between_inlet_and_outlet_is_of_second_order) {
  const PointForces images = some_forces(PeriodicKernel{length});
  const PointForces alone = some_forces(PlaneKernel{});
  const ExactReaction exact(images);
  // Flow rate of the total by the reciprocal theorem, int 6 y (1 - y) F_x / (12 length).
  double rate = 0;
  for (std::size_t j = 0; j < images.places.size(); ++j) {
    const double y = images.places[j].y();
    rate += y * (1 - y) / 2 * images.forces[j].x() / length;
  }
  const Points middle_points = {{1.3, 0.2}, {1.45, 0.8}, {1.6, 0.5}, {1.5, 0.9}, {1.2, 0.6}};
  const auto error = [&](double rows) {
    const StokesNodes nodes = nodes_of(channel(rows, false));
    const FlowValues reaction = nodes.reaction(alone);
    const SampleWeights weights = nodes.sample(middle_points);
    const FlowValues free = alone(middle_points);
    const FlowValues with_images = images(middle_points);
    double largest = 0;
    for (std::size_t i = 0; i < middle_points.size(); ++i) {
      const double y = middle_points[i].y();
      const Vector<2> expected = exact.velocity_at(middle_points[i]) + with_images.velocities[i] -
                                 Vector<2>(6 * y * (1 - y) * rate, 0);
      const Vector<2> u = weights.sample(i, reaction.velocities) + free.velocities[i];
      largest = std::max(largest, (u - expected).norm());
    }
    return largest;
  };
  const double coarse = error(10);
  const double middle = error(20);
  const double fine = error(40);
  EXPECT_LT(middle, 2e-3);
  EXPECT_GT(std::log2(coarse / middle), 1.7);
  EXPECT_GT(std::log2(middle / fine), 1.7);
}

// What is imposed at an outlet holds on a mirror: no pressure, no velocity along it, no change of
// the velocity across it. Forces before it and their images behind it, in a channel of twice the
// length.
TEST(StokesNodes, reaction_of_an_outlet_is_that_of_a_mirror) {
  const Points places = {{2.6, 0.3}, {2.75, 0.7}};
  const Points forces = {{0.7, 0.5}, {-0.7, 0.6}};
  const PointForces alone{PlaneKernel{}, places, forces};
  PointForces mirrored{PeriodicKernel{2 * length}, places, forces};
  double rate = 0;
  for (std::size_t j = 0; j < places.size(); ++j) {
    mirrored.places.emplace_back(2 * length - places[j].x(), places[j].y());
    mirrored.forces.emplace_back(forces[j].x(), -forces[j].y());
    rate += places[j].y() * (1 - places[j].y()) / 2 * 2 * forces[j].x() / (2 * length);
  }
  const ExactReaction exact(mirrored, 2 * length);
  const Points before = {{2.9, 0.3}, {2.95, 0.5}, {2.8, 0.85}, {2.7, 0.5}, {2.98, 0.7}};
  const FlowValues with_images = mirrored(before);
  const FlowValues free = alone(before);
  const auto error = [&](double rows) {
    const StokesNodes nodes = nodes_of(channel(rows, false));
    const FlowValues reaction = nodes.reaction(alone);
    const SampleWeights weights = nodes.sample(before);
    double largest = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
      const double y = before[i].y();
      const Vector<2> expected = exact.velocity_at(before[i]) + with_images.velocities[i] -
                                 Vector<2>(6 * y * (1 - y) * rate, 0);
      const Vector<2> u = weights.sample(i, reaction.velocities) + free.velocities[i];
      largest = std::max(largest, (u - expected).norm());
    }
    return largest;
  };
  const double coarse = error(20);
  const double middle = error(40);
  const double fine = error(80);
  EXPECT_LT(coarse, 2e-3);
  EXPECT_GT(std::log2(coarse / middle), 1.6);
  EXPECT_GT(std::log2(middle / fine), 1.8);
}

TEST(StokesNodes, reaction_beside_a_cylinder_is_of_second_order) {
  const PointForces forces{PeriodicKernel{2}, {{0.5, 0.3}, {0.62, 0.8}}, {{1, 0.3}, {-0.6, 0.2}}};
  const Points points = {{0.3, 0.5}, {0.7, 0.2}, {0.75, 0.75}, {1.3, 0.5}, {1.0, 0.15}};
  std::vector<Points> solutions;
  for (const double rows : {14.0, 28.0, 56.0}) {
    const StokesNodes nodes = nodes_of(cylinder_nodes(2, 1, 0.2, 1, true, {.spacing = 1 / rows}));
    const FlowValues reaction = nodes.reaction(forces);
    const SampleWeights weights = nodes.sample(points);
    Points u;
    for (std::size_t i = 0; i < points.size(); ++i) {
      u.push_back(weights.sample(i, reaction.velocities));
    }
    solutions.push_back(u);
  }
  std::vector<double> errors;
  for (std::size_t k = 0; k + 1 < solutions.size(); ++k) {
    double error = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      error = std::max(error, (solutions[k][i] - solutions.back()[i]).norm());
    }
    errors.push_back(error);
  }
  EXPECT_LT(errors[1], 5e-4);
  // The finest is no more than four times as near.
  EXPECT_GT(std::log2(errors[0] / errors[1]), 1.8);
}

TEST(StokesNodes, background_is_the_parabola_of_its_force) {
  FlowDomain<2> domain = channel(10);
  domain.acceleration = [](double) { return Vector<2>(12, 0); };
  const StokesNodes nodes = nodes_of(std::move(domain));
  const FlowValues flow = nodes.background(0);
  for (std::size_t i = 0; i < nodes.nodes().size(); ++i) {
    const double y = nodes.nodes().positions[i].y();
    EXPECT_NEAR(flow.velocities[i].x(), 6 * y * (1 - y), 1e-8);
    EXPECT_NEAR(flow.velocities[i].y(), 0, 1e-8);
  }
}

TEST(StokesNodes, refuses_flows_that_are_not_of_stokes) {
  for (const int fault : {0, 1, 2, 3}) {
    StageOptions options = test::stokes_options();
    if (fault == 0) options.inertia = Inertia::unsteady;
    if (fault == 1) options.coupling = PressureCoupling::incremental;
    if (fault == 2) options.motion = NodeMotion::lagrangian;
    Fluid of = fluid;
    if (fault == 3) of.kinematic_viscosity = 0;
    EXPECT_THROW(StokesNodes(channel(10), of, options), ParameterError) << fault;
  }
}

}  // namespace
}  // namespace hemoscale::micro
