#include "micro/mps/semi_implicit_source.hpp"

#include <cmath>

#include "micro/mps/number_density.hpp"

namespace hemoscale::micro {

namespace {

template <typename Value>
void fill(std::vector<double>& source, std::size_t count, const Value& value) {
  source.resize(count);
#pragma omp parallel for schedule(static)
  for (std::size_t i = 0; i < count; ++i) source[i] = value(i);
}

}  // namespace

template <int dim>
void pressure_source(const SemiImplicitSetting<dim>& setting, const SemiImplicitState<dim>& state,
                     SemiImplicitWork<dim>& work, double dt) {
  const double reference = setting.kernel.gradient_density;
  const double inertia = setting.fluid.density / dt;
  const std::size_t count = state.particles.size();
  const std::vector<Vector<dim>>& u = state.particles.velocities;
  switch (setting.options.source) {
    case IncompressibilitySource::pnd: {
      const double factor = -setting.options.relaxation * inertia / dt;
      fill(work.source, count,
           [&](std::size_t i) { return factor * (work.density[i] / reference - 1); });
      break;
    }
    case IncompressibilitySource::divergence:
      fill(work.source, count, [&](std::size_t i) {
        double sum = 0;
        for (std::size_t k = work.table.begin(i); k < work.table.end(i); ++k) {
          sum += work.gradient[k].dot(u[work.table[k]] - u[i]);
        }
        return inertia * sum;
      });
      break;
    case IncompressibilitySource::hs_ecs:
      density_rate(setting.kernel, work.pairs, work.table, u, work.rate);
      fill(work.source, count, [&](std::size_t i) {
        const double deviation = work.first_density[i] / reference - 1;
        const double rate = work.first_rate[i] / reference;
        return -inertia *
               (work.rate[i] / reference + std::abs(deviation) * rate + std::abs(rate) * deviation);
      });
      break;
  }
}

template void pressure_source<2>(const SemiImplicitSetting<2>&, const SemiImplicitState<2>&,
                                 SemiImplicitWork<2>&, double);
template void pressure_source<3>(const SemiImplicitSetting<3>&, const SemiImplicitState<3>&,
                                 SemiImplicitWork<3>&, double);

}  // namespace hemoscale::micro
