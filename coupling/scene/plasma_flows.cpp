#include "coupling/scene/plasma_flows.hpp"

#include <fmt/format.h>

#include <cmath>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "coupling/error.hpp"
#include "macro/analytic/couette.hpp"
#include "macro/analytic/decaying_flows.hpp"
#include "macro/analytic/poiseuille.hpp"
#include "macro/analytic/start_up.hpp"
#include "macro/analytic/womersley.hpp"
#include "micro/mps/inlet_flux.hpp"
#include "micro/mps/lattice_domains_flows.hpp"
#include "micro/mps/node_domains.hpp"

namespace hemoscale::coupling {

namespace {

const std::string prefix = "micro.plasma.";

/// Keys of a flow.
struct FlowKeys {
  std::vector<std::string> needed;
  std::vector<std::string> possible;
  bool by_particles = false;  // whether the semi-implicit method has such a domain
};

const std::map<std::string, FlowKeys>& flow_keys() {
  static const std::map<std::string, FlowKeys> keys = {
      {"open-channel", {{"height", "speed"}, {"inlet"}, true}},
      {"periodic-channel", {{"height", "speed"}, {"frequency"}, true}},
      {"couette", {{"height", "speed"}, {}, true}},
      {"taylor-green", {{"speed"}, {}, true}},
      {"taylor-green-3d", {{"speed"}, {}, false}},
      {"shear-box", {{"rate"}, {"speed"}, false}},
      {"column", {{"height", "gravity"}, {}, true}},
      {"rotating-patch", {{"rate"}, {}, true}},
      {"cylinder", {{"height", "speed", "radius"}, {"inlet"}, false}},
      {"constriction", {{"height", "speed", "throat", "narrowing"}, {"inlet"}, false}},
      {"bifurcation", {{"height", "speed", "nose", "divider"}, {"inlet"}, false}},
      {"pipe", {{"height", "speed"}, {}, false}},
      {"unbounded-shear", {{"rate"}, {}, false}}};
  return keys;
}

bool is_particle_method(const micro::PlasmaMethod& method) {
  return std::holds_alternative<micro::SemiImplicitOptions>(method);
}

void check_keys(const Settings& settings, bool by_particles) {
  const std::string& flow = settings.text(prefix + "flow");
  const FlowKeys& keys = flow_keys().at(flow);
  std::vector<Fault> faults;
  const auto fault = [&](const std::string& key, const std::string& message) {
    const Location place = settings.location(prefix + key);
    faults.push_back({place.file, place.line, place.column, prefix + key, message});
  };
  if (by_particles && !keys.by_particles) {
    fault("flow", fmt::format("\"{}\" is resolved by the operators lsmps2 alone; use scheme = "
                              "\"best\" or \"moving\"",
                              flow));
  }
  const auto holds = [](const std::vector<std::string>& list, const std::string& key) {
    return std::find(list.begin(), list.end(), key) != list.end();
  };
  for (const char* key : {"height", "speed", "inlet", "frequency", "rate", "gravity", "radius",
                          "throat", "narrowing", "nose", "divider"}) {
    const bool is_needed = holds(keys.needed, key);
    if (is_needed && !settings.has(prefix + key)) {
      const Location place = settings.location(prefix + "flow");
      faults.push_back({place.file, place.line, place.column, prefix + key,
                        fmt::format("is missing; the flow \"{}\" needs it", flow)});
    }
    if (!is_needed && !holds(keys.possible, key) && settings.was_given(prefix + key)) {
      fault(key, fmt::format("has no meaning for the flow \"{}\"; remove it", flow));
    }
  }
  if (!faults.empty()) throw CaseError(faults);
}

double get(const Settings& settings, const std::string& key) {
  return settings.quantity(prefix + key);
}

micro::NodeSpacing node_spacing(const Settings& settings) {
  return {.spacing = get(settings, "spacing"),
          .disorder = get(settings, "disorder"),
          .seed = static_cast<std::uint64_t>(settings.integer("case.seed"))};
}

micro::Lattice lattice(const Settings& settings, const micro::SemiImplicitOptions& options) {
  micro::Lattice result;
  result.spacing = get(settings, "spacing");
  result.wall_layers =
      static_cast<int>(std::ceil(std::max(options.gradient_ratio, options.laplacian_ratio)));
  result.disorder = get(settings, "disorder");
  result.seed = static_cast<std::uint64_t>(settings.integer("case.seed"));
  return result;
}

/// Gives every particle the exact velocity and pressure at t = 0.
template <int dim>
void begin_exactly(PlasmaScene<dim>& scene) {
  micro::ParticleSet<dim>& particles = scene.domain.particles;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const auto state = scene.exact->at(particles.positions[i], 0);
    if (!state) continue;
    particles.velocities[i] = state->velocity;
    particles.pressures[i] = state->pressure;
  }
}

template <int dim>
void exact_everywhere(PlasmaScene<dim>& scene, std::shared_ptr<const macro::FlowField<dim>> exact) {
  scene.exact = std::move(exact);
  scene.exact_from = -std::numeric_limits<double>::infinity();
  scene.exact_to = std::numeric_limits<double>::infinity();
}

/// The inlet velocity of the least-squares method; a uniform one is scaled to the exact flux.
std::function<micro::Vector<2>(const micro::Vector<2>&, double)> node_inflow(
    const Settings& settings, const micro::PlasmaMethod& method, double height, double speed) {
  if (settings.text(prefix + "inlet") == "parabolic") {
    return [=](const micro::Vector<2>& x, double) {
      const double s = x[1] / height;
      return micro::Vector<2>(6 * speed * s * (1 - s), 0);
    };
  }
  const double scaled =
      speed * micro::uniform_inlet_factor(std::get<micro::StageOptions>(method),
                                          std::round(height / get(settings, "spacing")));
  return [=](const micro::Vector<2>&, double) { return micro::Vector<2>(scaled, 0); };
}

void build_open_channel(const Settings& settings, PlasmaScene<2>& scene) {
  const double length = get(settings, "length");
  const double height = get(settings, "height");
  const double speed = get(settings, "speed");
  if (const auto* semi = std::get_if<micro::SemiImplicitOptions>(&scene.method)) {
    const bool parabolic = settings.text(prefix + "inlet") == "parabolic";
    scene.domain = micro::lattice_open_channel(
        lattice(settings, *semi), length, height,
        parabolic ? micro::parabolic_inflow(speed, height) : micro::uniform_inflow(speed));
  } else {
    scene.domain = micro::channel_nodes(length, height, false, node_spacing(settings));
    scene.domain.patches[micro::inlet_patch].velocity =
        node_inflow(settings, scene.method, height, speed);
  }
  scene.speed = 1.5 * speed;
  scene.size = height;
  // Developed after 0.63 heights; the outlet is felt for about as far.
  scene.sections = micro::ChannelSections{
      .height = height, .upstream = 1.5 * height, .downstream = length - 0.5 * height};
  const double gradient = 12 * scene.fluid.viscosity() * speed / (height * height);
  scene.exact = std::make_shared<macro::PlanePoiseuille<2>>(macro::PlanePoiseuilleProfile{
      .height = height, .pressure_gradient = gradient, .viscosity = scene.fluid.viscosity()});
  scene.exact_from = scene.sections->upstream;
  scene.exact_to = scene.sections->downstream;
}

void build_periodic_channel(const Settings& settings, PlasmaScene<2>& scene) {
  const double length = get(settings, "length");
  const double height = get(settings, "height");
  const double speed = get(settings, "speed");
  const double viscosity = scene.fluid.viscosity();
  const double gradient = 12 * viscosity * speed / (height * height);  // [Pa/m]
  const double push = gradient / scene.fluid.density;                  // [m/s^2]
  if (const auto* semi = std::get_if<micro::SemiImplicitOptions>(&scene.method)) {
    scene.domain = micro::lattice_periodic_channel(lattice(settings, *semi), length, height, push);
  } else {
    scene.domain = micro::channel_nodes(length, height, true, node_spacing(settings));
  }
  scene.speed = 1.5 * speed;
  scene.size = height;
  scene.compares_pressure = false;
  if (settings.has(prefix + "frequency")) {
    const double omega = 2 * std::numbers::pi * get(settings, "frequency");
    scene.domain.acceleration = [=](double t) {
      return micro::Vector<2>(push * std::cos(omega * t), 0);
    };
    exact_everywhere<2>(scene, std::make_shared<macro::WomersleyChannel<2>>(
                                   macro::WomersleyChannelProfile{.height = height,
                                                                  .oscillating_gradient = gradient,
                                                                  .angular_frequency = omega,
                                                                  .viscosity = viscosity,
                                                                  .density = scene.fluid.density}));
    begin_exactly(scene);
    for (double& pressure : scene.domain.particles.pressures) pressure = 0;  // the force drives
    return;
  }
  scene.domain.acceleration = [=](double) { return micro::Vector<2>(push, 0); };
  exact_everywhere<2>(scene, std::make_shared<macro::StartUpPoiseuille<2>>(
                                 macro::StartUpPoiseuilleProfile{.height = height,
                                                                 .pressure_gradient = gradient,
                                                                 .viscosity = viscosity,
                                                                 .density = scene.fluid.density}));
}

void build_couette(const Settings& settings, PlasmaScene<2>& scene) {
  const double length = get(settings, "length");
  const double height = get(settings, "height");
  const double speed = get(settings, "speed");
  if (const auto* semi = std::get_if<micro::SemiImplicitOptions>(&scene.method)) {
    scene.domain = micro::lattice_couette(lattice(settings, *semi), length, height, speed);
  } else {
    scene.domain = micro::channel_nodes(length, height, true, node_spacing(settings));
    scene.domain.patches[micro::upper_wall].velocity = [=](const micro::Vector<2>&, double) {
      return micro::Vector<2>(speed, 0);
    };
  }
  scene.speed = speed;
  scene.size = height;
  exact_everywhere<2>(scene, std::make_shared<macro::StartUpCouette<2>>(
                                 macro::StartUpCouetteProfile{.height = height,
                                                              .wall_velocity = speed,
                                                              .viscosity = scene.fluid.viscosity(),
                                                              .density = scene.fluid.density}));
}

template <int dim>
void build_taylor_green(const Settings& settings, PlasmaScene<dim>& scene) {
  const double length = get(settings, "length");
  const double speed = get(settings, "speed");
  scene.speed = speed;
  scene.size = length;
  exact_everywhere<dim>(scene, std::make_shared<macro::TaylorGreen<dim>>(
                                   macro::TaylorGreenFlow{.length = length,
                                                          .speed = speed,
                                                          .viscosity = scene.fluid.viscosity(),
                                                          .density = scene.fluid.density}));
  if constexpr (dim == 2) {
    if (const auto* semi = std::get_if<micro::SemiImplicitOptions>(&scene.method)) {
      scene.domain = micro::lattice_taylor_green<2>(lattice(settings, *semi), length, speed);
      return;
    }
  }
  scene.domain =
      micro::periodic_nodes<dim>(micro::Vector<dim>::Constant(length), node_spacing(settings));
  begin_exactly(scene);
}

void build_shear_box(const Settings& settings, PlasmaScene<2>& scene) {
  const double length = get(settings, "length");
  const double rate = get(settings, "rate");
  const double speed = settings.has(prefix + "speed") ? get(settings, "speed") : 0;
  scene.domain = micro::periodic_nodes<2>({length, length}, node_spacing(settings));
  scene.domain.sliding_rate = rate;
  scene.speed = rate * length + speed;
  scene.size = length;
  exact_everywhere<2>(scene, std::make_shared<macro::ShearWave>(
                                 macro::ShearWaveFlow{.height = length,
                                                      .rate = rate,
                                                      .speed = speed,
                                                      .viscosity = scene.fluid.viscosity(),
                                                      .density = scene.fluid.density}));
  begin_exactly(scene);
}

/// Fluid at rest under its weight.
class Hydrostatic final : public macro::FlowField<2> {
 public:
  Hydrostatic(double height, double weight) : height_(height), weight_(weight) {}
  std::optional<macro::FlowState<2>> at(const macro::Vector<2>& x, double) const override {
    macro::FlowState<2> state;
    state.pressure = weight_ * (height_ - x[1]);
    return state;
  }

 private:
  double height_;  // [m]
  double weight_;  // [N/m^3]
};

void build_column(const Settings& settings, PlasmaScene<2>& scene) {
  const double length = get(settings, "length");
  const double height = get(settings, "height");
  const double gravity = get(settings, "gravity");
  if (const auto* semi = std::get_if<micro::SemiImplicitOptions>(&scene.method)) {
    scene.domain = micro::lattice_tank(lattice(settings, *semi), length, height, gravity);
  } else {
    scene.domain = micro::column_nodes(length, height, node_spacing(settings));
  }
  scene.domain.acceleration = [=](double) { return micro::Vector<2>(0, -gravity); };
  scene.speed = std::sqrt(gravity * height);
  scene.size = height;
  exact_everywhere<2>(scene, std::make_shared<Hydrostatic>(height, scene.fluid.density * gravity));
}

void build_rotating_patch(const Settings& settings, PlasmaScene<2>& scene) {
  const double length = get(settings, "length");
  const double rate = get(settings, "rate");
  scene.fluid.kinematic_viscosity = 0;
  scene.speed = rate * length / std::sqrt(2.0);
  scene.size = length;
  if (const auto* semi = std::get_if<micro::SemiImplicitOptions>(&scene.method)) {
    scene.domain = micro::lattice_rotating_square(lattice(settings, *semi), length, rate);
    return;
  }
  scene.domain = micro::free_patch_nodes(length, node_spacing(settings));
  micro::ParticleSet<2>& particles = scene.domain.particles;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    particles.positions[i] -= micro::Vector<2>::Constant(length / 2);
    const micro::Vector<2>& x = particles.positions[i];
    particles.velocities[i] = rate * micro::Vector<2>(-x[1], x[0]);
  }
}

/// Channels whose walls are not straight, by nodes on an outline.
void build_shaped_channel(const Settings& settings, PlasmaScene<2>& scene) {
  const std::string& flow = settings.text(prefix + "flow");
  const double length = get(settings, "length");
  const double height = get(settings, "height");
  const double speed = get(settings, "speed");
  const micro::NodeSpacing spacing = node_spacing(settings);
  scene.speed = 1.5 * speed;
  scene.size = height;
  micro::ChannelSections sections{
      .height = height, .upstream = height, .downstream = length - height};
  if (flow == "cylinder") {
    const double radius = get(settings, "radius");
    scene.domain = micro::cylinder_nodes(length, height, radius, length / 2, false, spacing);
    scene.speed *= height / (height - 2 * radius);
  } else if (flow == "constriction") {
    const double throat = get(settings, "throat");
    scene.domain =
        micro::constriction_nodes(length, height, throat, get(settings, "narrowing"), spacing);
    scene.speed *= height / throat;
  } else {
    const double nose = get(settings, "nose");
    scene.domain =
        micro::bifurcation_nodes(length, height, nose, get(settings, "divider"), spacing);
    // Both sections lie before the branches.
    sections.upstream = 0.4 * nose;
    sections.downstream = 0.6 * nose;
  }
  scene.sections = sections;
  scene.domain.patches[micro::inlet_patch].velocity =
      node_inflow(settings, scene.method, height, speed);
}

void build_pipe(const Settings& settings, PlasmaScene<3>& scene) {
  const double radius = get(settings, "height") / 2;
  const double speed = get(settings, "speed");
  const double gradient = 8 * scene.fluid.viscosity() * speed / (radius * radius);
  scene.domain = micro::pipe_nodes(get(settings, "length"), radius, true, node_spacing(settings));
  const double push = gradient / scene.fluid.density;
  scene.domain.acceleration = [=](double) { return micro::Vector<3>(push, 0, 0); };
  scene.speed = 2 * speed;
  scene.size = 2 * radius;
  scene.compares_pressure = false;
  // A node on the wall may lie beyond it by rounding.
  exact_everywhere<3>(scene, std::make_shared<macro::PipePoiseuille>(macro::PipePoiseuilleProfile{
                                 .radius = radius * (1 + 1e-12),
                                 .pressure_gradient = gradient,
                                 .viscosity = scene.fluid.viscosity()}));
}

}  // namespace

template <>
void build_plasma_flow<2>(const Settings& settings, PlasmaScene<2>& scene) {
  check_keys(settings, is_particle_method(scene.method));
  const std::string& flow = settings.text(prefix + "flow");
  if (flow == "open-channel") return build_open_channel(settings, scene);
  if (flow == "periodic-channel") return build_periodic_channel(settings, scene);
  if (flow == "couette") return build_couette(settings, scene);
  if (flow == "taylor-green") return build_taylor_green<2>(settings, scene);
  if (flow == "shear-box") return build_shear_box(settings, scene);
  if (flow == "column") return build_column(settings, scene);
  if (flow == "rotating-patch") return build_rotating_patch(settings, scene);
  if (flow == "unbounded-shear") return;  // no particles: what is in it says how large it is
  build_shaped_channel(settings, scene);
}

template <>
void build_plasma_flow<3>(const Settings& settings, PlasmaScene<3>& scene) {
  check_keys(settings, is_particle_method(scene.method));
  if (settings.text(prefix + "flow") == "pipe") return build_pipe(settings, scene);
  build_taylor_green<3>(settings, scene);
}

}  // namespace hemoscale::coupling
