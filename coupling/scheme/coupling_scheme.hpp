#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "coupling/scheme/coupled_loop.hpp"
#include "macro/macro_model.hpp"

namespace hemoscale::coupling {

/// What the flow imposes on the micro models at the points: sample, transfer to the micro frame.
/// Arguments and errors as for coupled_pass.
template <int dim>
std::vector<ShearForcing> shear_forcings(const macro::FlowField<dim>& field,
                                         const std::vector<macro::Vector<dim>>& points, double time,
                                         double hematocrit);

/// One pass on a flow field: sample, transfer to the micro frame, micro runs, new law. Collective.
///
/// @param points      [m] where the flow is sampled; the same in every pass
/// @param time        [s]
/// @param hematocrit  [-] of the flow
/// @throws CaseError if a point lies outside the field; as CoupledLoop::pass
template <int dim>
LoopReport coupled_pass(CoupledLoop& loop, const macro::FlowField<dim>& field,
                        const std::vector<macro::Vector<dim>>& points, double time,
                        double hematocrit);

/// A macro flow with the places where it is coupled.
template <int dim>
struct CoupledFlow {
  macro::MacroModel<dim>& model;
  std::vector<macro::Vector<dim>> points;  // [m]
  double hematocrit = 0;                   // [-]
};

/// What happened in one window.
template <int dim>
struct WindowReport {
  std::vector<LoopReport> passes;
  bool converged = false;
  std::shared_ptr<const macro::FlowField<dim>> field;  // at the end of the window
};

/// Called after each pass: progress, results, checkpoints.
using PassCallback = std::function<void(const LoopReport&)>;

/// The order of events in a window.
template <int dim>
class CouplingScheme {
 public:
  virtual ~CouplingScheme() = default;

  /// One window of macroscopic time. Collective.
  virtual WindowReport<dim> advance(CoupledFlow<dim>& flow, CoupledLoop& loop,
                                    const macro::Window& window, const PassCallback& on_pass) = 0;
};

/// No feedback: the macro flow under the law of the loop, micro runs in it. One pass a window.
template <int dim>
class OneWay final : public CouplingScheme<dim> {
 public:
  WindowReport<dim> advance(CoupledFlow<dim>& flow, CoupledLoop& loop, const macro::Window& window,
                            const PassCallback& on_pass) override;
};

/// The flow of a window follows the law of the window before. One pass a window: for a steady macro
/// flow a window is one iteration of the fixed point.
template <int dim>
class Explicit final : public CouplingScheme<dim> {
 public:
  WindowReport<dim> advance(CoupledFlow<dim>& flow, CoupledLoop& loop, const macro::Window& window,
                            const PassCallback& on_pass) override;
};

/// The window is repeated from the macro state at its begin until law and flow agree. The micro
/// models are not set back: they continue and sample on (see the README of this folder). At the end
/// the flow is computed once more, under the final law.
///
/// A window that a restart finds begun (loop.passes_in_window() > 0, macro model restored to the
/// begin of the window) is continued.
template <int dim>
class Implicit final : public CouplingScheme<dim> {
 public:
  /// @param maximum_passes  of one window, at least 1
  explicit Implicit(int maximum_passes);
  WindowReport<dim> advance(CoupledFlow<dim>& flow, CoupledLoop& loop, const macro::Window& window,
                            const PassCallback& on_pass) override;

 private:
  int maximum_passes_ = 1;
};

}  // namespace hemoscale::coupling
