// How long a pressure solve takes, solver by solver: the Laplacian of a particle method (29 entries
// a row) on a shaken channel 8:1 with a given value at the outlet, set-up and solution to 1e-8. One
// line of JSON a case, each in a process of its own, so that the peak of memory is that of the
// case:
//
//   pressure_solve [SOLVER [NODES_ACROSS [REPETITIONS]]]
//
// Without arguments: all solvers where they are sensible, 25, 80 and 250 nodes across (5 000, 51
// 200 and 500 000 unknowns). Times are CPU seconds of the process, the best of the repetitions; say
// how loaded the machine was with every figure.

#include <fmt/core.h>
#include <malloc.h>
#include <mpi.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "micro/linear/choose_solver.hpp"
#include "tests/support/linear/model_systems.hpp"

namespace hemoscale::micro {
namespace {

double cpu_seconds() {
  timespec time = {};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// A line of /proc/self/status, "VmRSS" (memory held) or "VmHWM" (its peak).
double mebibytes(const std::string& wanted) {
  std::ifstream status("/proc/self/status");
  std::string key;
  double kibibytes = 0;
  while (status >> key) {
    if (key == wanted + ":") {
      status >> kibibytes;
      return kibibytes / 1024;
    }
    status.ignore(1000, '\n');
  }
  return 0;
}

// The peak of memory starts anew from what is held now.
void forget_peak() {
  malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
}

struct Case {
  LinearSolverKind kind;
  bool symmetric;  // what the solver is told
};

const std::map<std::string, Case> cases = {
    {"automatic", {LinearSolverKind::automatic, true}},
    {"banded_cholesky", {LinearSolverKind::banded, true}},
    {"banded_lu", {LinearSolverKind::banded, false}},
    {"sparse_ldlt", {LinearSolverKind::sparse_direct, true}},
    {"sparse_lu", {LinearSolverKind::sparse_direct, false}},
    {"aggregate_cg", {LinearSolverKind::aggregate, true}},
    {"aggregate_gmres", {LinearSolverKind::aggregate, false}},
    {"hypre_cg", {LinearSolverKind::hypre, true}},
    {"hypre_gmres", {LinearSolverKind::hypre, false}},
};

// Largest number of nodes across for which a solver is sensible.
int most_across(const std::string& name) {
  return name.starts_with("sparse") || name.starts_with("banded") ? 80 : 250;
}

void measure(const std::string& name, int across, int repetitions) {
  MPI_Init(nullptr, nullptr);
  {
    const Case& chosen = cases.at(name);
    const Communicator alone;
    const auto system =
        particle_laplacian<2>({8 * across + 1, across}, ChannelEnds::outlet, 0.2, 1);
    const std::vector<double> b = random_vector(system.matrix.rows(), 2);
    forget_peak();
    const double held = mebibytes("VmRSS");
    const SystemTraits traits{1, chosen.symmetric, {}};
    double choose = 1e300;
    double prepare = 1e300;
    double solve = 1e300;
    SolveReport report;
    std::string description;
    for (int repetition = 0; repetition < repetitions; ++repetition) {
      std::vector<double> x(b.size());
      const double start = cpu_seconds();
      const auto solver = make_solver(chosen.kind, *system.matrix.pattern, system.layout(), traits,
                                      {1e-8, 5000}, alone);
      const double made = cpu_seconds();
      solver->prepare(system.matrix);
      const double prepared = cpu_seconds();
      report = solver->solve(b, x);
      const double solved = cpu_seconds();
      choose = std::min(choose, made - start);
      prepare = std::min(prepare, prepared - made);
      solve = std::min(solve, solved - prepared);
      description = solver->describe();
    }
    double load = 0;
    getloadavg(&load, 1);
    fmt::print(
        "{{\"solver\": \"{}\", \"unknowns\": {}, \"entries\": {}, \"make_s\": {:.4f}, "
        "\"prepare_s\": {:.4f}, \"solve_s\": {:.4f}, \"iterations\": {}, "
        "\"residual\": {:.2e}, \"held_MiB\": {:.0f}, \"solver_MiB\": {:.0f}, "
        "\"load\": {:.2f}, \"is\": \"{}\"}}\n",
        name, b.size(), system.matrix.values.size(), choose, prepare, solve, report.iterations,
        report.relative_residual, held, mebibytes("VmHWM") - held, load, description);
    std::fflush(stdout);
  }
  MPI_Finalize();
}

// Returns whether the case succeeded.
bool measure_in_child(const std::string& name, int across, int repetitions) {
  const pid_t child = fork();
  if (child < 0) {
    fmt::print(stderr, "fork failed\n");
    return false;
  }
  if (child == 0) {
    int code = 0;
    try {
      measure(name, across, repetitions);
    } catch (const std::exception& error) {
      fmt::print(stderr, "{}, {} across: {}\n", name, across, error.what());
      code = 1;
    }
    std::_Exit(code);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return status == 0;
}

}  // namespace
}  // namespace hemoscale::micro

int main(int count, char** arguments) {
  using namespace hemoscale::micro;
  const std::string wanted = count > 1 ? arguments[1] : "";
  if (!wanted.empty() && !cases.contains(wanted)) {
    fmt::print(stderr, "unknown solver {}; one of:", wanted);
    for (const auto& [name, each] : cases) {
      fmt::print(stderr, " {}", name);
    }
    fmt::print(stderr, "\n");
    return 1;
  }
  const int repetitions = count > 3 ? std::atoi(arguments[3]) : 3;
  bool good = true;
  for (const int across : {25, 80, 250}) {
    for (const auto& [name, each] : cases) {
      const bool chosen = count > 2 ? across == 25 : across <= most_across(name);
      if (chosen && (wanted.empty() || wanted == name)) {
        good &= measure_in_child(name, count > 2 ? std::atoi(arguments[2]) : across, repetitions);
      }
    }
  }
  return good ? 0 : 1;
}
