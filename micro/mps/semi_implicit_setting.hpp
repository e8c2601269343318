#pragma once

#include "micro/mps/semi_implicit_parts.hpp"

namespace hemoscale::micro {

/// @throws ParameterError if domain, fluid or options are not admissible
template <int dim>
SemiImplicitSetting<dim> make_setting(const FlowDomain<dim>& domain, const Fluid& fluid,
                                      const SemiImplicitOptions& options,
                                      const SolveTolerance& tolerance,
                                      SymmetricSolverFactory<dim> make_solver);

template <int dim>
SemiImplicitState<dim> make_state(const FlowDomain<dim>& domain);

}  // namespace hemoscale::micro
