#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "coupling/report/series.hpp"
#include "coupling/scene/build_loop.hpp"
#include "coupling/scene/coupled_run.hpp"
#include "coupling/scene/hosts.hpp"
#include "coupling/scheme/coupling_scheme.hpp"

namespace hemoscale::coupling {

namespace {

std::unique_ptr<CouplingScheme<2>> build_scheme(const Settings& settings) {
  const std::string& scheme = settings.text("coupling.scheme");
  if (scheme == "one-way") return std::make_unique<OneWay<2>>();
  if (scheme == "implicit") {
    return std::make_unique<Implicit<2>>(
        static_cast<int>(settings.integer("coupling.maximum_passes")));
  }
  return std::make_unique<Explicit<2>>();
}

}  // namespace

void run_channel(const PreparedRun& run, const micro::Communicator& communicator) {
  const Settings& settings = run.settings;
  CoupledRun coupled(settings, run.results, run.restart, run.force, communicator, run.log);
  macro::ChannelModel<2> channel = build_channel(settings);
  if (!coupled.host_state().empty()) channel.restore(coupled.host_state());
  const std::unique_ptr<CouplingScheme<2>> scheme = build_scheme(settings);
  CoupledFlow<2> flow{channel, channel_points(settings), settings.quantity("fluid.hematocrit")};

  const PassCallback on_pass = [&](const LoopReport& report) {
    coupled.record(report, 0, channel.snapshot());
  };
  // The flow is steady: time stands still, and a window is one step towards the fixed point.
  const macro::Window window{0, 0};
  const bool one_way = settings.text("coupling.scheme") == "one-way";
  const auto passes = static_cast<int>(settings.integer("coupling.maximum_passes"));
  {
    const auto scope = coupled.timings().measure("coupled loop");
    while (!coupled.is_converged() && coupled.loop().passes() < (one_way ? 1 : passes)) {
      scheme->advance(flow, coupled.loop(), window, on_pass);
    }
  }

  const auto final_flow = channel.solve(coupled.loop().law());
  const macro::ChannelFlow<2>& solution = *final_flow;
  if (communicator.is_root()) {
    const double height = settings.quantity("macro.channel.height");
    const double hematocrit = settings.quantity("fluid.hematocrit");
    std::vector<std::vector<double>> rows;
    const int count = 201;
    for (int k = 0; k < count; ++k) {
      const double y = height * k / (count - 1);
      const double rate = solution.shear_rate(y);
      rows.push_back(
          {y, solution.velocity(y), rate, coupled.loop().law().viscosity(rate, hematocrit)});
    }
    write_table(run.results / "profile.csv",
                {{"y", "m"}, {"velocity", "m/s"}, {"shear rate", "1/s"}, {"viscosity", "Pa s"}},
                rows);
  }
  const double wall_rate = solution.wall_shear_rate();
  coupled.finish(
      {{"pressure gradient", solution.pressure_gradient(), "Pa/m"},
       {"mean velocity", solution.mean_velocity(), "m/s"},
       {"largest velocity", solution.velocity(settings.quantity("macro.channel.height") / 2),
        "m/s"},
       {"wall shear rate", wall_rate, "1/s"},
       {"viscosity at the wall",
        coupled.loop().law().viscosity(wall_rate, settings.quantity("fluid.hematocrit")), "Pa s"}},
      coupled.loop().law());
}

}  // namespace hemoscale::coupling
