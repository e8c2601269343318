#pragma once

#include <span>
#include <vector>

namespace hemoscale::coupling {

/// Which runs no other run beats: none is at least as good in both cost and error and better in
/// one. Runs whose cost or error is not finite neither count nor beat.
/// @returns one entry per run
std::vector<bool> pareto_front(std::span<const double> costs, std::span<const double> errors);

}  // namespace hemoscale::coupling
