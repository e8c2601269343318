#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <stdexcept>

#include "micro/cells/steady_state.hpp"
#include "tests/support/immersed/implicit_runs.hpp"
#include "tests/support/micro/outlines.hpp"

// The steady cells of cases/capillary-red-cell/reference, and runs to compare with them.
namespace hemoscale::micro::test {

struct Parachute {
  double speed = 0;                              // [-] over the mean velocity
  double length = 0, width = 0;                  // [m]
  double gap = 0, dimple = 0;                    // [m]
  double drop = 0;                               // [Pa]
  double speed_settled = 0, length_settled = 0;  // [s] 0: not
  double shape_distance = 0;                     // [m] from the shape of the reference
};

/// A row of parachute.csv.
struct ParachuteCase {
  double reduced_area, mean_speed, stretch_modulus, bending_modulus;
  Parachute known;
  Nodes shape;
};

inline std::filesystem::path capillary_reference() {
  return std::filesystem::path(HEMOSCALE_SOURCE_DIR) / "cases" / "capillary-red-cell" / "reference";
}

inline ParachuteCase parachute_case(std::size_t row) {
  const auto table = read_columns(capillary_reference() / "parachute.csv");
  const auto at = [&](const char* name) { return table.at(name).at(row); };
  ParachuteCase c{at("alpha"), at("U_m_per_s"), at("Es_N_per_m"), at("Eb_J"), {}, {}};
  c.known = {at("V_over_U"),
             at("length_um") * micron,
             at("width_um") * micron,
             at("min_gap_um") * micron,
             at("rear_dimple_depth_um") * micron,
             at("dP_extra_Pa"),
             at("t_settle_V_0p5pct_ms") * 1e-3,
             at("t_settle_L_1pct_ms") * 1e-3,
             0};
  const std::string name =
      fmt::format("para_a{:g}_U{:g}_Es{:g}_Eb{:g}_", c.reduced_area, c.mean_speed * 1e3,
                  c.stretch_modulus * 1e6, c.bending_modulus * 1e18);
  for (const auto& entry : std::filesystem::directory_iterator(capillary_reference() / "shapes")) {
    if (!entry.path().filename().string().starts_with(name)) continue;
    const auto points = read_columns(entry.path());
    c.shape = nodes_of(points.at("x_minus_xc_um"), points.at("y_minus_axis_um"), micron);
    return c;
  }
  throw std::runtime_error("no shape begins with " + name);
}

struct ParachuteRun {
  double spacing = 0.5 * micron;
  int nodes = 60;  // even: of an odd number none lies opposite to another
  double travel = 100 * micron;
  bool is_relaxed = false;  // from the rest of the membrane that stretches; else at full length
  ImplicitOptions options = {};
};

/// Left alone for long in plasma at rest.
inline Cell relaxed(Cell cell) {
  const Vector<2> centre = measure_shape(RingCurve(cell.positions)).centroid;
  ImplicitMembranes membranes(shear(0), {std::move(cell)}, {.longest_step = 2e-3});
  membranes.advance_by(0.3);
  Cell rest = membranes.cells()[0];
  const Vector<2> way = centre - look_at(membranes).shape.centroid;
  for (Vector<2>& x : rest.positions) x += way;
  return rest;
}

/// From the rest shape across the flow, in the middle of a periodic channel that keeps its flow.
inline Parachute run_parachute(const ParachuteCase& c, const ParachuteRun& run) {
  constexpr double height = 10 * micron;
  const CellPlan plan{.reduced_area = c.reduced_area,
                      .nodes = run.nodes,
                      .stretch_modulus = c.stretch_modulus,
                      .bending_modulus = c.bending_modulus,
                      .centre = {20 * micron, height / 2}};
  ImplicitOptions options = run.options;
  if (options.longest_step == 0) options.longest_step = 2 * run.spacing / c.mean_speed;
  const Cell cell = run.is_relaxed ? relaxed(deflated_cell(plan)) : deflated_cell(plan);
  ImplicitMembranes membranes(kept_channel(40 * micron, height, run.spacing, c.mean_speed), {cell},
                              options);
  constexpr int samples = 100;
  std::vector<double> time, way, speeds, lengths;
  for (int k = 0; k < samples; ++k) {
    membranes.advance_by(run.travel / c.mean_speed / samples);
    const Seen seen = look_at(membranes);
    time.push_back(membranes.time());
    way.push_back(seen.shape.centroid.x());
    speeds.push_back(seen.motion.velocity.x() / c.mean_speed);
    lengths.push_back(seen.shape.length);
  }
  const Seen seen = look_at(membranes);
  const RingCurve curve(membranes.cells()[0].positions);
  const double window = 0.3 * run.travel;
  return {seen.motion.velocity.x() / c.mean_speed,
          seen.shape.length,
          seen.shape.width,
          std::min(seen.shape.lower.y(), height - seen.shape.upper.y()),
          dimple(curve, height / 2),
          MembraneFlow(membranes).extra_pressure_drop(),
          find_steady_state(time, way, speeds, {.tolerance = 0.005, .window = window})
              .settling_time.value_or(0),
          find_steady_state(time, way, lengths, {.tolerance = 0.01, .window = window})
              .settling_time.value_or(0),
          largest_distance(curve, RingCurve(c.shape), Alignment::both)};
}

inline std::string described(const Parachute& p) {
  return fmt::format(
      "V/U {:.5f} length {:.4f} width {:.4f} gap {:.4f} dimple {:.4f} um dP {:.5f} Pa settled "
      "{:.2f} {:.2f} ms distance {:.4f} um",
      p.speed, p.length * 1e6, p.width * 1e6, p.gap * 1e6, p.dimple * 1e6, p.drop,
      p.speed_settled * 1e3, p.length_settled * 1e3, p.shape_distance * 1e6);
}

}  // namespace hemoscale::micro::test
