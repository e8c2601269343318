#include "coupling/scene/case_checks.hpp"

#include <fmt/format.h>

#include "coupling/error.hpp"
#include "coupling/scene/build_blocks.hpp"
#include "coupling/scene/build_feed.hpp"
#include "coupling/scene/build_law.hpp"
#include "coupling/scene/build_loop.hpp"
#include "coupling/scene/build_micro.hpp"
#include "coupling/scene/cell_scene.hpp"
#include "coupling/scene/plasma_scene.hpp"
#include "macro/error.hpp"
#include "micro/ensemble/step_limit.hpp"
#include "micro/error.hpp"

namespace hemoscale::coupling {

namespace {

class FaultList {
 public:
  explicit FaultList(const Settings& settings) : settings_(settings) {}

  void add(const std::string& key, const std::string& message) {
    const Location place = settings_.location(key);
    faults.push_back({place.file, place.line, place.column, key, message});
  }

  /// Runs a builder; what it complains of becomes a fault of that key.
  template <class Builder>
  void attempt(const std::string& key, const Builder& build) {
    try {
      build();
    } catch (const CaseError& error) {
      faults.insert(faults.end(), error.faults().begin(), error.faults().end());
    } catch (const micro::ParameterError& error) {
      add(key, error.what());
    } catch (const macro::ParameterError& error) {
      add(key, error.what());
    }
  }

  std::vector<Fault> faults;

 private:
  const Settings& settings_;
};

void check_ensemble(const Settings& settings, bool force, FaultList& list) {
  const std::string& domain = settings.text("micro.domain");
  if (domain == "geometry" && settings.text("scene.kind") == "micro") {
    for (const auto& [key, message] : feed_faults(settings)) list.add(key, message);
  } else if (domain == "channel" && settings.text("micro.flow.kind") == "openfoam") {
    list.add("micro.flow.kind",
             "\"openfoam\" brings walls and openings of its own; choose micro.domain = "
             "\"geometry\", or another flow");
  }
  list.attempt("micro.model", [&] {
    const micro::EnsembleParameters parameters = build_ensemble_parameters(settings, 1, force);
    const micro::StepLimit limit = micro::step_limit(parameters);
    if (has_explicit_limit(settings) && parameters.time_step && !parameters.force &&
        *parameters.time_step > limit.time_step) {
      list.add("micro.time_step",
               fmt::format(
                   "{:.4g} s exceeds the limit of the explicit scheme, {:.4g} s = 2 zeta / "
                   "lambda_max (zeta {:.4g} Pa s, lambda_max {:.4g} Pa: ring {:.4g}, contact "
                   "{:.4g}, wall {:.4g}); reduce it, leave the key out (0.8 of the limit is "
                   "then taken), or use fewer nodes per cell; --force runs anyway",
                   *parameters.time_step, limit.time_step, limit.drag,
                   limit.ring + limit.contact + limit.wall, limit.ring, limit.contact, limit.wall));
    }
  });
}

template <int dim>
void check_plasma(const Settings& settings, bool force, FaultList& list) {
  list.attempt("micro.plasma.flow", [&] {
    const PlasmaScene<dim> scene = build_plasma_scene<dim>(settings, force);
    const bool has_step = settings.has("micro.plasma.time_step");
    if (!(scene.time_step > 0)) {
      list.add("micro.plasma.time_step",
               "is missing; neither a speed nor a viscous limit suggests one");
      return;
    }
    for (const micro::Limit& limit : plasma_limits(scene)) {
      if (!limit.exceeded() || force) continue;
      list.add(has_step ? "micro.plasma.time_step" : "micro.plasma.flow",
               micro::describe(limit) + "; --force runs anyway");
    }
    if (scene.sections && scene.sections->downstream <= scene.sections->upstream) {
      list.add("micro.plasma.length",
               "leaves no room for the sections at which the channel is measured; it must exceed "
               "two heights");
    }
  });
}

void check_cells(const Settings& settings, bool force, FaultList& list) {
  list.attempt("micro.plasma.membranes", [&] {
    if (plasma_dimension(settings) == 3) {
      list.add("micro.plasma.flow",
               fmt::format("\"{}\" has three dimensions, and membranes are rings of the plane; "
                           "choose a plane flow",
                           settings.text("micro.plasma.flow")));
      return;
    }
    const CellScene scene = build_cell_scene(settings, force);
    // The implicit coupling has no limits, and building it factors the plasma's matrix.
    if (settings.text("micro.plasma.membranes") == "implicit" || force) return;
    const bool has_step = settings.has("micro.plasma.time_step");
    for (const micro::Limit& limit : build_cells_in_plasma(scene, settings, true).limits()) {
      if (!limit.exceeded()) continue;
      list.add(has_step ? "micro.plasma.time_step" : "micro.plasma.membranes",
               micro::describe(limit) + "; --force runs anyway");
    }
  });
}

}  // namespace

std::vector<Fault> find_faults(const Settings& settings, bool force) {
  FaultList list(settings);
  if (settings.text("micro.model") == "ensemble") check_ensemble(settings, force, list);
  if (settings.text("micro.model") == "plasma") {
    if (settings.text("scene.kind") != "micro") {
      list.add("micro.model",
               "\"plasma\" is a scene of its own and gives no viscosity law; use scene.kind = "
               "\"micro\", or micro.model = \"ensemble\"");
      return list.faults;
    }
    if (has_cells_in_plasma(settings)) {
      check_cells(settings, force, list);
    } else if (settings.text("micro.plasma.flow") == "unbounded-shear") {
      list.add("micro.plasma.flow",
               "\"unbounded-shear\" has no particles of plasma; give it cells by "
               "micro.plasma.membranes = \"implicit\"");
    } else if (plasma_dimension(settings) == 3) {
      check_plasma<3>(settings, force, list);
    } else {
      check_plasma<2>(settings, force, list);
    }
    return list.faults;
  }
  if (settings.text("scene.kind") == "micro") {
    if (settings.text("micro.model") == "synthetic") {
      list.add(
          "micro.model",
          "\"synthetic\" has no scene of its own; use \"ensemble\", or scene.kind = \"coupled\"");
    }
    return list.faults;
  }
  if (settings.text("micro.model") == "ensemble" && settings.text("micro.domain") != "shear-box") {
    list.add("micro.domain",
             "a coupled scene measures viscosity in homogeneous shear; use \"shear-box\", or "
             "scene.kind = \"micro\" for a channel alone");
  }
  list.attempt("law.initial", [&] { build_law(settings, "law.initial", "law"); });
  if (settings.text("micro.model") == "synthetic") {
    list.attempt("micro.synthetic.law",
                 [&] { build_law(settings, "micro.synthetic.law", "micro.synthetic"); });
  }
  if (settings.text("macro.model") == "channel") {
    list.attempt("macro.channel.height", [&] {
      build_channel(settings);
      channel_points(settings);
    });
  } else if (!settings.has("sampling.points")) {
    list.add(
        "sampling.points",
        "is needed with macro.model = \"openfoam\": give the points at which the flow is sampled, "
        "for instance [[\"50 um\", \"10 um\", \"0.5 um\"]]");
  } else if (settings.text("coupling.scheme") == "implicit") {
    list.add(
        "coupling.scheme",
        "\"implicit\" repeats a window of the macro flow, which a solver of OpenFOAM cannot do; "
        "use \"explicit\"");
  }
  return list.faults;
}

}  // namespace hemoscale::coupling
