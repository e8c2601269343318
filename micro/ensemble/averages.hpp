#pragma once

#include <cstdint>
#include <vector>

#include "micro/ensemble/state.hpp"
#include "micro/ensemble/stepper.hpp"
#include "micro/observation.hpp"

namespace hemoscale::micro {

/// Stress due to the cells [Pa], averaged over the box [Batchelor 1970; Irving and Kirkwood 1950
/// for the contacts]:
///
///   Sigma = -(1/V) [ sum_nodes F_membrane (x) (x - x_cell) + sum_pairs F_ab (x) (x_a - x_b) ]
///
/// F_membrane is the force of the node on the fluid; a stretched dumbbell gives Sigma_xx > 0. It
/// does not depend on origins, since membrane and pair forces sum to zero. Forces of walls are not
/// part of it: they are reported as a pressure on the walls.
Tensor<2> particle_stress(const StepSums& sums, const Box& box);

/// Records what should be constant, while samples are taken.
///
/// Entries: area and perimeter of the worst cell, relative to the reference shape; share of nodes
/// inside another cell; power balance of the sampled steps in simple shear,
///
///   sum |dE - dt (V Sigma:L - sum F.F / zeta)| / sum dt sum F.F / zeta,
///
/// which vanishes for exact integration and is proportional to the time step for Euler's. Where a
/// single mode of eigenvalue lambda relaxes it is dt lambda / (2 zeta): it reaches one at the limit
/// of stability, and stays there while an unstable mode is held by nonlinear forces.
class ConservationLedger {
 public:
  /// @param interpenetration_interval  samples between counts of nodes inside other cells, which
  /// cost
  ///        more than a step
  ConservationLedger(const EnsembleSystem& system, const Box& box,
                     std::int64_t interpenetration_interval);

  void record_shapes(const EnsembleState& state);

  /// One step. What the energies may have lost to round-off is forgiven.
  /// @param before, after  energies [N]
  /// @param power          V Sigma:L [W/m]
  /// @param dissipation    sum F.F / zeta [W/m]
  void record_power(double before, double after, double power, double dissipation);

  /// The shapes are looked at whenever they are recorded, the power balance once there are twenty
  /// sampled steps: the first steps from rest dissipate nothing yet.
  /// @throws NumericalError if an entry exceeds its `stop_above`
  void require_sound(const EnsembleState& state) const;

  std::vector<LedgerEntry> entries() const;

 private:
  const EnsembleSystem* system_;
  Box box_;
  std::int64_t interval_;
  std::int64_t samples_ = 0;
  double area_ = 0;
  double perimeter_ = 0;
  double inside_ = 0;
  double imbalance_ = 0;   // [N]
  double dissipated_ = 0;  // [N]
};

}  // namespace hemoscale::micro
