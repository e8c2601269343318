#include "micro/mps/semi_implicit_systems.hpp"

#include <fmt/format.h>

#include "micro/error.hpp"

namespace hemoscale::micro {

template <int dim>
void assemble(const SemiImplicitWork<dim>& work, double scale, const std::vector<double>& extra,
              const std::vector<char>& counts, const std::vector<char>& solved,
              SparseMatrix& matrix) {
  const NeighbourTable& table = work.table;
  const std::vector<double>& weights = work.laplacian.weights;
  const SparsePattern& pattern = *matrix.pattern;
  const std::size_t count = table.size();
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < count; ++i) {
    const std::int32_t row = work.unknown[i];
    if (row < 0) continue;
    auto slot = static_cast<std::size_t>(pattern.first[static_cast<std::size_t>(row)]);
    std::size_t diagonal_slot = 0;
    bool has_diagonal = false;
    double sum = 0;
    for (std::size_t k = table.begin(i); k < table.end(i); ++k) {
      const std::size_t j = table[k];
      if (counts[j] != 0) sum += weights[k];
      const std::int32_t column = work.unknown[j];
      if (column < 0) continue;
      if (!has_diagonal && column > row) {
        diagonal_slot = slot++;
        has_diagonal = true;
      }
      matrix.values[slot++] = solved[i] != 0 && solved[j] != 0 ? -weights[k] : 0;
    }
    if (!has_diagonal) diagonal_slot = slot;
    if (!extra.empty()) sum += extra[i];
    matrix.values[diagonal_slot] = solved[i] != 0 ? sum : scale;
  }
}

template <int dim>
void prepare(const SemiImplicitSetting<dim>& setting, const SemiImplicitWork<dim>& work,
             bool is_singular, ParticleSystem& system) {
  if (!system.solver || system.is_singular != is_singular) {
    NodeLayout<dim> layout = {.positions = work.unknown_positions, .spacing = setting.spacing};
    for (int axis = 0; axis < dim; ++axis) {
      if (!setting.box.periodic[static_cast<std::size_t>(axis)]) continue;
      layout.period[axis] = setting.box.extent()[axis];
    }
    layout.slide = setting.box.slide;
    std::optional<ConstantNullSpace> null_space;
    if (is_singular) null_space.emplace();
    system.solver = setting.make_solver(layout, setting.tolerance, null_space);
    system.is_singular = is_singular;
  }
  system.solver->prepare(system.matrix);
}

template <int dim>
SolveReport solve(const SemiImplicitState<dim>& state, const char* what, ParticleSystem& system) {
  try {
    return system.solver->solve(system.right, system.solution);
  } catch (const NumericalError& reason) {
    throw NumericalError(fmt::format("step {}, time {:.6g} s: the {} was not solved: {}",
                                     state.step, state.time, what, reason.what()));
  }
}

#define HEMOSCALE_INSTANTIATE(dim)                                                                \
  template void assemble<dim>(const SemiImplicitWork<dim>&, double, const std::vector<double>&,   \
                              const std::vector<char>&, const std::vector<char>&, SparseMatrix&); \
  template void prepare<dim>(const SemiImplicitSetting<dim>&, const SemiImplicitWork<dim>&, bool, \
                             ParticleSystem&);                                                    \
  template SolveReport solve<dim>(const SemiImplicitState<dim>&, const char*, ParticleSystem&);
HEMOSCALE_INSTANTIATE(2)
HEMOSCALE_INSTANTIATE(3)
#undef HEMOSCALE_INSTANTIATE

}  // namespace hemoscale::micro
