#include "micro/mps/semi_implicit_neighbours.hpp"

#include "micro/mps/semi_implicit_boundaries.hpp"
#include "micro/particles/rearrange.hpp"

namespace hemoscale::micro {

namespace {

/// Rows for all particles but the dummies, in their order; columns then ascend as neighbours do.
template <int dim>
void build_pattern(const SemiImplicitState<dim>& state, SemiImplicitWork<dim>& work) {
  const ParticleSet<dim>& particles = state.particles;
  const std::size_t count = particles.size();
  work.unknown.assign(count, -1);
  work.unknown_positions.clear();
  for (std::size_t i = 0; i < count; ++i) {
    if (particles.kinds[i] == ParticleKind::dummy) continue;
    work.unknown[i] = static_cast<std::int32_t>(work.unknown_positions.size());
    work.unknown_positions.push_back(state.table_positions[i]);
  }
  auto pattern = std::make_shared<SparsePattern>();
  pattern->global_rows = work.unknown_positions.size();
  pattern->first.reserve(pattern->global_rows + 1);
  pattern->columns.reserve(work.table.pairs() + count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::int32_t own = work.unknown[i];
    if (own < 0) continue;
    bool has_diagonal = false;
    for (const std::int32_t j : work.table.of(i)) {
      const std::int32_t column = work.unknown[static_cast<std::size_t>(j)];
      if (column < 0) continue;
      if (!has_diagonal && column > own) {
        pattern->columns.push_back(own);
        has_diagonal = true;
      }
      pattern->columns.push_back(column);
    }
    if (!has_diagonal) pattern->columns.push_back(own);
    pattern->first.push_back(static_cast<std::int64_t>(pattern->columns.size()));
  }
  work.pattern = pattern;
  for (ParticleSystem* system : {&work.pressure, &work.velocity}) {
    system->matrix = SparseMatrix(work.pattern);
    system->right.resize(pattern->global_rows);
    system->solution.resize(pattern->global_rows);
    system->solver = nullptr;
  }
}

}  // namespace

template <int dim>
void rebuild_neighbours(const SemiImplicitSetting<dim>& setting,
                        const SemiImplicitState<dim>& state, SemiImplicitWork<dim>& work) {
  work.table.build(state.table_positions, setting.box, setting.kernel.largest_radius(),
                   neighbour_skin * setting.spacing);
  build_pattern(state, work);
  find_probes(setting, state, work);
}

template <int dim>
void refresh_neighbours(const SemiImplicitSetting<dim>& setting, SemiImplicitState<dim>& state,
                        SemiImplicitWork<dim>& work) {
  if (work.table.is_complete(state.table_positions, state.particles.positions, setting.box)) return;
  for (Vector<dim>& x : state.particles.positions) x = wrapped(setting.box, x);
  state.table_positions = state.particles.positions;
  ++state.searches;
  rebuild_neighbours(setting, state, work);
}

template <int dim>
void keep_order(const SemiImplicitSetting<dim>& setting, SemiImplicitState<dim>& state) {
  if (state.searches < searches_between_orders) return;
  for (Vector<dim>& x : state.particles.positions) x = wrapped(setting.box, x);
  const std::vector<std::int32_t> order =
      spatial_order(state.particles.positions, 2 * setting.spacing);
  rearrange(state.particles, order);
  rearrange(state.depths, order);
  state.table_positions.clear();
  state.searches = 0;
}

#define HEMOSCALE_INSTANTIATE(dim)                                                                \
  template void refresh_neighbours<dim>(const SemiImplicitSetting<dim>&, SemiImplicitState<dim>&, \
                                        SemiImplicitWork<dim>&);                                  \
  template void keep_order<dim>(const SemiImplicitSetting<dim>&, SemiImplicitState<dim>&);        \
  template void rebuild_neighbours<dim>(const SemiImplicitSetting<dim>&,                          \
                                        const SemiImplicitState<dim>&, SemiImplicitWork<dim>&);
HEMOSCALE_INSTANTIATE(2)
HEMOSCALE_INSTANTIATE(3)
#undef HEMOSCALE_INSTANTIATE

}  // namespace hemoscale::micro
