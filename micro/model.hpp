#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "micro/forcing.hpp"
#include "micro/observation.hpp"

namespace hemoscale::micro {

/// How long a micro model is run: until the shear stress is known well enough or the allowance is
/// spent, whichever comes first. Lengths are in strain units (shear rate times time), the natural
/// clock of a sheared suspension.
struct Run {
  double warm_up_strain = 0;           // [-] discarded
  double minimum_strain = 0;           // [-] averaged at least
  double maximum_strain = 0;           // [-] averaged at most: the allowance
  double relative_standard_error = 0;  // [-] of the shear stress; wanted
};

/// The complete state of a model as named arrays; nothing else is needed to continue with the same
/// bits. Files are written from it by micro/snapshot, which knows no model.
struct Snapshot {
  std::map<std::string, std::vector<double>> reals;
  std::map<std::string, std::vector<std::int64_t>> integers;
};

/// Cell-scale model of a small volume of blood.
///
/// An instance is a value in time: advance() changes it, snapshot() and restore() move it between
/// times. It reads no files, prints nothing and knows no macro type.
template <int dim>
class MicroModel {
 public:
  virtual ~MicroModel() = default;

  /// Advance under constant forcing until `run` is satisfied.
  /// @throws NumericalError if a stability limit is exceeded or a value is not finite
  virtual Observation<dim> advance(const Forcing<dim>& forcing, const Run& run) = 0;

  virtual Snapshot snapshot() const = 0;

  /// @throws ParameterError if the snapshot does not belong to such a model
  virtual void restore(const Snapshot& snapshot) = 0;
};

}  // namespace hemoscale::micro
