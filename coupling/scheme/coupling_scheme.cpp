#include "coupling/scheme/coupling_scheme.hpp"

#include <fmt/format.h>

#include <utility>

#include "coupling/error.hpp"
#include "coupling/sampling/sample_flow.hpp"

namespace hemoscale::coupling {

template <int dim>
std::vector<ShearForcing> shear_forcings(const macro::FlowField<dim>& field,
                                         const std::vector<macro::Vector<dim>>& points, double time,
                                         double hematocrit) {
  std::vector<ShearForcing> result;
  for (const macro::FlowState<dim>& state : sample_flow<dim>(field, points, time)) {
    result.push_back(to_forcing<dim>(state, hematocrit));
  }
  return result;
}

template <int dim>
LoopReport coupled_pass(CoupledLoop& loop, const macro::FlowField<dim>& field,
                        const std::vector<macro::Vector<dim>>& points, double time,
                        double hematocrit) {
  return loop.pass(shear_forcings<dim>(field, points, time, hematocrit));
}

namespace {

template <int dim>
void record(WindowReport<dim>& window, LoopReport report, const PassCallback& on_pass) {
  window.converged = report.converged;
  window.passes.push_back(std::move(report));
  if (on_pass) on_pass(window.passes.back());
}

}  // namespace

template <int dim>
WindowReport<dim> OneWay<dim>::advance(CoupledFlow<dim>& flow, CoupledLoop& loop,
                                       const macro::Window& window, const PassCallback& on_pass) {
  WindowReport<dim> result;
  result.field = flow.model.advance(loop.law(), window);
  record(result,
         loop.measure(shear_forcings<dim>(*result.field, flow.points, window.end, flow.hematocrit)),
         on_pass);
  return result;
}

template <int dim>
WindowReport<dim> Explicit<dim>::advance(CoupledFlow<dim>& flow, CoupledLoop& loop,
                                         const macro::Window& window, const PassCallback& on_pass) {
  WindowReport<dim> result;
  result.field = flow.model.advance(loop.law(), window);
  record(result, coupled_pass<dim>(loop, *result.field, flow.points, window.end, flow.hematocrit),
         on_pass);
  return result;
}

template <int dim>
Implicit<dim>::Implicit(int maximum_passes) : maximum_passes_(maximum_passes) {
  if (maximum_passes >= 1) return;
  Fault fault;
  fault.key = "coupling.maximum_passes";
  fault.message = fmt::format("{} is too few; it must be at least 1", maximum_passes);
  throw CaseError({std::move(fault)});
}

template <int dim>
WindowReport<dim> Implicit<dim>::advance(CoupledFlow<dim>& flow, CoupledLoop& loop,
                                         const macro::Window& window, const PassCallback& on_pass) {
  const std::vector<double> begin = flow.model.snapshot();
  WindowReport<dim> result;
  result.converged = loop.window_has_converged();
  while (!result.converged && loop.passes_in_window() < maximum_passes_) {
    flow.model.restore(begin);
    result.field = flow.model.advance(loop.law(), window);
    record(result, coupled_pass<dim>(loop, *result.field, flow.points, window.end, flow.hematocrit),
           on_pass);
  }
  flow.model.restore(begin);
  result.field = flow.model.advance(loop.law(), window);
  loop.end_window();
  return result;
}

template std::vector<ShearForcing> shear_forcings<2>(const macro::FlowField<2>&,
                                                     const std::vector<macro::Vector<2>>&, double,
                                                     double);
template std::vector<ShearForcing> shear_forcings<3>(const macro::FlowField<3>&,
                                                     const std::vector<macro::Vector<3>>&, double,
                                                     double);
template LoopReport coupled_pass<2>(CoupledLoop&, const macro::FlowField<2>&,
                                    const std::vector<macro::Vector<2>>&, double, double);
template LoopReport coupled_pass<3>(CoupledLoop&, const macro::FlowField<3>&,
                                    const std::vector<macro::Vector<3>>&, double, double);
template class OneWay<2>;
template class OneWay<3>;
template class Explicit<2>;
template class Explicit<3>;
template class Implicit<2>;
template class Implicit<3>;

}  // namespace hemoscale::coupling
