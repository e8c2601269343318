#include "macro/analytic/channel_model.hpp"

#include <string>
#include <utility>

#include "macro/error.hpp"

namespace hemoscale::macro {

template <int dim>
ChannelFlow<dim>::ChannelFlow(ChannelProfile profile) : profile_(std::move(profile)) {}

template <int dim>
std::optional<FlowState<dim>> ChannelFlow<dim>::at(const Vector<dim>& x, double /*t*/) const {
  if (!(x[1] >= 0 && x[1] <= profile_.height())) return std::nullopt;
  const ChannelProfile::Point point = profile_.at(x[1]);
  FlowState<dim> state;
  state.velocity[0] = point.velocity;
  state.velocity_gradient(0, 1) = point.gradient;
  state.pressure = -profile_.pressure_gradient() * x[0];
  return state;
}

template <int dim>
ChannelModel<dim>::ChannelModel(const Channel& channel) : channel_(channel) {
  check(channel_);
}

template <int dim>
std::shared_ptr<const ChannelFlow<dim>> ChannelModel<dim>::solve(const ViscosityLaw& law) const {
  return std::make_shared<const ChannelFlow<dim>>(ChannelProfile(law, channel_));
}

template <int dim>
std::shared_ptr<const FlowField<dim>> ChannelModel<dim>::advance(const ViscosityLaw& law,
                                                                 const Window& /*window*/) {
  return solve(law);
}

template <int dim>
void ChannelModel<dim>::restore(const std::vector<double>& snapshot) {
  if (snapshot.empty()) return;
  throw ParameterError("channel model: the snapshot holds " + std::to_string(snapshot.size()) +
                       " numbers; allowed: none, since a steady channel has no state; restore a "
                       "snapshot that this model made");
}

template class ChannelFlow<2>;
template class ChannelFlow<3>;
template class ChannelModel<2>;
template class ChannelModel<3>;

}  // namespace hemoscale::macro
