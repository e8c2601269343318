// What a step of an ensemble costs per node, for every integrator, precision and size of the
// ensemble, by one thread:
//
//   ensemble_speed FOLDER REPETITIONS CELLS [CELLS ...]
//
// The scene of the vessel after 20 s, when its cells are in contact; more than 1200 cells are
// copies of these one behind the other. Prints a line of CSV for each measurement: processor time,
// because it is hardly moved by others on the machine. Besides, the memory of the ensemble from the
// resident set of the process.
//
// FOLDER receives, for up to 1200 cells, the same positions as input of LAMMPS (Thompson et al.
// 2022): see peer.in and compare.py beside this file.

#include <fmt/core.h>
#include <fmt/os.h>

#include <cmath>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

#include "micro/ensemble/blocks/block_ensemble.hpp"
#include "tests/support/micro/vessel.hpp"

namespace hemoscale::micro {
namespace {

using blocks::Integrator;

constexpr std::size_t seed_cells = 1200;
constexpr double settling_time = 20;  // [s]
constexpr double um = 1e-6;

double resident_bytes() {
  std::ifstream file("/proc/self/statm");
  double pages = 0;
  file >> pages >> pages;
  return pages * 4096;
}

test::Vessel settled(std::size_t cells) {
  test::Vessel v = test::vessel(cells);
  BlockEnsemble ensemble(v.settings, Precision::single, {v.state});
  ensemble.advance(std::llround(settling_time / v.settings.time_step));
  v.state = ensemble.states().front();
  return v;
}

/// A vessel so many times as long, its cells repeated.
test::Vessel repeated(const test::Vessel& one, std::size_t times) {
  test::Vessel v = one;
  v.settings.length *= static_cast<double>(times);
  v.state.cells *= times;
  for (std::size_t k = 1; k < times; ++k) {
    const double shift = static_cast<double>(k) * one.settings.length;
    for (const double x : one.state.x) v.state.x.push_back(x + shift);
    v.state.y.insert(v.state.y.end(), one.state.y.begin(), one.state.y.end());
  }
  return v;
}

struct Scheme {
  const char* name;
  Integrator integrator;
  double time_step;    // [s]
  std::int64_t steps;  // for 1200 cells
};
const Scheme schemes[] = {
    {"explicit", Integrator::explicit_euler, 4e-7, 600},
    {"inertial", Integrator::inertial, 4e-7, 400},
    {"chebyshev", Integrator::chebyshev, 1e-5, 60},
    {"linearly-implicit", Integrator::linearly_implicit, 2e-3, 200},
    {"constant-operator", Integrator::constant_operator, 2e-3, 300},
    {"constant-operator-2", Integrator::constant_operator_second_order, 2e-3, 300},
};

void measure(const test::Vessel& vessel, const Scheme& scheme, Precision precision) {
  blocks::BlockSettings settings = vessel.settings;
  settings.integrator = scheme.integrator;
  settings.time_step = scheme.time_step;
  if (scheme.integrator == Integrator::inertial) {
    settings.kinds.front().node_mass = 1e-6 * settings.kinds.front().node_drag;
  }
  const double before = resident_bytes();
  BlockEnsemble ensemble(settings, precision, {vessel.state});
  ensemble.advance(10);
  const auto nodes = static_cast<double>(vessel.state.x.size());
  const std::int64_t steps = std::max<std::int64_t>(
      20, std::llround(static_cast<double>(scheme.steps) * seed_cells * 100 / nodes));
  const std::clock_t begin = std::clock();
  ensemble.advance(std::min<std::int64_t>(steps, 20 * scheme.steps));
  const double used = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  fmt::print("{},{},{},{:.4g},{:.1f}\n", scheme.name,
             precision == Precision::single ? "single" : "double", vessel.state.cells,
             1e9 * used / (nodes * static_cast<double>(std::min(steps, 20 * scheme.steps))),
             (resident_bytes() - before) / nodes);
  std::fflush(stdout);
}

/// Rings of harmonic bonds and angles; the conservation of area has no counterpart there. Units:
/// micrometre, second, piconewton, per micrometre of depth.
void write_peer(const test::Vessel& vessel, const std::filesystem::path& path) {
  const EnsembleState& s = vessel.state;
  const auto& kind = vessel.settings.kinds.front();
  const std::size_t n = s.nodes;
  const std::size_t all = s.x.size();
  const double length = vessel.settings.length / um;
  const double mass = 1e-6 * kind.node_drag * 1e6;  // [pN s^2/um] that of a relaxation time of 1 us
  auto out = fmt::output_file(path.string());
  out.print("{} cells of {} nodes; um, s, pN\n\n", s.cells, n);
  out.print("{0} atoms\n{0} bonds\n{0} angles\n\n1 atom types\n{1} bond types\n{1} angle types\n\n",
            all, n);
  out.print("0 {:.9g} xlo xhi\n0 {:.9g} ylo yhi\n-0.5 0.5 zlo zhi\n\nMasses\n\n1 {:.6g}\n\n",
            length, vessel.settings.height / um, mass);
  out.print("Bond Coeffs\n\n");  // K (r - r0)^2
  for (std::size_t i = 0; i < n; ++i) {
    const double l0 = kind.mesh.rest_length[i];
    out.print("{} {:.8g} {:.8g}\n", i + 1, 0.5 * kind.laws.stretch.modulus / l0, l0 / um);
  }
  out.print("\nAngle Coeffs\n\n");  // K (angle - rest)^2 by the inner angle, in degrees
  const auto& bending = std::get<TurningAngleBending>(kind.laws.bending);
  for (std::size_t i = 0; i < n; ++i) {
    const double rest = 180 - std::abs(kind.mesh.natural_angle[i]) * 180 / std::numbers::pi;
    out.print("{} {:.8g} {:.8g}\n", i + 1,
              0.5 * bending.modulus / (kind.mesh.node_length[i] * um * um) * um, rest);
  }
  out.print("\nAtoms # angle\n\n");
  for (std::size_t i = 0; i < all; ++i) {
    const double x = s.x[i] / um;
    out.print("{} {} 1 {:.9g} {:.9g} 0\n", i + 1, i / n + 1, x - length * std::floor(x / length),
              s.y[i] / um);
  }
  const auto neighbour = [&](std::size_t i, std::size_t by) {
    return i - i % n + (i % n + by) % n + 1;
  };
  out.print("\nBonds\n\n");
  for (std::size_t i = 0; i < all; ++i) {
    out.print("{} {} {} {}\n", i + 1, i % n + 1, i + 1, neighbour(i, 1));
  }
  out.print("\nAngles\n\n");
  for (std::size_t i = 0; i < all; ++i) {
    out.print("{} {} {} {} {}\n", i + 1, i % n + 1, neighbour(i, n - 1), i + 1, neighbour(i, 1));
  }
}

void run(const std::filesystem::path& folder, int repetitions,
         const std::vector<std::size_t>& sizes) {
  const test::Vessel seed = settled(seed_cells);
  for (const std::size_t cells : sizes) {
    if (cells > seed_cells && cells % seed_cells != 0) {
      throw std::invalid_argument("more than 1200 cells must be a multiple of 1200");
    }
    const test::Vessel vessel =
        cells < seed_cells ? settled(cells) : repeated(seed, cells / seed_cells);
    if (cells <= seed_cells) write_peer(vessel, folder / fmt::format("cells-{}.data", cells));
    for (int k = 0; k < repetitions; ++k) {
      for (const Scheme& scheme : schemes) {
        for (const Precision precision : {Precision::single, Precision::twofold}) {
          // Short steps of nodes with mass are lost in the rounding of single precision.
          if (scheme.integrator == Integrator::inertial && precision == Precision::single) continue;
          measure(vessel, scheme, precision);
        }
      }
    }
  }
}

}  // namespace
}  // namespace hemoscale::micro

int main(int argc, char** argv) {
  if (argc < 4) {
    fmt::print(stderr, "usage: ensemble_speed FOLDER REPETITIONS CELLS [CELLS ...]\n");
    return 2;
  }
  try {
    std::vector<std::size_t> sizes;
    for (int k = 3; k < argc; ++k) sizes.push_back(std::stoul(argv[k]));
    std::filesystem::create_directories(argv[1]);
    hemoscale::micro::run(argv[1], std::stoi(argv[2]), sizes);
  } catch (const std::exception& error) {
    fmt::print(stderr, "ensemble_speed: {}\n", error.what());
    return 1;
  }
}
