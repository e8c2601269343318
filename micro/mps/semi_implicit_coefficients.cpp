#include "micro/mps/semi_implicit_coefficients.hpp"

#include "micro/mps/corrected_gradient.hpp"
#include "micro/mps/free_surface.hpp"
#include "micro/mps/number_density.hpp"
#include "micro/mps/semi_implicit_boundaries.hpp"
#include "micro/mps/semi_implicit_neighbours.hpp"
#include "micro/mps/semi_implicit_pressure.hpp"

namespace hemoscale::micro {

namespace {

/// Gradient over the neighbours with a pressure alone; corrected, it is exact with these.
template <int dim>
void pressure_gradient_weights(const SemiImplicitSetting<dim>& setting,
                               const std::vector<ParticleKind>& kinds,
                               SemiImplicitWork<dim>& work) {
  gradient_weights(setting.kernel, work.pairs, work.table, work.pressure_gradient);
  const std::size_t entries = work.table.pairs();
#pragma omp parallel for schedule(static)
  for (std::size_t k = 0; k < entries; ++k) {
    if (work.has_pressure[work.table[k]] == 0) work.pressure_gradient[k].setZero();
  }
  if (setting.options.operators != OperatorKind::gc) return;
  std::vector<char> free(kinds.size());
  for (std::size_t i = 0; i < kinds.size(); ++i) free[i] = static_cast<char>(is_free(kinds[i]));
  work.report.uncorrected = correct_gradient(
      work.pairs, work.table, setting.options.condition_bound, free, work.pressure_gradient);
}

}  // namespace

template <int dim>
void compute_coefficients(const SemiImplicitSetting<dim>& setting, SemiImplicitState<dim>& state,
                          SemiImplicitWork<dim>& work, StepMoment moment) {
  const SemiImplicitOptions& options = setting.options;
  const bool is_first = moment == StepMoment::first;
  measure_pairs(state.particles.positions, setting.box, work.table, work.pairs);
  laplacian_weights(setting.kernel, options.laplacian_scale, work.pairs, work.table,
                    work.laplacian);
  if (is_first && options.source == IncompressibilitySource::hs_ecs) {
    number_density(setting.kernel, work.pairs, work.table, work.first_density);
    density_rate(setting.kernel, work.pairs, work.table, state.particles.velocities,
                 work.first_rate);
  }
  const bool has_roles = !is_first || options.coupling == ParticleCoupling::incremental;
  if (has_roles) {
    number_density(setting.kernel, work.pairs, work.table, work.density);
    if (options.free_surface_ratio) {
      work.report.surface_particles =
          detect_free_surface(work.density, setting.kernel.gradient_density,
                              *options.free_surface_ratio, state.particles.kinds, work.is_dry);
    }
    assign_pressure_roles(setting, state, work);
    pressure_gradient_weights(setting, state.particles.kinds, work);
  }
  if (!is_first && options.source == IncompressibilitySource::divergence) {
    gradient_weights(setting.kernel, work.pairs, work.table, work.gradient);
    if (options.operators == OperatorKind::gc) {
      correct_gradient(work.pairs, work.table, options.condition_bound, {}, work.gradient);
    }
  }
}

template void compute_coefficients<2>(const SemiImplicitSetting<2>&, SemiImplicitState<2>&,
                                      SemiImplicitWork<2>&, StepMoment);
template void compute_coefficients<3>(const SemiImplicitSetting<3>&, SemiImplicitState<3>&,
                                      SemiImplicitWork<3>&, StepMoment);

}  // namespace hemoscale::micro
