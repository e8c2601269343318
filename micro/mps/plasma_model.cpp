#include "micro/mps/plasma_model.hpp"

#include <fmt/format.h>

#include <cmath>

#include "micro/error.hpp"
#include "micro/mps/flow_figures.hpp"
#include "micro/particles/particle_snapshot.hpp"
#include "micro/velocity_profile.hpp"

namespace hemoscale::micro {

template <int dim>
struct PlasmaModel<dim>::Drive {
  std::optional<CubicProfile> profile;             // at inlets, instead of the domain's
  Vector<dim> acceleration = Vector<dim>::Zero();  // [m/s^2] on top of the domain's
};

namespace {

template <int dim, typename Drive>
void attach(FlowDomain<dim>& domain, const std::shared_ptr<Drive>& drive) {
  for (Patch<dim>& patch : domain.patches) {
    if (patch.kind != ParticleKind::inlet) continue;
    patch.velocity = [drive, own = patch.velocity](const Vector<dim>& x, double t) {
      Vector<dim> u = Vector<dim>::Zero();
      if (drive->profile) {
        u[0] = (*drive->profile)(x[1]);
      } else if (own) {
        u = own(x, t);
      }
      return u;
    };
  }
  domain.acceleration = [drive, own = domain.acceleration](double t) -> Vector<dim> {
    return own ? Vector<dim>(own(t) + drive->acceleration) : drive->acceleration;
  };
}

/// Mean friction of the rows of particles next to the walls of a channel, whose walls lie half a
/// spacing beyond them: mu u / (l0 / 2).
double friction_of_rows(const ParticleSet<2>& particles, const ChannelSections& sections,
                        double viscosity, double spacing) {
  double speeds = 0;
  double count = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const Vector<2>& x = particles.positions[i];
    if (particles.kinds[i] != ParticleKind::fluid) continue;
    if (x[0] < sections.upstream || x[0] > sections.downstream) continue;
    const double distance = std::min(x[1], sections.height - x[1]);
    if (distance > 0.9 * spacing) continue;
    speeds += particles.velocities[i][0] / distance;
    count += 1;
  }
  return count > 0 ? viscosity * speeds / count : 0;
}

}  // namespace

template <int dim>
PlasmaModel<dim>::PlasmaModel(FlowDomain<dim> domain, const Fluid& fluid,
                              const PlasmaMethod& method, double time_step,
                              const std::optional<ChannelSections>& sections,
                              std::shared_ptr<const Communicator> ranks)
    : fluid_(fluid),
      spacing_(domain.spacing),
      time_step_(time_step),
      box_(domain.box),
      sections_(sections),
      drive_(std::make_shared<Drive>()) {
  if (!(time_step > 0)) {
    throw ParameterError(fmt::format("the time step is {:g} s; it must be positive", time_step));
  }
  attach(domain, drive_);
  if (const auto* stage = std::get_if<StageOptions>(&method)) {
    fit_radius_ = stage->kernel_ratio * spacing_;
    stepper_ = std::make_unique<StageStepper<dim>>(std::move(domain), fluid, *stage, ranks);
  } else {
    if (ranks->size() > 1) {
      throw ParameterError(fmt::format(
          "the semi-implicit particle method runs on one process, but {} were started; use threads "
          "(OMP_NUM_THREADS), or the operators lsmps2",
          ranks->size()));
    }
    fit_radius_ = 2.5 * spacing_;
    stepper_ = std::make_unique<SemiImplicitStepper<dim>>(domain, fluid,
                                                          std::get<SemiImplicitOptions>(method));
  }
}

template <int dim>
void PlasmaModel<dim>::advance_by(double duration) {
  if (!(duration > 0)) {
    throw ParameterError(fmt::format("the duration is {:g} s; it must be positive", duration));
  }
  // Rounding must not add a step to a stretch that holds a whole number of them.
  const auto count = std::max(1L, std::lround(std::ceil(duration / time_step_ - 1e-9)));
  const double step = duration / static_cast<double>(count);
  for (long k = 0; k < count; ++k) {
    std::visit([&](const auto& stepper) { stepper->step(step); }, stepper_);
  }
}

template <int dim>
PlasmaObservation PlasmaModel<dim>::observe() {
  PlasmaObservation seen;
  seen.time = time();
  seen.particles = particles().size();
  seen.kinetic_energy = kinetic_energy(particles(), fluid_.density, spacing_);
  for (const Vector<dim>& u : particles().velocities) {
    seen.largest_speed = std::max(seen.largest_speed, u.norm());
  }
  if (const auto* stage = std::get_if<0>(&stepper_)) {
    const StepReport& report = (*stage)->report();
    seen.steps = (*stage)->steps();
    seen.entered = report.inserted;
    seen.left = report.removed;
    seen.solver_iterations = report.solve.iterations;
    seen.residual = report.solve.relative_residual;
  } else {
    const auto& semi = *std::get<1>(stepper_);
    seen.steps = semi.steps();
    seen.entered = static_cast<std::size_t>(semi.ledger().entered);
    seen.left = static_cast<std::size_t>(semi.ledger().left);
    seen.solver_iterations = semi.report().pressure_iterations;
    seen.residual = semi.report().relative_residual;
  }
  if (sections_) measure_channel(seen);
  return seen;
}

template <int dim>
void PlasmaModel<dim>::measure_channel(PlasmaObservation& seen) {
  if constexpr (dim == 2) {
    const ChannelSections& sections = *sections_;
    ParticleSet<2> carriers;  // of a velocity and a pressure of their own
    const ParticleSet<2>& all = particles();
    for (std::size_t i = 0; i < all.size(); ++i) {
      const bool is_wall_particle = stepper_.index() == 1 && all.kinds[i] != ParticleKind::fluid;
      if (is_wall_particle) continue;
      carriers.append(all.positions[i], all.identities[i]);
      carriers.velocities.back() = all.velocities[i];
      carriers.pressures.back() = all.pressures[i];
    }
    const LeastSquares fit{.radius = fit_radius_};
    const SectionFlow first =
        section_flow(fit, carriers, box_, spacing_, sections.upstream, sections.height);
    const SectionFlow last =
        section_flow(fit, carriers, box_, spacing_, sections.downstream, sections.height);
    seen.flow_rate_upstream = first.flow_rate;
    seen.flow_rate_downstream = last.flow_rate;
    seen.pressure_drop = first.pressure - last.pressure;
    if (auto* stage = std::get_if<0>(&stepper_)) {
      seen.wall_shear_stress = mean_wall_friction((*stage)->nodes(), all, fluid_.viscosity(),
                                                  {sections.lower_wall, sections.upper_wall},
                                                  sections.upstream, sections.downstream);
    } else {
      seen.wall_shear_stress = friction_of_rows(all, sections, fluid_.viscosity(), spacing_);
    }
  }
}

template <int dim>
void PlasmaModel<dim>::impose(const Forcing<dim>& forcing) {
  drive_->profile.reset();
  if (forcing.profile) drive_->profile.emplace(*forcing.profile);
  drive_->acceleration = forcing.body_force / fluid_.density;
}

template <int dim>
Observation<dim> PlasmaModel<dim>::advance(const Forcing<dim>& forcing, const Run& run) {
  if (!sections_) {
    throw ParameterError(
        "only a channel has a wall shear stress to observe; build the model with channel sections");
  }
  impose(forcing);
  const double scale = sections_->height;  // [m]
  double speed = 0;
  if (forcing.profile) {
    for (const double u : forcing.profile->velocities) speed = std::max(speed, std::abs(u));
  }
  // Body forces drive U = f h^2 / (8 mu) on the axis.
  speed =
      std::max(speed, std::abs(forcing.body_force[0]) * scale * scale / (8 * fluid_.viscosity()));
  if (!(speed > 0)) {
    throw ParameterError("the forcing holds neither a velocity profile nor a body force along x");
  }
  const double strain_time = scale / speed;  // [s] of one strain unit
  Observation<dim> result;
  result.shear_rate = 4 * speed / scale;
  const double start = time();
  double last = observe().wall_shear_stress;
  double strain = 0;
  while (strain < run.warm_up_strain + run.maximum_strain) {
    advance_by(strain_time);
    strain += 1;
    const double stress = observe().wall_shear_stress;
    const double change = std::abs(stress - last);
    last = stress;
    const bool is_steady = change <= run.relative_standard_error * std::abs(stress);
    if (is_steady && strain >= run.warm_up_strain + run.minimum_strain) {
      result.termination = Termination::precision_reached;
      break;
    }
  }
  const PlasmaObservation seen = observe();
  result.shear_stress.mean = last;
  result.averaging_time = time() - start;
  result.steps = seen.steps;
  result.channel = ChannelObservation{.flow_rate = seen.flow_rate_downstream,
                                      .pressure_drop = seen.pressure_drop,
                                      .wall_shear_stress = last};
  const double lost =
      seen.flow_rate_upstream != 0 ? seen.flow_rate_downstream / seen.flow_rate_upstream - 1 : 0;
  result.ledger.push_back({.name = "flow rate between the sections",
                           .deviation = std::abs(lost),
                           .warn_above = 0.01,
                           .stop_above = 0.1});
  return result;
}

template <int dim>
Snapshot PlasmaModel<dim>::snapshot() const {
  if (const auto* semi = std::get_if<1>(&stepper_)) return (*semi)->snapshot();
  const StageStepper<dim>& stage = *std::get<0>(stepper_);
  Snapshot snapshot;
  store_particles(stage.particles(), "stage.", snapshot);
  snapshot.reals["stage.time"] = {stage.time()};
  snapshot.integers["stage.counters"] = {
      dim, stage.steps(), static_cast<std::int64_t>(stage.report().inserted),
      static_cast<std::int64_t>(stage.report().removed), stage.next_identity()};
  return snapshot;
}

template <int dim>
void PlasmaModel<dim>::restore(const Snapshot& snapshot) {
  if (auto* semi = std::get_if<1>(&stepper_)) {
    (*semi)->restore(snapshot);
    return;
  }
  const auto counters = snapshot.integers.find("stage.counters");
  const auto time = snapshot.reals.find("stage.time");
  if (counters == snapshot.integers.end() || counters->second.size() != 5 ||
      time == snapshot.reals.end() || time->second.size() != 1 || counters->second[0] != dim) {
    throw ParameterError(fmt::format(
        "the snapshot does not belong to a least-squares plasma of {} dimensions; restore it into "
        "the kind of model that wrote it",
        dim));
  }
  const std::vector<std::int64_t>& c = counters->second;
  std::get<0>(stepper_)->restore(load_particles<dim>(snapshot, "stage."),
                                 {.time = time->second[0],
                                  .steps = c[1],
                                  .inserted = static_cast<std::size_t>(c[2]),
                                  .removed = static_cast<std::size_t>(c[3]),
                                  .next_identity = c[4]});
}

template <int dim>
const ParticleSet<dim>& PlasmaModel<dim>::particles() const {
  return std::visit(
      [](const auto& stepper) -> const ParticleSet<dim>& { return stepper->particles(); },
      stepper_);
}

template <int dim>
double PlasmaModel<dim>::time() const {
  return std::visit([](const auto& stepper) { return stepper->time(); }, stepper_);
}

template <int dim>
std::string PlasmaModel<dim>::describe_solver() const {
  if (const auto* stage = std::get_if<0>(&stepper_)) return (*stage)->describe_solver();
  return "pressure: conjugate gradients with multigrid on lattices";
}

template <int dim>
Vector<dim> PlasmaModel<dim>::force_on(std::int32_t patch) {
  auto* stage = std::get_if<0>(&stepper_);
  if (stage == nullptr) {
    throw ParameterError(
        "the semi-implicit method has no stress on its walls; use the operators lsmps2");
  }
  return boundary_force((*stage)->nodes(), particles(), fluid_.viscosity(), patch);
}

template class PlasmaModel<2>;
template class PlasmaModel<3>;

}  // namespace hemoscale::micro
