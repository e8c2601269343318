#include "micro/immersed/cell_stress.hpp"

namespace hemoscale::micro {

Tensor<2> cell_stress(const RingSource& cell, double viscosity) {
  const RingSource::Points& ring = cell.coarse();
  const double contrast = viscosity * (cell.viscosity_ratio() - 1);
  Tensor<2> stress = Tensor<2>::Zero();
  for (std::size_t i = 0; i < ring.positions.size(); ++i) {
    // The forces sum to zero: the origin does not matter, but a near one loses no digits.
    const Vector<2> x = ring.positions[i] - ring.positions[0];
    stress -= ring.forces[i] * x.transpose();
    if (contrast == 0) continue;
    const Tensor<2> dyad = ring.velocities[i] * ring.normals[i].transpose();
    stress += contrast * (dyad + dyad.transpose());
  }
  return stress;
}

}  // namespace hemoscale::micro
