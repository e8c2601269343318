#include "micro/mps/semi_implicit_shifting.hpp"

#include "micro/mps/corrected_gradient.hpp"
#include "micro/mps/particle_shifting.hpp"
#include "micro/mps/semi_implicit_boundaries.hpp"

namespace hemoscale::micro {

template <int dim>
void shift_particles(const SemiImplicitSetting<dim>& setting, SemiImplicitState<dim>& state,
                     SemiImplicitWork<dim>& work) {
  ParticleSet<dim>& particles = state.particles;
  const SemiImplicitOptions& options = setting.options;
  measure_pairs(particles.positions, setting.box, work.table, work.pairs);
  shift_displacements(setting.kernel, options.shift, options.shift_coefficient, work.pairs,
                      work.table, particles.kinds, work.vectors);
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (is_tied(particles, i)) work.vectors[i].setZero();
  }
  gradient_weights(setting.kernel, work.pairs, work.table, work.gradient);
  correct_gradient(work.pairs, work.table, options.condition_bound, {}, work.gradient);
  const std::size_t count = particles.size();
  // Derivatives need the velocities behind the walls as the no-slip condition has them.
  see_velocities(setting, state, work);
  std::vector<double> component(count);
  for (int axis = 0; axis < dim; ++axis) {
    for (std::size_t i = 0; i < count; ++i) component[i] = work.viscous_velocities[i][axis];
    follow(options.shift_interpolation, work.gradient, work.table, work.vectors, component);
    for (std::size_t i = 0; i < count; ++i) {
      if (is_free(particles.kinds[i])) particles.velocities[i][axis] = component[i];
    }
  }
  if (options.coupling == ParticleCoupling::incremental) {
    std::vector<Vector<dim>> among_pressures = work.gradient;
    gradient_weights(setting.kernel, work.pairs, work.table, among_pressures);
    for (std::size_t k = 0; k < work.table.pairs(); ++k) {
      if (work.has_pressure[work.table[k]] == 0) among_pressures[k].setZero();
    }
    correct_gradient(work.pairs, work.table, options.condition_bound, {}, among_pressures);
    std::vector<double> shifted = particles.pressures;
    follow(options.shift_interpolation, among_pressures, work.table, work.vectors, shifted);
    for (std::size_t i = 0; i < count; ++i) {
      if (is_free(particles.kinds[i])) particles.pressures[i] = shifted[i];
    }
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (is_free(particles.kinds[i])) particles.positions[i] += work.vectors[i];
  }
}

template void shift_particles<2>(const SemiImplicitSetting<2>&, SemiImplicitState<2>&,
                                 SemiImplicitWork<2>&);
template void shift_particles<3>(const SemiImplicitSetting<3>&, SemiImplicitState<3>&,
                                 SemiImplicitWork<3>&);

}  // namespace hemoscale::micro
