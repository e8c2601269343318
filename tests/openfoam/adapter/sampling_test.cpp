// Sampling an OpenFOAM mesh: accuracy at both length scales, orientation of the gradient, units.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <sstream>

#include "macro/error.hpp"
#include "macro/openfoam/loader.hpp"

#include "tests/openfoam/adapter/case_folder.hpp"

namespace hemoscale::macro {
namespace {

using test::CaseFolder;
using test::Scale;

constexpr double height = 1e-4;                    // [m] of the template case
constexpr double mean_velocity = 3.3333333333e-3;  // [m/s]

MeshUnits units_of(Scale scale) {
  MeshUnits units;
  if (scale == Scale::micrometre) {
    units.length = 1e-6;
    units.time = 1e-3;
  }
  return units;
}

/// The template channel with a constant viscosity and OpenFOAM's own viscosity model.
void run_newtonian(CaseFolder& folder, Scale scale) {
  test::make_channel(folder, scale, 40);
  folder.append("constant/transportProperties",
                std::string("transportModel Newtonian; nu ") +
                    (scale == Scale::micrometre ? "1142.857;" : "1.142857e-6;"));
  folder.append("system/controlDict", "endTime 200; writeInterval 200;");
  const test::Outcome run = folder.run("blockMesh && simpleFoam");
  ASSERT_EQ(run.status, 0) << run.output;
}

std::vector<Vector<3>> points_across(int count) {
  std::vector<Vector<3>> points;
  for (int k = 0; k < count; ++k) {
    points.push_back({4.1e-5, height * (k + 0.5) / count, 0.3e-6});
  }
  return points;
}

void expect_parabola(const FlowField<3>& flow) {
  const double highest = 1.5 * mean_velocity;
  double velocity_error = 0;
  double gradient_error = 0;
  for (const Vector<3>& x : points_across(97)) {
    const std::optional<FlowState<3>> state = flow.at(x, 0);
    ASSERT_TRUE(state.has_value()) << x.transpose();
    const double s = x(1) / height;
    velocity_error =
        std::max(velocity_error, std::abs(state->velocity(0) - highest * 4 * s * (1 - s)));
    gradient_error = std::max(gradient_error, std::abs(state->velocity_gradient(0, 1) -
                                                       highest * 4 * (1 - 2 * s) / height));
  }
  EXPECT_LE(velocity_error / highest, 2e-3);
  EXPECT_LE(gradient_error / (4 * highest / height), 2e-2);
  std::printf("velocity error / u_max %.2e, gradient error / wall shear rate %.2e\n",
              velocity_error / highest, gradient_error / (4 * highest / height));
}

TEST(Sampling, parabola_on_a_mesh_in_micrometres_with_every_interpolation) {
  HEMOSCALE_NEEDS_OPENFOAM();
  CaseFolder folder;
  run_newtonian(folder, Scale::micrometre);
  const OpenFoamLibrary library;
  CaseReading reading;
  reading.units = units_of(Scale::micrometre);
  for (const Interpolation interpolation :
       {Interpolation::taylor, Interpolation::cell_point, Interpolation::cell_point_face}) {
    reading.interpolation = interpolation;
    expect_parabola(*library.open_case(folder.path(), reading));
  }
}

TEST(Sampling, parabola_on_a_mesh_in_metres_but_not_with_cell_point) {
  HEMOSCALE_NEEDS_OPENFOAM();
  CaseFolder folder;
  run_newtonian(folder, Scale::metre);
  const OpenFoamLibrary library;
  CaseReading reading;
  for (const Interpolation interpolation :
       {Interpolation::taylor, Interpolation::cell_point_face}) {
    reading.interpolation = interpolation;
    expect_parabola(*library.open_case(folder.path(), reading));
  }
  // OpenFOAM's cellPoint would be wrong by several per cent here, without a word.
  reading.interpolation = Interpolation::cell_point;
  EXPECT_THROW(library.open_case(folder.path(), reading), ParameterError);
}

/// A cube of n^3 cells of side 1 with the velocity and pressure given at cell centres.
template <class Velocity, class Pressure>
void make_cube(CaseFolder& folder, int n, const Velocity& velocity, const Pressure& pressure) {
  folder.write("system/controlDict",
               "FoamFile { version 2.0; format ascii; class dictionary; object controlDict; }\n"
               "application none; startFrom startTime; startTime 0; stopAt endTime; endTime 1;\n"
               "deltaT 1; writeControl timeStep; writeInterval 1; writePrecision 16;\n");
  folder.write("system/fvSchemes",
               "FoamFile { version 2.0; format ascii; class dictionary; object fvSchemes; }\n"
               "ddtSchemes {} gradSchemes { default none; } divSchemes {} laplacianSchemes {}\n"
               "interpolationSchemes { default none; } snGradSchemes {}\n");
  folder.write("system/fvSolution",
               "FoamFile { version 2.0; format ascii; class dictionary; object fvSolution; }\n");
  std::ostringstream mesh;
  mesh << "FoamFile { version 2.0; format ascii; class dictionary; object blockMeshDict; }\n"
       << "scale " << n << "; vertices ( (0 0 0) (1 0 0) (1 1 0) (0 1 0)\n"
       << "  (0 0 1) (1 0 1) (1 1 1) (0 1 1) );\n"
       << "blocks ( hex (0 1 2 3 4 5 6 7) (" << n << " " << n << " " << n
       << ") simpleGrading (1 1 1) );\nedges (); boundary ( all { type patch; faces ( (0 4 7 3) "
       << "(1 2 6 5) (0 1 5 4) (3 7 6 2) (0 3 2 1) (4 5 6 7) ); } );\n";
  folder.write("system/blockMeshDict", mesh.str());
  std::ostringstream u;
  std::ostringstream p;
  u.precision(17);
  p.precision(17);
  u << "FoamFile { version 2.0; format ascii; class volVectorField; object U; }\n"
    << "dimensions [0 1 -1 0 0 0 0]; internalField nonuniform List<vector> " << n * n * n << " (\n";
  p << "FoamFile { version 2.0; format ascii; class volScalarField; object p; }\n"
    << "dimensions [0 2 -2 0 0 0 0]; internalField nonuniform List<scalar> " << n * n * n << " (\n";
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const Vector<3> centre(i + 0.5, j + 0.5, k + 0.5);
        const Vector<3> value = velocity(centre);
        u << "(" << value(0) << " " << value(1) << " " << value(2) << ")\n";
        p << pressure(centre) << "\n";
      }
    }
  }
  u << ");\nboundaryField { all { type zeroGradient; } }\n";
  p << ");\nboundaryField { all { type zeroGradient; } }\n";
  folder.write("0/U", u.str());
  folder.write("0/p", p.str());
  const test::Outcome run = folder.run("blockMesh");
  ASSERT_EQ(run.status, 0) << run.output;
}

TEST(Sampling, gradient_is_not_transposed_and_units_are_converted) {
  HEMOSCALE_NEEDS_OPENFOAM();
  Tensor<3> gradient;
  gradient << 1, 2, 3, -4, 5, 7, 11, -13, 17;  // [1 / time of the mesh] all different
  const Vector<3> slope(2, -3, 5);
  CaseFolder folder;
  make_cube(
      folder, 7, [&](const Vector<3>& x) -> Vector<3> { return gradient * x; },
      [&](const Vector<3>& x) { return slope.dot(x) + 1; });

  CaseReading reading;
  reading.units = {1e-6, 1e-3, 1000};
  const auto flow = OpenFoamLibrary().open_case(folder.path(), reading);
  const Vector<3> x(3.8, 3.3, 3.6);  // [mesh] in the middle cell: boundaries play no part
  const std::optional<FlowState<3>> state = flow->at(1e-6 * x, 0);
  ASSERT_TRUE(state.has_value());
  EXPECT_LE((state->velocity - 1e-3 * gradient * x).norm(), 1e-11 * (1e-3 * gradient * x).norm());
  EXPECT_LE((state->velocity_gradient - 1e3 * gradient).norm(), 1e-11 * 1e3 * gradient.norm());
  // kinematic pressure times density: (1e-3 m/s)^2 * 1000 kg/m^3 for 1
  EXPECT_NEAR(state->pressure, 1e-3 * (slope.dot(x) + 1), 1e-14);
}

TEST(Sampling, quadratic_flow_is_exact_in_the_interior) {
  HEMOSCALE_NEEDS_OPENFOAM();
  const auto velocity = [](const Vector<3>& x) -> Vector<3> {
    return {x(1) * x(1) - x(0) * x(2), 3 * x(0) * x(1), x(2) * x(2) + 2 * x(0) * x(0)};
  };
  CaseFolder folder;
  make_cube(folder, 7, velocity, [](const Vector<3>&) { return 0.0; });
  CaseReading reading;
  reading.pressure_field = "";
  const auto flow = OpenFoamLibrary().open_case(folder.path(), reading);
  const Vector<3> x(3.9, 3.2, 3.7);
  const std::optional<FlowState<3>> state = flow->at(x, 0);
  ASSERT_TRUE(state.has_value());
  Tensor<3> exact;
  exact << -x(2), 2 * x(1), -x(0), 3 * x(1), 3 * x(0), 0, 4 * x(0), 0, 2 * x(2);
  EXPECT_LE((state->velocity_gradient - exact).norm(), 1e-11 * exact.norm());
  // cell values are taken as values at the centre, where the mean differs by h^2/24 u''
  EXPECT_LE((state->velocity - velocity(x)).norm(), 1e-11 * velocity(x).norm());
  EXPECT_EQ(state->pressure, 0);
}

TEST(Sampling, points_outside_have_no_flow_and_points_on_the_boundary_have_one) {
  HEMOSCALE_NEEDS_OPENFOAM();
  CaseFolder folder;
  make_cube(
      folder, 7, [](const Vector<3>& x) -> Vector<3> { return x; },
      [](const Vector<3>&) { return 0.0; });
  CaseReading reading;
  reading.units.length = 1e-5;  // 7e-5 / 1e-5 is not 7 after rounding
  const auto flow = OpenFoamLibrary().open_case(folder.path(), reading);
  EXPECT_FALSE(flow->at({1e-5, 1e-5, -1e-7}, 0).has_value());
  EXPECT_FALSE(flow->at({7.001e-5, 1e-5, 1e-5}, 0).has_value());
  EXPECT_TRUE(flow->at({7e-5, 7e-5, 7e-5}, 0).has_value());
  EXPECT_TRUE(flow->at({0, 0, 0}, 0).has_value());
  EXPECT_TRUE(flow->at({3e-5, 2e-5, 1e-5}, 0).has_value());  // a vertex of the mesh
}

}  // namespace
}  // namespace hemoscale::macro
