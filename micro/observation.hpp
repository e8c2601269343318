#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "micro/vector.hpp"

namespace hemoscale::micro {

/// A time average with its statistical uncertainty.
struct Estimate {
  double mean = 0;
  double standard_error = 0;
  double correlation_time = 0;   // [s] integrated autocorrelation time
  double effective_samples = 0;  // [-] independent samples that carry the same information
};

/// Why a micro run ended.
enum class Termination { precision_reached, allowance_spent };

/// One line of the conservation ledger: what should be constant, and by how much it was not.
struct LedgerEntry {
  std::string name;       // e.g. "area of the worst cell"
  double deviation = 0;   // [-] relative, largest over the run
  double warn_above = 0;  // [-]
  double stop_above = 0;  // [-]
};

/// The flow through a channel, for the macro scale.
struct ChannelObservation {
  double flow_rate = 0;          // [m^2/s] per depth
  double pressure_drop = 0;      // [Pa] between the measured sections
  double wall_shear_stress = 0;  // [Pa]
};

/// What one micro run observed: averages after the warm-up.
template <int dim>
struct Observation {
  double shear_rate = 0;             // [1/s] imposed: sqrt(2 D:D)
  double hematocrit = 0;             // [-] of the domain as it was run
  Estimate shear_stress;             // [Pa] total, suspending fluid included: component (0,1)
  Estimate first_normal_difference;  // [Pa] total stress (0,0) minus (1,1)
  Tensor<dim> particle_stress = Tensor<dim>::Zero();  // [Pa] mean stress due to the cells
  double averaging_time = 0;                          // [s] after the warm-up
  double warm_up_time = 0;                            // [s]
  std::int64_t steps = 0;                             // [-] of this run
  Termination termination = Termination::allowance_spent;
  std::vector<LedgerEntry> ledger;
  std::optional<ChannelObservation> channel = std::nullopt;  // of models that resolve one
};

}  // namespace hemoscale::micro
