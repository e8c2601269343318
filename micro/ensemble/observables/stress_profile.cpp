#include "micro/ensemble/observables/stress_profile.hpp"

#include <algorithm>

namespace hemoscale::micro {

std::vector<double> plane_stress(const EnsembleState& state, std::span<const double> force,
                                 double length, const LateralBins& bins) {
  const double width = bins.width();
  std::vector<double> own(bins.count, 0.0);    // [N/m] nodes in the bin: share of planes above them
  std::vector<double> whole(bins.count, 0.0);  // [N/m] of all nodes in the bin
  for (std::size_t i = 0; i < force.size(); ++i) {
    const std::size_t b = bins.bin_of(state.y[i]);
    const double above = static_cast<double>(b + 1) - state.y[i] / width;
    // A node beyond a wall lies below all planes, or below none.
    own[b] += force[i] * std::clamp(above, 0.0, 1.0);
    whole[b] += force[i];
  }
  std::vector<double> stress;
  stress.reserve(bins.count);
  double below = 0;
  for (std::size_t b = 0; b < bins.count; ++b) {
    stress.push_back((below + own[b]) / length);
    below += whole[b];
  }
  return stress;
}

std::vector<Tensor<2>> membrane_stresslets(const EnsembleState& state,
                                           std::span<const CellShape> shapes,
                                           const ForceView& membrane) {
  std::vector<Tensor<2>> stresslets;
  stresslets.reserve(state.cells);
  for (std::size_t cell = 0; cell < state.cells; ++cell) {
    Tensor<2> sum = Tensor<2>::Zero();
    for (std::size_t i = cell * state.nodes; i < (cell + 1) * state.nodes; ++i) {
      const Vector<2> from_centre(state.x[i] - shapes[cell].centre.x(),
                                  state.y[i] - shapes[cell].centre.y());
      sum -= Vector<2>(membrane.x[i], membrane.y[i]) * from_centre.transpose();
    }
    stresslets.push_back(sum);
  }
  return stresslets;
}

}  // namespace hemoscale::micro
