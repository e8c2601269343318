#pragma once

#include "micro/mps/semi_implicit_parts.hpp"

namespace hemoscale::micro {

/// Matrix of a symmetric particle system: for solved particles
///
///   (extra_i + sum_{j counts} w_ij) x_i - sum_{j solved} w_ij x_j,
///
/// for the others a row of the unit matrix, scaled like the rest.
/// @param extra  of each particle; empty for none
template <int dim>
void assemble(const SemiImplicitWork<dim>& work, double scale, const std::vector<double>& extra,
              const std::vector<char>& counts, const std::vector<char>& solved,
              SparseMatrix& matrix);

/// Prepares the solver of the system for its matrix, making one after each neighbour search.
template <int dim>
void prepare(const SemiImplicitSetting<dim>& setting, const SemiImplicitWork<dim>& work,
             bool is_singular, ParticleSystem& system);

/// Solves for the right-hand side and first guess in the system.
/// @throws NumericalError naming step, time, the system, and the solver's reason
template <int dim>
SolveReport solve(const SemiImplicitState<dim>& state, const char* what, ParticleSystem& system);

}  // namespace hemoscale::micro
