#include "coupling/scene/plasma_error.hpp"

#include <cmath>

namespace hemoscale::coupling {

template <int dim>
PlasmaError plasma_error(const PlasmaScene<dim>& scene, const micro::ParticleSet<dim>& particles,
                         double time, bool with_boundaries) {
  struct Pair {
    micro::Vector<dim> difference;
    double found, exact;  // [Pa]
  };
  std::vector<Pair> pairs;
  double speed = 0;
  double mean_found = 0;
  double mean_exact = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const bool is_fluid = particles.kinds[i] == micro::ParticleKind::fluid;
    if (!is_fluid && !with_boundaries) continue;
    const micro::Vector<dim>& x = particles.positions[i];
    if (x[0] < scene.exact_from || x[0] > scene.exact_to) continue;
    const auto state = scene.exact->at(x, time);
    if (!state) continue;
    pairs.push_back(
        {particles.velocities[i] - state->velocity, particles.pressures[i], state->pressure});
    speed = std::max(speed, state->velocity.norm());
    mean_found += particles.pressures[i];
    mean_exact += state->pressure;
  }
  PlasmaError error;
  error.particles = pairs.size();
  if (pairs.empty()) return error;
  const auto count = static_cast<double>(pairs.size());
  mean_found /= count;
  mean_exact /= count;
  // At rest there is no speed to compare with but that of the scene.
  if (!(speed > 0)) speed = scene.speed;
  double velocities = 0;
  double pressures = 0;
  double largest_pressure = 0;
  for (const Pair& pair : pairs) {
    velocities += pair.difference.squaredNorm();
    error.largest_velocity = std::max(error.largest_velocity, pair.difference.norm() / speed);
    pressures += std::pow((pair.found - mean_found) - (pair.exact - mean_exact), 2);
    largest_pressure = std::max(largest_pressure, std::abs(pair.exact - mean_exact));
  }
  error.velocity = std::sqrt(velocities / count) / speed;
  if (largest_pressure > 0) error.pressure = std::sqrt(pressures / count) / largest_pressure;
  return error;
}

template PlasmaError plasma_error<2>(const PlasmaScene<2>&, const micro::ParticleSet<2>&, double,
                                     bool);
template PlasmaError plasma_error<3>(const PlasmaScene<3>&, const micro::ParticleSet<3>&, double,
                                     bool);

}  // namespace hemoscale::coupling
