#pragma once

#include <cfenv>

namespace hemoscale::macro {

/// Switches floating-point traps off while it lives, then restores the environment as it was.
///
/// Programs of OpenFOAM trap division by zero, overflow and invalid operations, and die of them.
/// Code that handles such values itself (an exponential that underflows, a limit that is infinite)
/// runs inside one of these; what it returns is checked to be finite.
class FloatingPointTrapsOff {
 public:
  FloatingPointTrapsOff() { std::feholdexcept(&saved_); }
  ~FloatingPointTrapsOff() { std::fesetenv(&saved_); }
  FloatingPointTrapsOff(const FloatingPointTrapsOff&) = delete;
  FloatingPointTrapsOff& operator=(const FloatingPointTrapsOff&) = delete;

 private:
  std::fenv_t saved_;
};

}  // namespace hemoscale::macro
