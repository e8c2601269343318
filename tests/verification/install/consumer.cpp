// A program of somebody else, built against the installed package: the plane channel flow of a
// Newtonian fluid has the wall shear rate 6 U / H.
#include <cmath>
#include <cstdio>

#include "macro/analytic/channel_model.hpp"
#include "micro/ensemble/step_limit.hpp"

int main() {
  using namespace hemoscale;
  const macro::ChannelModel<2> channel({1e-4, 0.4, macro::MeanVelocity{1e-3}});
  const double rate =
      channel.solve(macro::ViscosityLaw(macro::Newtonian{1e-3}))->wall_shear_rate();  // [1/s]
  const double step = micro::step_limit({}).time_step;                                // [s]
  std::printf("wall shear rate %g 1/s, limit of the time step %g s\n", rate, step);
  return std::abs(rate - 60) < 1e-6 && step > 0 ? 0 : 1;
}
