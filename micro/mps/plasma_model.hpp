#pragma once

#include <memory>
#include <optional>
#include <variant>

#include "micro/model.hpp"
#include "micro/mps/semi_implicit_stepper.hpp"
#include "micro/mps/stage_stepper.hpp"

namespace hemoscale::micro {

/// Which solver advances the plasma, with its choices.
using PlasmaMethod = std::variant<StageOptions, SemiImplicitOptions>;

/// Where a channel along x between the walls y = 0 and `height` is measured.
struct ChannelSections {
  double height = 0;            // [m]
  double upstream = 0;          // [m] abscissa of the first section
  double downstream = 0;        // [m] and of the second
  std::int32_t lower_wall = 0;  // patches whose friction is the wall shear stress
  std::int32_t upper_wall = 1;
};

/// The plasma at one moment.
struct PlasmaObservation {
  double time = 0;  // [s]
  std::int64_t steps = 0;
  std::size_t particles = 0;  // of all kinds
  double kinetic_energy = 0;  // [J/m; 3-D: J]
  double largest_speed = 0;   // [m/s]
  std::size_t entered = 0;    // particles through inlets since the start
  std::size_t left = 0;       // and outlets
  int solver_iterations = 0;  // of the last step
  double residual = 0;        // [-] of the last solve

  // Channels with sections only.
  double flow_rate_upstream = 0;    // [m^2/s] per depth
  double flow_rate_downstream = 0;  // [m^2/s]
  double pressure_drop = 0;         // [Pa] from the first section to the second
  double wall_shear_stress = 0;     // [Pa] mean over both walls between the sections
};

/// Plasma resolved by particles in a channel, a box or a piece of tissue: one face for both
/// steppers.
///
/// As a MicroModel it is driven by the velocity profile (at inlets) and the body force of the
/// Forcing, on top of what its domain says.
template <int dim>
class PlasmaModel final : public MicroModel<dim> {
 public:
  /// @param time_step  [s] longest; a stretch of time is divided into equal steps
  /// @param ranks      share the work (least-squares method only)
  /// @throws ParameterError if something is not admissible, a limit of the method exceeded included
  PlasmaModel(FlowDomain<dim> domain, const Fluid& fluid, const PlasmaMethod& method,
              double time_step, const std::optional<ChannelSections>& sections = std::nullopt,
              std::shared_ptr<const Communicator> ranks = std::make_shared<Communicator>());

  PlasmaModel(PlasmaModel&&) noexcept = default;
  PlasmaModel& operator=(PlasmaModel&&) noexcept = default;
  ~PlasmaModel() override = default;

  /// Advances by a stretch of time.
  /// @throws NumericalError naming step, time, particle, value, limit and remedy; the particles are
  ///         then those of the last good step
  void advance_by(double duration);

  PlasmaObservation observe();

  /// Advances under constant forcing until the wall shear stress changes by less than the wanted
  /// relative error per strain unit, or the allowance of strain is spent. The shear stress is that
  /// of the walls, without statistical error: the plasma has no noise to average.
  /// @throws ParameterError without channel sections
  Observation<dim> advance(const Forcing<dim>& forcing, const Run& run) override;

  Snapshot snapshot() const override;
  void restore(const Snapshot& snapshot) override;

  /// What the inlet and the body force are from now on.
  void impose(const Forcing<dim>& forcing);

  const ParticleSet<dim>& particles() const;
  double time() const;
  double time_step() const { return time_step_; }
  const Fluid& fluid() const { return fluid_; }
  double spacing() const { return spacing_; }
  std::string describe_solver() const;

  /// Force of the fluid on a boundary [N/m; 3-D: N]; least-squares method only.
  /// @throws ParameterError with the semi-implicit method, whose walls carry no stress
  Vector<dim> force_on(std::int32_t patch);

 private:
  struct Drive;  // what impose() sets; the domain's functions read it

  using Stepper =
      std::variant<std::unique_ptr<StageStepper<dim>>, std::unique_ptr<SemiImplicitStepper<dim>>>;

  void measure_channel(PlasmaObservation& seen);

  Fluid fluid_;
  double spacing_ = 0;    // [m]
  double time_step_ = 0;  // [s]
  PeriodicBox<dim> box_;
  double fit_radius_ = 0;  // [m] of the parabolas that sections are read from
  std::optional<ChannelSections> sections_;
  std::shared_ptr<Drive> drive_;
  Stepper stepper_;
};

}  // namespace hemoscale::micro
