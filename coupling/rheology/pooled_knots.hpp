#pragma once

#include <vector>

#include "coupling/rheology/monotone_regression.hpp"
#include "coupling/rheology/rheology_table.hpp"

namespace hemoscale::coupling {

/// The samples behind one knot of a table, by rising shear rate.
using SampleGroup = std::vector<RheologySample>;

/// What a group of samples says together.
struct Knot {
  double shear_rate = 0;          // [1/s]
  Uncertain log_viscosity;        // [-] with its standard error
  double degrees_of_freedom = 0;  // [-] behind the standard error; infinite for an exact value
};

/// The groups of each row of a table, rows by rising hematocrit, groups by rising shear rate. Does
/// not depend on the order of the samples.
std::vector<std::vector<SampleGroup>> groups_by_row(const std::vector<RheologySample>& samples,
                                                    const Pooling& pooling);

/// Pools a group with weights 1 / (relative error)^2; error and degrees of freedom after Meier
/// (1953) and Welch (1947), see the README of this folder. Pooling is in logarithms: along a power
/// law the mean of log(viscosity) belongs to the mean of log(shear rate) exactly.
Knot pool(const SampleGroup& samples);

double mean_hematocrit(const std::vector<SampleGroup>& row);

}  // namespace hemoscale::coupling
