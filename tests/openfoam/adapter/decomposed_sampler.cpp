// Started under mpirun by case_reader_test: samples the decomposed case on all ranks, checks that
// all receive the same, and that the root's own reading of the whole case agrees.
//
//   decomposed_sampler CASE

#include <mpi.h>

#include <cmath>
#include <cstdio>
#include <exception>

#include "macro/openfoam/loader.hpp"

namespace {

using namespace hemoscale::macro;

std::vector<Vector<3>> points() {
  std::vector<Vector<3>> points;
  // y = 50 lies on the face between the two ranks: exactly one of them may answer
  for (const double y : {0.0, 3.0, 21.0, 49.9, 50.0, 50.1, 77.0, 100.0}) {
    points.push_back({40, y, 0.5});
  }
  points.push_back({40, 101, 0.5});
  return points;
}

int compare(const char* folder) {
  const OpenFoamLibrary library;
  CaseReading reading;
  reading.decomposed = true;
  const auto parts = library.open_case(folder, reading);
  const auto states = parts->sample(points(), 0);
  std::vector<double> values;
  for (const auto& state : states) {
    values.push_back(state ? state->velocity(0) : -1);
    values.push_back(state ? state->velocity_gradient(0, 1) : -1);
  }
  std::vector<double> of_root = values;
  MPI_Bcast(of_root.data(), static_cast<int>(of_root.size()), MPI_DOUBLE, 0, MPI_COMM_WORLD);
  const bool same = of_root == values;

  bool agrees = true;
  for (std::size_t i = 0; i + 1 < states.size(); ++i) {
    const double y = points()[i](1) / 100;
    const double parabola = 1.5 * 3.3333333333 * 4 * y * (1 - y);
    agrees = agrees && states[i] && std::abs(states[i]->velocity(0) - parabola) < 0.03;
  }
  agrees = agrees && !states.back();
  if (same && agrees) std::printf("agree\n");
  return same && agrees ? 0 : 1;
}

}  // namespace

int main(int count, char** arguments) {
  MPI_Init(&count, &arguments);
  int result = 1;
  try {
    result = compare(arguments[1]);
  } catch (const std::exception& error) {
    std::printf("%s\n", error.what());
  }
  std::fflush(stdout);
  MPI_Finalize();
  return result;
}
