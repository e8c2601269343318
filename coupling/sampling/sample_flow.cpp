#include "coupling/sampling/sample_flow.hpp"

#include <fmt/format.h>

#include <string>

#include "coupling/error.hpp"

namespace hemoscale::coupling {

namespace {

template <int dim>
std::string coordinates(const macro::Vector<dim>& x) {
  std::string text = fmt::format("({}", x[0]);
  for (int d = 1; d < dim; ++d) text += fmt::format(", {}", x[d]);
  return text + ") m";
}

}  // namespace

template <int dim>
std::vector<macro::FlowState<dim>> sample_flow(const macro::FlowField<dim>& field,
                                               const std::vector<macro::Vector<dim>>& points,
                                               double time) {
  const auto answers = field.sample(points, time);
  std::vector<Fault> faults;
  std::vector<macro::FlowState<dim>> states;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!answers[i]) {
      Fault fault;
      fault.key = "sampling.points";
      fault.message = fmt::format(
          "point {} = {} lies outside the flow; move it into the flow (the unit of length of the "
          "mesh is a usual cause)",
          i + 1, coordinates<dim>(points[i]));
      faults.push_back(std::move(fault));
      continue;
    }
    if (!answers[i]->velocity_gradient.allFinite()) {
      throw NumericalError(
          fmt::format("velocity gradient at sample point {} = {} at t = {} s is not finite; the "
                      "macro flow has failed: reduce its time step or relax it more",
                      i + 1, coordinates<dim>(points[i]), time));
    }
    states.push_back(*answers[i]);
  }
  if (!faults.empty()) throw CaseError(std::move(faults));
  return states;
}

template std::vector<macro::FlowState<2>> sample_flow<2>(const macro::FlowField<2>&,
                                                         const std::vector<macro::Vector<2>>&,
                                                         double);
template std::vector<macro::FlowState<3>> sample_flow<3>(const macro::FlowField<3>&,
                                                         const std::vector<macro::Vector<3>>&,
                                                         double);

}  // namespace hemoscale::coupling
