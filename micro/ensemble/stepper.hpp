#pragma once

#include <cstddef>
#include <vector>

#include "micro/ensemble/neighbour_list.hpp"
#include "micro/ensemble/pair_forces.hpp"
#include "micro/ensemble/state.hpp"
#include "micro/ensemble/system.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// Sums over the ensemble at the beginning of a step.
struct StepSums {
  Tensor<2> membrane_virial = Tensor<2>::Zero();  // [N] sum of F (x) (x - centre of the cell)
  Tensor<2> contact_virial = Tensor<2>::Zero();   // [N] sum over pairs of F_ab (x) r_ab
  double dissipation = 0;                         // [W/m] sum of F.F / zeta
  double lower_wall = 0;                          // [N/m] force of the cells on the wall at y = 0
  double upper_wall = 0;                          // [N/m] and at y = height
};

/// Forces and explicit Euler steps:  x += dt (u(x) + F / zeta).
///
/// Owns scratch memory alone; two steppers continue the same state with the same bits.
class Stepper {
 public:
  explicit Stepper(const EnsembleSystem& system);

  /// One step.
  /// @param sums  filled with the sums before the step unless null
  /// @throws NumericalError with step, time, cell, node, value, limit and remedy
  void step(EnsembleState& state, const Box& box, const Flow& flow, StepSums* sums = nullptr);

  /// Energy of membranes, contacts and walls per unit depth [N].
  double energy(const EnsembleState& state, const Box& box);

  /// Forget the neighbour list: positions or box were changed by others.
  void invalidate() { list_is_valid_ = false; }

  /// Node forces of the last step [N/m].
  const std::vector<double>& force_x() const { return force_x_; }
  const std::vector<double>& force_y() const { return force_y_; }

 private:
  void update_list(const EnsembleState& state, const Box& box);
  void forces_on_cell(std::size_t cell, const EnsembleState& state, const Box& box,
                      const ImageTable& images, RingGeometry& scratch, bool sampled);
  void move_cell(std::size_t cell, EnsembleState& state, const Flow& flow) const;
  void watch(const EnsembleState& state) const;
  void add_sums(const EnsembleState& state, const Box& box, StepSums& sums) const;
  bool bring_home(EnsembleState& state, const Box& box) const;

  EnsembleSystem system_;
  NeighbourList list_;
  bool list_is_valid_ = false;
  double list_skin_ = 0;    // [m]
  double list_travel_ = 0;  // [m] bound on the motion relative to the flow since the list was built
  double list_strain_ = 0;  // [-] since the list was built
  std::vector<double> force_x_, force_y_;  // [N/m]
  std::vector<RingGeometry> scratch_;      // per thread
  struct CellSums {
    double squared_forces = 0;         // [N^2/m^2]
    double largest_squared_force = 0;  // [N^2/m^2]
    double largest_stretch = 1;        // [-] length over rest length
    double smallest_stretch = 1;
    Tensor<2> membrane_virial = Tensor<2>::Zero();
    Tensor<2> contact_virial = Tensor<2>::Zero();
  };
  std::vector<CellSums> cell_sums_;
};

}  // namespace hemoscale::micro
