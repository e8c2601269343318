#pragma once

#include <memory>
#include <vector>

#include "macro/flow_field.hpp"
#include "macro/viscosity/viscosity_law.hpp"

namespace hemoscale::macro {

/// A span of macroscopic time over which the law is constant.
struct Window {
  double begin = 0;  // [s]
  double end = 0;    // [s]
};

/// A macroscopic flow that can be advanced under a given viscosity law.
///
/// An instance is a value in time: advance() changes it, snapshot() and restore() move it between
/// times. It knows nothing of the micro scale: the law is all it receives.
template <int dim>
class MacroModel {
 public:
  virtual ~MacroModel() = default;

  /// @returns the flow at the end of the window; it stays valid after later calls
  /// @throws macro::NumericalError if no solution is found
  virtual std::shared_ptr<const FlowField<dim>> advance(const ViscosityLaw& law,
                                                        const Window& window) = 0;

  virtual std::vector<double> snapshot() const = 0;
  virtual void restore(const std::vector<double>& snapshot) = 0;
};

}  // namespace hemoscale::macro
