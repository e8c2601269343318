#pragma once

#include "coupling/scene/hosts.hpp"

namespace hemoscale::coupling {

/// An ensemble in a vessel with an inlet and outlets, fed with cells (micro.domain = "geometry");
/// empty at first. run_ensemble hands such cases on. One process; restarts with the same bits.
/// @throws CaseError if there are more processes; what build_feed, CellFeed and BlockEnsemble throw
void run_ensemble_feed(const PreparedRun& run, const micro::Communicator& communicator);

}  // namespace hemoscale::coupling
