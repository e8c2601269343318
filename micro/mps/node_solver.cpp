#include "micro/mps/node_solver.hpp"

#include "micro/linear/ordering.hpp"

namespace hemoscale::micro {

namespace {

/// Resting nodes have their matrix factored once: a band is worth it up to about a second of
/// factorisation, n w^2 multiplications.
constexpr double affordable_factorisation = 3e9;

}  // namespace

template <int dim>
NodeLayout<dim> node_layout(const NodeGeometry<dim>& nodes) {
  NodeLayout<dim> layout;
  layout.positions = nodes.positions;
  layout.spacing = nodes.spacing;
  for (int axis = 0; axis < dim; ++axis) {
    if (nodes.box.periodic[static_cast<std::size_t>(axis)]) {
      layout.period[axis] = nodes.box.upper[axis] - nodes.box.lower[axis];
    }
  }
  layout.slide = nodes.box.slide;
  return layout;
}

template <int dim>
std::unique_ptr<LinearSolver> make_node_solver(const NodeGeometry<dim>& nodes,
                                               const SparsePattern& pattern,
                                               const SystemTraits& traits,
                                               const StageSolving& solving,
                                               const Communicator& ranks) {
  LinearSolverKind kind = solving.kind;
  const NodeLayout<dim> layout = node_layout(nodes);
  if (kind == LinearSolverKind::automatic && solving.is_reused && pattern.is_whole()) {
    const Ordering order = column_order(pattern, layout, traits.unknowns_per_node);
    const auto width = static_cast<double>(order.bandwidth.lower);
    if (width * width * static_cast<double>(pattern.rows()) < affordable_factorisation) {
      kind = LinearSolverKind::banded;
    }
  }
  return make_solver<dim>(kind, pattern, layout, traits, solving.tolerance, ranks);
}

#define HEMOSCALE_INSTANTIATE(dim)                                                              \
  template NodeLayout<dim> node_layout<dim>(const NodeGeometry<dim>&);                          \
  template std::unique_ptr<LinearSolver> make_node_solver<dim>(                                 \
      const NodeGeometry<dim>&, const SparsePattern&, const SystemTraits&, const StageSolving&, \
      const Communicator&);
HEMOSCALE_INSTANTIATE(2)
HEMOSCALE_INSTANTIATE(3)
#undef HEMOSCALE_INSTANTIATE

}  // namespace hemoscale::micro
