#pragma once

#include <cstdint>
#include <memory>

#include "micro/ensemble/frame.hpp"
#include "micro/ensemble/parameters.hpp"
#include "micro/ensemble/step_limit.hpp"
#include "micro/model.hpp"

namespace hemoscale::micro {

/// Many deformable cells in a given two-dimensional flow [Tsubota2006, section 3.3].
///
/// Every node obeys  zeta (v - u(x)) = F,  F = -dE/dx,  E = membranes + contacts + walls,
/// integrated by explicit Euler steps in double precision: the reference that faster versions are
/// compared with.
///
/// Limits of the model: the flow is not changed by the cells, there is no hydrodynamic interaction
/// and no lift; the mean lateral position of an isolated cell is conserved exactly.
///
/// Results depend on the parameters, the seed, the stream and the forcing alone: not on the number
/// of threads, nor on when a snapshot was taken.
class EnsembleModel final : public MicroModel<2> {
 public:
  /// Checks every parameter and the time step, then packs the cells at random.
  /// @param stream  number of the random stream: models that share a seed differ by it
  /// @throws ParameterError if a parameter or the time step is not admissible, or the packing fails
  EnsembleModel(const EnsembleParameters& parameters, std::uint64_t seed, std::uint64_t stream = 0);
  ~EnsembleModel() override;
  EnsembleModel(EnsembleModel&&) noexcept;
  EnsembleModel& operator=(EnsembleModel&&) noexcept;

  /// Shear box only: simple shear at the rate velocity_gradient(0, 1), of either sign, until the
  /// total shear stress is known as well as `run` asks or the allowance is spent. body_force is not
  /// used: a uniform force on the fluid changes no stress in homogeneous shear.
  /// @throws ParameterError if the forcing is no simple shear, the rate is zero, the hematocrit is
  /// not
  ///         that of the box, the domain is a channel, or the run is not admissible
  /// @throws NumericalError with step, time, cell, node, value, limit and remedy
  Observation<2> advance(const Forcing<2>& forcing, const Run& run) override;

  /// Positions, image offset, time, strain, step: everything that continues with the same bits.
  Snapshot snapshot() const override;
  void restore(const Snapshot& snapshot) override;

  /// Either domain: advance by a duration, rounded to whole steps, and average over all of it. A
  /// channel takes its flow from forcing.profile (at least four points; its height must be that of
  /// the channel), a shear box its rate, which may be zero, from the velocity gradient.
  /// @throws ParameterError, NumericalError
  SceneObservation advance_by(const Forcing<2>& forcing, double duration);

  /// Calls `observer` during later runs at the first step at or beyond every multiple of `interval`
  /// of strain [-] or time [s], counted from the start of the model. An empty observer ends it.
  /// @throws ParameterError if the interval is not positive
  void observe(FrameClock clock, double interval, FrameObserver observer);

  EnsembleFrame frame() const;

  double time_step() const;             // [s]
  const StepLimit& step_limit() const;  // what the default of the time step comes from
  double cell_area() const;             // [m^2] of the undeformed polygon

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace hemoscale::micro
