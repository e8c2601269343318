#include "coupling/scene/build_loop.hpp"

#include "coupling/sampling/sample_points.hpp"
#include "coupling/scene/build_micro.hpp"

namespace hemoscale::coupling {

LoopOptions build_loop_options(const Settings& settings, int threads) {
  LoopOptions options;
  options.run = build_run(settings);
  const double plasma = settings.quantity("fluid.plasma_viscosity");
  options.bounds.lowest_viscosity =
      plasma * settings.quantity("coupling.lowest_relative_viscosity");
  options.bounds.highest_viscosity =
      plasma * settings.quantity("coupling.highest_relative_viscosity");
  options.bounds.shear_thinning = settings.boolean("coupling.shear_thinning");
  const double factor = settings.quantity("coupling.relaxation_factor");
  if (settings.text("coupling.relaxation") == "aitken") {
    AitkenRelaxation aitken;
    aitken.initial_factor = factor;
    options.relaxation = aitken;
  } else {
    options.relaxation = ConstantRelaxation{factor};
  }
  options.memory =
      settings.text("coupling.memory") == "latest" ? Memory::latest : Memory::accumulate;
  options.tolerance = settings.quantity("coupling.tolerance");
  options.distinct_ratio = settings.quantity("sampling.distinct_ratio");
  options.lowest_shear_rate = settings.quantity("sampling.lowest_shear_rate");
  options.threads = threads;
  return options;
}

macro::ChannelModel<2> build_channel(const Settings& settings) {
  macro::Channel channel;
  channel.height = settings.quantity("macro.channel.height");
  channel.hematocrit = settings.quantity("fluid.hematocrit");
  if (settings.text("macro.channel.drive") == "pressure-gradient") {
    channel.drive = macro::PressureGradient{settings.quantity("macro.channel.pressure_gradient")};
  } else {
    channel.drive = macro::MeanVelocity{settings.quantity("macro.channel.mean_velocity")};
  }
  return macro::ChannelModel<2>(channel);
}

std::vector<macro::Vector<2>> channel_points(const Settings& settings) {
  if (settings.has("sampling.points"))
    return explicit_points<2>(settings.points("sampling.points"));
  const double height = settings.quantity("macro.channel.height");
  const macro::Vector<2> axis(0, height / 2);
  const macro::Vector<2> wall(0, 0);
  return points_across<2>(axis, wall, static_cast<int>(settings.integer("sampling.across")),
                          settings.quantity("sampling.closest_to_axis"));
}

}  // namespace hemoscale::coupling
