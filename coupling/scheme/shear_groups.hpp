#pragma once

#include <vector>

#include "coupling/rheology/rheology_sample.hpp"
#include "coupling/scheme/micro_runs.hpp"

namespace hemoscale::coupling {

/// The micro runs that a set of sampled flows asks for.
struct ShearGroups {
  std::vector<PlannedRun> runs;  // by rising hematocrit, then shear rate
  int points_below_lowest = 0;   // [-] not run: their shear rate is below the lowest one
};

/// Points of equal hematocrit whose shear rates lie within a factor `distinct_ratio` of the lowest
/// one of their group share a run at the geometric mean of their shear rates; the run belongs to
/// the slot of the point with the lowest number. A point is a slot: flows[i] is slot i.
///
/// @param distinct_ratio     [-] at least 1
/// @param lowest_shear_rate  [1/s] positive
ShearGroups group_by_shear_rate(const std::vector<ShearForcing>& flows, double distinct_ratio,
                                double lowest_shear_rate);

/// Whether the samples within a factor `distinct_ratio` of the shear rate, at the same hematocrit,
/// already give the viscosity as well as wanted: one of them reached its precision, or all together
/// have the wanted relative standard error.
bool is_covered(const ShearForcing& flow, const std::vector<RheologySample>& samples,
                double distinct_ratio, double relative_standard_error);

}  // namespace hemoscale::coupling
