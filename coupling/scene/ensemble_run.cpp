#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>

#include "coupling/error.hpp"
#include "coupling/report/identity.hpp"
#include "coupling/report/progress.hpp"
#include "coupling/report/summary.hpp"
#include "coupling/report/timings.hpp"
#include "coupling/scene/build_blocks.hpp"
#include "coupling/scene/coupled_run.hpp"
#include "coupling/scene/ensemble_feed_run.hpp"
#include "coupling/scene/ensemble_kinds.hpp"
#include "coupling/scene/ensemble_nodes.hpp"
#include "coupling/scene/ensemble_results.hpp"
#include "coupling/scene/hosts.hpp"
#include "coupling/scene/trajectory_output.hpp"
#include "micro/ensemble/blocks/block_limits.hpp"
#include "micro/ensemble/observables/cross_forces.hpp"
#include "micro/ensemble/observables/observer.hpp"
#include "micro/ensemble/observables/step_forces.hpp"
#include "micro/ensemble/packing/state_checks.hpp"
#include "micro/ensemble/regions/region_ensemble.hpp"
#include "micro/snapshot/checkpoint.hpp"

namespace hemoscale::coupling {

namespace {

using Clock = std::chrono::steady_clock;

/// All kinds of cells in one frame, red cells first.
micro::EnsembleFrame frame_of(const std::vector<micro::EnsembleState>& states,
                              const micro::Box& box) {
  micro::EnsembleFrame frame;
  frame.time = states.front().time;
  frame.step = states.front().step;
  frame.length = box.length;
  frame.height = box.height;
  frame.walls = box.walls;
  std::int32_t first = 0;
  for (const micro::EnsembleState& state : states) {
    for (std::size_t i = 0; i < state.x.size(); ++i) {
      frame.positions.push_back(state.x[i]);
      frame.positions.push_back(state.y[i]);
      frame.cell_ids.push_back(first + static_cast<std::int32_t>(i / state.nodes));
    }
    first += static_cast<std::int32_t>(state.cells);
  }
  return frame;
}

/// The observers of all kinds, and what they need of a step.
class Observation {
 public:
  Observation(const BlockScene& scene) : scene_(scene) {
    for (std::size_t k = 0; k < scene.names.size(); ++k) {
      const auto& kind = scene.settings.kinds[k];
      observers_.push_back(std::make_unique<micro::EnsembleObserver>(
          micro::ObservedKind{.name = scene.names[k],
                              .rest_area = kind.mesh.rest_area,
                              .rest_perimeter = kind.mesh.rest_perimeter,
                              .node_drag = kind.node_drag,
                              .law = micro::make_pair_law(scene.settings.contact)},
          micro::ObserverOptions{}));
    }
  }

  ObservedKinds kinds() const {
    ObservedKinds all;
    for (const auto& observer : observers_) all.push_back(observer.get());
    return all;
  }

  void sample(std::vector<micro::EnsembleState>& before, std::vector<micro::EnsembleState>& after) {
    const micro::PairLaw& law = observers_.front()->kind().law;
    std::vector<micro::StepForces> forces;
    for (std::size_t k = 0; k < after.size(); ++k) {
      micro::bring_home(scene_.box, after[k], &before[k]);
      forces.push_back(forces_of(k, before[k], after[k], law));
    }
    micro::separate_other_kinds(forces, after, scene_.box, law);
    for (std::size_t k = 0; k < after.size(); ++k) {
      micro::ObservedNodes nodes;
      nodes.forces.membrane = forces[k].membrane.view();
      nodes.forces.other_kinds = forces[k].other_kinds.view();
      nodes.forces.wall = forces[k].wall.view();
      nodes.forces.lift = forces[k].lift.view();
      nodes.velocity_x = forces[k].velocity_x;
      nodes.velocity_y = forces[k].velocity_y;
      observers_[k]->sample(after[k], scene_.box, *scene_.settings.flow, nodes);
    }
  }

  micro::Snapshot snapshot(std::size_t kind) const { return observers_[kind]->snapshot(); }
  void restore(std::size_t kind, const micro::Snapshot& snapshot) {
    observers_[kind]->restore(snapshot);
  }
  std::size_t count() const { return observers_.size(); }

 private:
  micro::StepForces forces_of(std::size_t k, const micro::EnsembleState& before,
                              const micro::EnsembleState& after, const micro::PairLaw& law) const {
    const micro::blocks::BlockSettings& blocks = scene_.settings;
    const micro::blocks::KindSettings& kind = blocks.kinds[k];
    std::vector<double> drift;
    if (blocks.migration.is_any()) {
      drift = micro::drift_velocities(before, blocks.migration, scene_.box, *blocks.flow,
                                      blocks.time_step);
    }
    return micro::step_forces(
        before, after, blocks.time_step, scene_.box, *blocks.flow, kind.node_drag, law,
        *blocks.plane_walls,
        {.normal_ratio = kind.normal_drag, .momentum = kind.momentum_drag, .drift_y = drift});
  }

  const BlockScene& scene_;
  std::vector<std::unique_ptr<micro::EnsembleObserver>> observers_;
};

/// Threads of a rank. With fewer nodes each, waiting for each other takes longer than their work,
/// most of all on a machine that others use too.
int useful_threads(const Settings& settings, int ranks) {
  constexpr std::int64_t nodes_per_thread = 15000;
  const std::int64_t nodes = settings.integer("micro.cells") * settings.integer("micro.nodes");
  const std::int64_t most = available_threads() / ranks;
  return static_cast<int>(std::clamp<std::int64_t>(nodes / nodes_per_thread / ranks, 1,
                                                   std::max<std::int64_t>(1, most)));
}

std::string observer_slot(std::size_t kind) {
  return fmt::format("observer-{}", kind);
}

}  // namespace

void run_ensemble(const PreparedRun& run, const micro::Communicator& communicator) {
  const Settings& settings = run.settings;
  if (settings.text("micro.domain") == "geometry") {
    run_ensemble_feed(run, communicator);
    return;
  }
  if (settings.text("micro.domain") != "channel") {
    throw CaseError({{run.case_file.string(), 0, 0, "micro.domain",
                      "the integrators on vectors run alone in a channel or a geometry; choose "
                      "micro.domain = \"channel\", or micro.integrator = \"explicit-reference\""}});
  }
  const auto identity = state_settings(settings.as_text(), settings_free_at_restart());
  const double duration = settings.quantity("micro.duration");
  const double interval = settings.quantity("micro.output_interval");
  const bool is_root = communicator.is_root();
  Timings timings;
  Summary summary;
  const int threads = useful_threads(settings, communicator.size());
  const BlockScene scene = build_blocks(settings, threads, run.force, run.case_folder, run.results);
  const double dt = scene.settings.time_step;
  std::vector<micro::EnsembleState> initial;
  {
    const auto scope = timings.measure("packing");
    initial = pack_blocks(settings, scene);
  }
  micro::RegionEnsemble model(scene.settings, scene.precision,
                              micro::part_of_rank(initial, communicator), communicator,
                              region_options(settings));
  Observation observation(scene);
  double done = 0;
  if (run.restart) {
    const micro::RestoredCheckpoint restored = micro::restore_checkpoint(run.results, identity);
    model.restore(restored.checkpoint.slots.at("model"));
    for (std::size_t k = 0; k < observation.count(); ++k) {
      observation.restore(k, restored.checkpoint.slots.at(observer_slot(k)));
    }
    done = restored.checkpoint.time;
    summary.warnings = restored.warnings;
    for (const std::string& warning : restored.warnings) run.log("warning: " + warning);
    run.log(fmt::format("restart from {}: {:.6g} s done", restored.path.string(), done));
  }
  const std::vector<std::string> statements = ensemble_statements(optional_laws(settings));
  micro::FrameObserver trajectory;
  std::unique_ptr<EnsembleResults> results;
  if (is_root) {
    if (settings.boolean("output.trajectory")) {
      trajectory = trajectory_writer(run.results / "trajectory.h5", std::make_shared<std::mutex>());
    }
    results = std::make_unique<EnsembleResults>(
        run.results, observation.kinds(), scene.box.height, statements,
        run.restart ? std::optional<double>(done) : std::nullopt);
  }
  const auto observe = [&](std::vector<micro::EnsembleState> before) {
    std::vector<micro::EnsembleState> after = model.states();
    const auto scope = timings.measure("observables");
    if (!is_root) return;
    observation.sample(before, after);
    results->append();
    if (trajectory) trajectory(frame_of(after, scene.box));
  };
  const auto write_checkpoint = [&] {
    const auto scope = timings.measure("results");
    micro::Checkpoint checkpoint;
    checkpoint.number = std::llround(done / interval);
    checkpoint.time = done;
    checkpoint.identity = identity;
    checkpoint.texts["version"] = program_version();
    checkpoint.slots["model"] = model.snapshot();
    if (!is_root) return;
    for (std::size_t k = 0; k < observation.count(); ++k) {
      checkpoint.slots[observer_slot(k)] = observation.snapshot(k);
    }
    micro::write_checkpoint(run.results, checkpoint);
  };
  auto last_checkpoint = Clock::now();
  const double checkpoint_interval = settings.quantity("output.checkpoint_interval");
  std::unique_ptr<Progress> progress;
  if (is_root) progress = std::make_unique<Progress>("time [s]", done, duration);
  double largest_strain = 0;
  const auto advance = [&](std::int64_t steps) {
    const auto scope = timings.measure("micro model");
    model.advance(steps);
    largest_strain = std::max(largest_strain, model.largest_segment_strain());
  };
  if (done == 0) {  // The start, seen after one step: velocities need two positions.
    std::vector<micro::EnsembleState> before = model.states();
    advance(1);
    done = model.time();
    observe(std::move(before));
  }
  while (done + dt / 2 < duration) {
    const double next = std::min(duration, interval * (std::floor(done / interval + 0.5) + 1));
    const std::int64_t target = std::llround(next / dt);
    const std::int64_t steps = std::max<std::int64_t>(1, target - model.step());
    // Velocities and forces are those of the last step of the interval.
    if (steps > 1) advance(steps - 1);
    std::vector<micro::EnsembleState> before = model.states();
    advance(1);
    done = model.time();
    observe(std::move(before));
    if (progress) progress->update(done);
    const std::chrono::duration<double> since = Clock::now() - last_checkpoint;
    // All ranks decide alike.
    const bool due =
        communicator.broadcast(since.count() >= checkpoint_interval ? "1" : "0") == "1";
    if (due) {
      write_checkpoint();
      last_checkpoint = Clock::now();
    }
  }
  write_checkpoint();
  const auto states = model.states();
  if (!is_root) return;
  progress->finish();
  const auto scope = timings.measure("results");
  results->finish();
  finish_trajectories(run.results);
  summary.title = settings.text("case.name");
  summary.version = program_version();
  summary.seed = static_cast<std::uint64_t>(settings.integer("case.seed"));
  summary.identity = identity_hash(identity);
  summary.figures = results->figures();
  const auto& counters = model.counters();
  const auto add = [&](const char* name, double value, const char* unit) {
    summary.figures.push_back({name, value, unit});
  };
  add("time step", dt, "s");
  add("limit of the time step", micro::blocks::block_limit(scene.settings).time_step, "s");
  add("steps", static_cast<double>(model.step()), "-");
  add("rebuilds of the contact list", static_cast<double>(counters.rebuilds), "-");
  add("rebuilds that came late", static_cast<double>(counters.late_rebuilds), "-");
  add("steps between exchanges of copies", static_cast<double>(model.exchange_interval()), "-");
  add("dealings of cells to ranks", static_cast<double>(model.region_counters().migrations), "-");
  add("largest strain of a segment", largest_strain, "-");
  add("length of the channel", scene.box.length, "m");
  if (settings.boolean("output.nodes")) write_nodes(run.results / "nodes.csv", states);
  if (settings.has("output.reference_nodes")) {
    add("distance of the nodes from the reference",
        distance_from_reference(settings, run.case_folder, states), "m");
  }
  const std::vector<micro::Overlap> overlapping =
      micro::overlaps(states, micro::room_of(scene.box));
  add("overlapping pairs of cells at the end", static_cast<double>(overlapping.size()), "-");
  for (const auto& [name, value] : scene.flow.statements) add(name.c_str(), value, "-");
  if (counters.late_rebuilds > 0) {
    summary.warnings.push_back(fmt::format(
        "contact lists were rebuilt late {} times in {}: by the bound on their motion, nodes may "
        "have come within the cutoff before the list with its skin of {:.3g} um knew of them, and "
        "such contacts were seen some steps late; raise micro.list_skin{}",
        counters.late_rebuilds, counters.rebuilds, 1e6 * scene.settings.skin,
        communicator.size() > 1 ? " or lower micro.regions.exchange_interval" : ""));
  }
  const std::string step_fault = micro::blocks::step_fault(scene.settings);
  if (!step_fault.empty()) summary.warnings.push_back("forced: " + step_fault);
  if (!overlapping.empty()) {
    summary.warnings.push_back(fmt::format(
        "{} pairs of cells overlap at the end; stiffen the contacts or shorten the step",
        overlapping.size()));
  }
  summary.settings = settings.as_text();
  summary.host = this_host(threads, communicator.size());
  summary.statements = statements;
  summary.statements.push_back(fmt::format("vector kernels: {}", model.kernel_version()));
  timings.add("process", process_timing());
  summary.timings = timings.parts();
  write_summary(run.results / "summary.json", summary);
}

}  // namespace hemoscale::coupling
