// A run that ends on several ranks, as main() ends one. Started by mpirun from config_tests.cmake:
//   end_together WHO   with WHO one of: nobody, all, one (others finish), waiting (others wait)
#include <cstdio>
#include <string>

#include "coupling/program/mpi_session.hpp"

int main(int count, char** arguments) {
  using namespace hemoscale::coupling;
  const std::string who = count > 1 ? arguments[1] : "nobody";
  if (!is_launched_by_mpi()) {
    std::fputs("not started by mpirun\n", stderr);
    return 9;
  }
  MpiSession mpi(&count, &arguments);
  const bool failed = who == "all" || ((who == "one" || who == "waiting") && mpi.rank() == 1);
  Outcome outcome;
  if (failed) outcome = {exit_environment, "hemoscale: disk full\n"};
  if (!failed && who == "waiting") mpi.communicator().barrier();  // rank 1 never comes
  outcome = mpi.end_together(outcome, 1);
  std::fputs(outcome.message.c_str(), stderr);
  return outcome.exit_code;
}
