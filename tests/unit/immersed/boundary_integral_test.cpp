#include "micro/immersed/boundary_integral.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>
#include <numbers>

#include "micro/immersed/flat_points.hpp"
#include "tests/support/immersed/implicit_runs.hpp"

namespace hemoscale::micro {
namespace {

using std::numbers::pi;
using Complex = std::complex<double>;
using Points = std::vector<Vector<2>>;

constexpr double viscosity = 1.3;

Points ellipse(double a, double b, int nodes) {
  Points points = test::circle(1, nodes);
  for (Vector<2>& x : points) x = {a * x.x(), b * x.y()};
  return points;
}

struct Ring {
  explicit Ring(const Points& nodes)
      : quadrature(nodes.size()), contour(quadrature.contour(nodes)) {}

  Eigen::MatrixXd single(const StokesKernel& kernel) const {
    return single_layer(quadrature, contour, kernel, viscosity);
  }

  /// Forces on the nodes of a force per length.
  template <typename Density>
  Points forces(const Density& density) const {
    Points result;
    for (std::size_t i = 0; i < contour.size(); ++i) {
      result.emplace_back(contour.lengths[i] * density(i));
    }
    return result;
  }

  RingQuadrature quadrature;
  RingContour contour;
};

/// Uneven around the ring in all its parts.
Vector<2> uneven(double angle) {
  return {std::cos(2 * angle) + 0.3 * std::sin(3 * angle), std::exp(std::sin(angle)) - 0.4};
}

std::vector<StokesKernel> kernels() {
  return {PlaneKernel{}, PeriodicKernel{7}};
}

// With f = c e^(ik phi) in complex notation along a circle of radius a:
//   4 mu u / a = c e^(ik phi) / |k|            (k = 0: c (1 - 2 ln a)),
//   less conj(c) e^(i phi) for k = 1.
TEST(SingleLayer, of_waves_of_force_on_a_circle_is_exact) {
  const double a = 1.7;
  for (const int nodes : {24, 25}) {
    const Ring ring(test::circle(a, nodes));
    const Eigen::MatrixXd matrix = ring.single(PlaneKernel{});
    for (int k = -11; k <= 11; ++k) {
      const Complex c(0.8, -0.5);
      Points forces;
      Points expected;
      for (int i = 0; i < nodes; ++i) {
        const double phi = 2 * pi * i / nodes;
        const Complex f = c * std::polar(2 * pi * a / nodes, k * phi);
        Complex u =
            c * (k == 0 ? 1 - 2 * std::log(a) : 1.0 / std::abs(k)) * std::polar(1.0, k * phi);
        if (k == 1) u -= std::conj(c) * std::polar(1.0, phi);
        u *= a / (4 * viscosity);
        forces.emplace_back(f.real(), f.imag());
        expected.emplace_back(u.real(), u.imag());
      }
      EXPECT_LT((matrix * flat_of(forces) - flat_of(expected)).cwiseAbs().maxCoeff(), 1e-13) << k;
    }
  }
}

// cos(m phi) e_r, the normal part of a wave on a membrane.
TEST(SingleLayer, of_normal_waves_on_a_circle) {
  const int nodes = 32;
  const Ring ring(test::circle(1, nodes));
  for (const int m : {2, 5}) {
    const Points forces = ring.forces([&](std::size_t i) -> Vector<2> {
      return std::cos(m * 2 * pi * static_cast<double>(i) / nodes) * ring.contour.normals[i];
    });
    const Points u = points_of(ring.single(PlaneKernel{}) * flat_of(forces));
    for (int i = 0; i < nodes; ++i) {
      const double phi = 2 * pi * i / nodes;
      const Complex exact =
          (std::polar(1.0 / (m + 1), (1 + m) * phi) + std::polar(1.0 / (m - 1), (1 - m) * phi)) /
          (8 * viscosity);
      const Vector<2>& v = u[static_cast<std::size_t>(i)];
      EXPECT_NEAR(std::abs(Complex(v.x(), v.y()) - exact), 0, 1e-14);
    }
  }
}

TEST(SingleLayer, is_symmetric_and_loses_no_energy) {
  for (const StokesKernel& kernel : kernels()) {
    const Ring ring(ellipse(1.5, 0.6, 30));
    const Eigen::MatrixXd matrix = ring.single(kernel);
    EXPECT_EQ((matrix - matrix.transpose()).norm(), 0);
    // Among forces that sum to zero, none moves the fluid against itself.
    Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(60, 2);
    for (Eigen::Index i = 0; i < 60; ++i) sums(i, i % 2) = std::sqrt(1.0 / 30);
    const Eigen::MatrixXd free = Eigen::MatrixXd::Identity(60, 60) - sums * sums.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> spectrum(free * matrix * free);
    // A pressure does neither, up to the error of the quadrature.
    EXPECT_GT(spectrum.eigenvalues().minCoeff(), -1e-10);
    EXPECT_GT(spectrum.eigenvalues()[3], 1e-4);
  }
}

TEST(SingleLayer, of_a_pressure_moves_nothing) {
  for (const StokesKernel& kernel : kernels()) {
    double coarse = 0;
    for (const int nodes : {16, 32, 64}) {
      const Ring ring(ellipse(1.5, 0.6, nodes));
      const Points forces = ring.forces([&](std::size_t i) { return ring.contour.normals[i]; });
      const double u = (ring.single(kernel) * flat_of(forces)).cwiseAbs().maxCoeff();
      if (coarse > 0) {
        EXPECT_LT(u, 0.02 * coarse + 1e-14);
      }
      coarse = u;
    }
    EXPECT_LT(coarse, 1e-11);
  }
}

TEST(SingleLayer, converges_faster_than_any_power) {
  for (const StokesKernel& kernel : kernels()) {
    const auto solution = [&](int nodes) {
      const Ring ring(ellipse(1.5, 0.6, nodes));
      const Points forces = ring.forces(
          [&](std::size_t i) { return uneven(2 * pi * static_cast<double>(i) / nodes); });
      return points_of(ring.single(kernel) * flat_of(forces));
    };
    const Points finest = solution(192);
    std::vector<double> errors;
    for (const int nodes : {16, 32, 64}) {
      const Points u = solution(nodes);
      double error = 0;
      for (std::size_t i = 0; i < u.size(); ++i) {
        error = std::max(error, (u[i] - finest[i * (192 / u.size())]).norm());
      }
      errors.push_back(error);
    }
    EXPECT_LT(errors[1], 0.02 * errors[0]);
    EXPECT_LT(errors[2], 1e-3 * errors[1]);
    EXPECT_LT(errors[2], 1e-9);
  }
}

TEST(DoubleLayer, of_a_rigid_motion_is_half_of_it) {
  for (const StokesKernel& kernel : kernels()) {
    const Ring ring(ellipse(1.5, 0.6, 64));
    Points velocities;
    for (const Vector<2>& x : ring.contour.positions) {
      velocities.emplace_back(0.3 - 0.9 * x.y(), -0.7 + 0.9 * x.x());
    }
    const Eigen::VectorXd u = flat_of(velocities);
    EXPECT_LT(
        (double_layer(ring.quadrature, ring.contour, kernel) * u + 0.5 * u).cwiseAbs().maxCoeff(),
        1e-9);
  }
}

// The waist of a literal "deflated by 70 %" is half a node spacing wide.
TEST(RingLayers, hold_across_a_thin_waist) {
  const int nodes = 59;
  const Points outline = deflate({.perimeter = 1, .reduced_area = 0.30}, nodes).nodes;
  const RingQuadrature coarse(outline.size());
  const Eigen::MatrixXd& refine = coarse.refinement();
  Points fine(static_cast<std::size_t>(refine.rows()), Vector<2>::Zero());
  for (std::size_t i = 0; i < fine.size(); ++i) {
    for (std::size_t j = 0; j < outline.size(); ++j) {
      fine[i] += refine(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) * outline[j];
    }
  }
  const auto solutions = [](const Points& points) {
    const Ring ring(points);
    const auto density = [&](std::size_t i) -> Vector<2> {
      const double a = 2 * pi * static_cast<double>(i) / static_cast<double>(points.size());
      return std::cos(2 * a) * ring.contour.normals[i] +
             0.5 * std::sin(3 * a) * ring.contour.tangents[i];
    };
    Points values;
    for (std::size_t i = 0; i < points.size(); ++i) values.push_back(density(i));
    return std::pair{
        points_of(ring.single(PlaneKernel{}) * flat_of(ring.forces(density))),
        points_of(double_layer(ring.quadrature, ring.contour, PlaneKernel{}) * flat_of(values))};
  };
  const auto [single, twice] = solutions(outline);
  const auto [fine_single, fine_twice] = solutions(fine);
  double speed = 0;
  for (const Vector<2>& u : single) speed = std::max(speed, u.norm());
  for (std::size_t i = 0; i < outline.size(); ++i) {
    // Without the refinement: 2e-3 and 0.38.
    EXPECT_LT((single[i] - fine_single[4 * i]).norm(), 1e-6 * speed) << i;
    EXPECT_LT((twice[i] - fine_twice[4 * i]).norm(), 1e-4) << i;
  }
}

// So is the gap to the next image of a long cell.
TEST(RingLayers, hold_between_a_ring_and_its_image) {
  const Ring ring(ellipse(1.5, 0.6, 64));
  const PeriodicKernel kernel{3.05};
  Points velocities;
  for (const Vector<2>& x : ring.contour.positions) velocities.emplace_back(0.3, 0.2 + 0 * x.x());
  const Eigen::VectorXd u = flat_of(velocities);
  const Eigen::VectorXd twice = double_layer(ring.quadrature, ring.contour, kernel) * u;
  EXPECT_LT((twice + 0.5 * u).cwiseAbs().maxCoeff(), 1e-4);
}

FlowValues none(std::size_t count) {
  return {Points(count, Vector<2>::Zero()), std::vector<double>(count, 0.0)};
}

FlowValues flow_of(const Ring& ring, const Points& forces, const Points& velocities, double ratio,
                   const StokesKernel& kernel, const Points& places) {
  FlowValues flow = none(places.size());
  add_ring_flow(RingSource(ring.quadrature, ring.contour, forces, velocities, ratio), kernel,
                viscosity, places, flow);
  return flow;
}

TEST(RingFlow, of_a_rigid_motion_is_inside_alone) {
  const Ring ring(ellipse(1.5, 0.6, 48));
  const Vector<2> u(0.3, -0.7);
  const Points none_at_all(48, Vector<2>::Zero());
  for (const StokesKernel& kernel : kernels()) {
    const FlowValues flow =
        flow_of(ring, none_at_all, Points(48, u), 4, kernel, {{0.2, 0.1}, {0, -0.4}, {2, 1}});
    // (1 - lambda) times minus the velocity
    EXPECT_LT((flow.velocities[0] - 3 * u).norm(), 1e-9);
    EXPECT_LT((flow.velocities[1] - 3 * u).norm(), 1e-9);
    EXPECT_LT(flow.velocities[2].norm(), 1e-9);
    EXPECT_NEAR(flow.pressures[2], 0, 1e-8);
  }
}

TEST(RingFlow, of_a_normal_force_is_a_pressure_inside) {
  const Ring ring(ellipse(1.5, 0.6, 48));
  const Points forces = ring.forces([&](std::size_t i) { return ring.contour.normals[i]; });
  for (const StokesKernel& kernel : kernels()) {
    const FlowValues flow =
        flow_of(ring, forces, Points(48, {0, 0}), 1, kernel, {{0.2, 0.1}, {2, 1}});
    EXPECT_LT(flow.velocities[0].norm() + flow.velocities[1].norm(), 1e-9);
    // A force outwards on the fluid leaves suction behind it.
    EXPECT_NEAR(flow.pressures[0] - flow.pressures[1], -1, 1e-8);
  }
}

TEST(RingFlow, solves_the_equations_of_stokes_and_adds_up) {
  const int nodes = 64;
  const Ring ring(ellipse(1.5, 0.6, nodes));
  Points velocities;
  for (int i = 0; i < nodes; ++i) velocities.push_back(uneven(1 + 2 * pi * i / nodes));
  const Points forces =
      ring.forces([&](std::size_t i) { return uneven(2 * pi * static_cast<double>(i) / nodes); });
  constexpr double h = 1e-3;
  for (const StokesKernel& kernel : kernels()) {
    for (const Vector<2>& x : {Vector<2>(2, 0.4), Vector<2>(0.3, 0.1)}) {
      const auto at = [&](double dx, double dy) {
        return flow_of(ring, forces, velocities, 5, kernel, {x + Vector<2>(dx, dy)});
      };
      const FlowValues east = at(h, 0), west = at(-h, 0), north = at(0, h), south = at(0, -h);
      const Vector<2> sum = east.velocities[0] + west.velocities[0] + north.velocities[0] +
                            south.velocities[0] - 4 * at(0, 0).velocities[0];
      const Vector<2> slope = Vector<2>(east.pressures[0] - west.pressures[0],
                                        north.pressures[0] - south.pressures[0]) /
                              (2 * h);
      EXPECT_LT((viscosity * sum / (h * h) - slope).norm(), 1e-3 * (slope.norm() + 1));
      EXPECT_NEAR((east.velocities[0] - west.velocities[0]).x() +
                      (north.velocities[0] - south.velocities[0]).y(),
                  0, 1e-6 * h);
      FlowValues twice = at(0, 0);
      add_ring_flow(RingSource(ring.quadrature, ring.contour, forces, velocities, 5), kernel,
                    viscosity, std::vector<Vector<2>>{x}, twice);
      EXPECT_LT((twice.velocities[0] - 2 * at(0, 0).velocities[0]).norm(), 1e-14);
    }
  }
}

/// Largest error at places at a distance from a circle of 59 nodes, over the largest speed.
double error_near(double distance, double ratio) {
  const auto flow_at = [&](int nodes, const Points& places) {
    const Ring ring(test::circle(1, nodes));
    Points velocities;
    for (int i = 0; i < nodes; ++i) velocities.push_back(uneven(1 + 2 * pi * i / nodes));
    const Points forces =
        ring.forces([&](std::size_t i) { return uneven(2 * pi * static_cast<double>(i) / nodes); });
    return flow_of(ring, forces, velocities, ratio, PlaneKernel{}, places);
  };
  Points places;
  for (const double phi : {0.0, 0.013, 0.037, 2.1, 4.4}) {
    places.emplace_back((1 + distance) * std::cos(phi), (1 + distance) * std::sin(phi));
  }
  const FlowValues flow = flow_at(59, places);
  const FlowValues exact = flow_at(472, places);
  double error = 0;
  double speed = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    error = std::max(error, (flow.velocities[i] - exact.velocities[i]).norm());
    speed = std::max(speed, exact.velocities[i].norm());
  }
  return error / speed;
}

// exp(-n |ln r|) is what n points on the unit circle miss at the radius r.
TEST(RingFlow, near_the_ring_has_the_stated_error) {
  const double spacing = 2 * pi / 59;
  for (const double distance : {0.3, 0.5, 1.0, 2.0, 2.9, 3.1}) {
    for (const double side : {1.0, -1.0}) {
      const double d = side * distance * spacing;
      const double points = distance < 3 ? 59 * RingQuadrature::refinement_factor : 59;
      const double away = points * std::abs(std::log(1 + d));
      const double by_forces = error_near(d, 1);
      EXPECT_LT(by_forces, 5 * std::exp(-away) + 1e-12) << distance << ", side " << side;
      // The stresslet's pole is of one order more.
      const double with_contrast = error_near(d, 5);
      EXPECT_LT(with_contrast, 8 * (1 + away) * std::exp(-away) + 1e-12) << distance;
      if (distance < 0.6) {
        EXPECT_GT(by_forces, 0.01 * std::exp(-away));  // it is what limits
      }
    }
  }
}

}  // namespace
}  // namespace hemoscale::micro
