#include "micro/mps/free_surface.hpp"

namespace hemoscale::micro {

std::size_t detect_free_surface(const std::vector<double>& density, double reference, double ratio,
                                std::vector<ParticleKind>& kinds, std::vector<char>& is_dry) {
  std::size_t found = 0;
  is_dry.resize(kinds.size());
  for (std::size_t i = 0; i < kinds.size(); ++i) {
    const bool is_surface = density[i] < ratio * reference;
    is_dry[i] = static_cast<char>(is_surface);
    if (kinds[i] != ParticleKind::fluid && kinds[i] != ParticleKind::surface) continue;
    kinds[i] = is_surface ? ParticleKind::surface : ParticleKind::fluid;
    if (is_surface) ++found;
  }
  return found;
}

}  // namespace hemoscale::micro
