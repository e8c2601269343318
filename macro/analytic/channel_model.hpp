#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "macro/analytic/channel_profile.hpp"
#include "macro/macro_model.hpp"

namespace hemoscale::macro {

/// Steady flow along x in the channel 0 <= y <= height; in three dimensions z is neutral. Time does
/// not matter. The pressure is relative to that at x = 0. Empty outside the channel.
template <int dim>
class ChannelFlow final : public FlowField<dim> {
 public:
  explicit ChannelFlow(ChannelProfile profile);

  std::optional<FlowState<dim>> at(const Vector<dim>& x, double t) const override;

  /// @param y  0 to height [m]
  double velocity(double y) const { return profile_.at(y).velocity; }      // [m/s] along x
  double shear_rate(double y) const { return profile_.at(y).shear_rate; }  // [1/s]

  double height() const { return profile_.height(); }                        // [m]
  double pressure_gradient() const { return profile_.pressure_gradient(); }  // [Pa/m] G = -dp/dx
  double wall_shear_rate() const { return profile_.wall_shear_rate(); }      // [1/s]
  double mean_velocity() const { return profile_.mean_velocity(); }          // [m/s]
  double flow_rate_per_depth() const { return height() * mean_velocity(); }  // [m^2/s]

 private:
  ChannelProfile profile_;
};

/// Macroscopic flow that needs no flow solver: the steady plane channel flow of any viscosity law.
///
/// Stateless: the flow is steady, so that each window's answer depends on the law alone and windows
/// may be repeated or skipped. A snapshot is empty for the same reason.
template <int dim>
class ChannelModel final : public MacroModel<dim> {
 public:
  /// @throws ParameterError naming the first parameter that is not admissible
  explicit ChannelModel(const Channel& channel);

  /// The flow under this law.
  /// @throws NumericalError if the shear stress of the law does not increase with the shear rate
  ///         everywhere between rest and the wall; ParameterError if the law refuses the hematocrit
  std::shared_ptr<const ChannelFlow<dim>> solve(const ViscosityLaw& law) const;

  /// solve(); the window is not used.
  std::shared_ptr<const FlowField<dim>> advance(const ViscosityLaw& law,
                                                const Window& window) override;

  std::vector<double> snapshot() const override { return {}; }

  /// @throws ParameterError if the snapshot is not empty, hence not one of this model
  void restore(const std::vector<double>& snapshot) override;

  const Channel& channel() const { return channel_; }

 private:
  Channel channel_;
};

extern template class ChannelFlow<2>;
extern template class ChannelFlow<3>;
extern template class ChannelModel<2>;
extern template class ChannelModel<3>;

}  // namespace hemoscale::macro
