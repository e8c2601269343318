#pragma once

#include <memory>
#include <string>

namespace hemoscale::coupling {

/// The units of measurement that a case may use: those of UDUNITS-2 with its prefixes, and the
/// symbols "P" (poise) and "dyn", which it lacks and which the literature on blood uses.
///
/// UDUNITS-2 holds one process-wide error handler and is not thread safe: one UnitSystem at a time,
/// in one thread. The handler is silent while the object lives, and is put back afterwards.
class UnitSystem {
 public:
  /// @throws EnvironmentError if the database of units cannot be read
  UnitSystem();
  ~UnitSystem();
  UnitSystem(const UnitSystem&) = delete;
  UnitSystem& operator=(const UnitSystem&) = delete;

  /// What `value` of `unit` is in `si_unit` ("1" for dimensionless). Only proportional units: those
  /// with an origin (degC), logarithms and reciprocals (s for 1/s) are refused.
  /// @throws UnitError
  double convert(double value, const std::string& unit, const std::string& si_unit) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Why a unit cannot be used; a clause that continues 'the unit "xyz" ...'.
struct UnitError {
  std::string reason;
};

}  // namespace hemoscale::coupling
