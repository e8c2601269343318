#include "coupling/scene/ensemble_checks.hpp"

#include <fmt/format.h>

#include <cstddef>

#include "coupling/scene/build_blocks.hpp"
#include "coupling/scene/build_feed.hpp"
#include "coupling/scene/build_micro.hpp"
#include "coupling/scene/ensemble_kinds.hpp"
#include "coupling/scene/fault_list.hpp"
#include "micro/ensemble/blocks/block_limits.hpp"
#include "micro/ensemble/packing/area_fraction.hpp"
#include "micro/ensemble/step_limit.hpp"

namespace hemoscale::coupling {

namespace {

std::string quoted_integrator(const Settings& settings) {
  return fmt::format("\"{}\"", integrator_name(settings));
}

void check_reference(const Settings& settings, bool force, FaultList& list) {
  if (settings.text("micro.domain") == "geometry") {
    for (const auto& [key, message] : feed_faults(settings)) list.add(key, message);
    return;
  }
  const auto on_vectors_alone = [&](const std::string& key, const std::string& what) {
    list.add(key, fmt::format("{} is known on vectors alone, and micro.integrator is {}; choose "
                              "another integrator in a channel",
                              what, quoted_integrator(settings)));
  };
  if (settings.text("micro.contact.law") != "polynomial") {
    on_vectors_alone("micro.contact.law", "\"" + settings.text("micro.contact.law") + "\"");
  }
  if (settings.quantity("micro.drag.normal_ratio") != 1) {
    on_vectors_alone("micro.drag.normal_ratio", "other than 1");
  }
  if (settings.quantity("micro.platelets.per_cell") > 0) {
    on_vectors_alone("micro.platelets.per_cell", "more than 0");
  }
  if (settings.text("micro.domain") != "shear-box" &&
      settings.text("micro.flow.kind") != "poiseuille") {
    on_vectors_alone("micro.flow.kind", "\"" + settings.text("micro.flow.kind") + "\"");
  }
  if (settings.text("micro.domain") == "channel" && settings.boolean("output.nodes")) {
    on_vectors_alone("output.nodes", "true");
  }
  if (settings.has("output.reference_nodes")) {
    on_vectors_alone("output.reference_nodes", "a reference");
  }
  if (!list.faults.empty()) return;
  list.attempt("micro.model", [&] {
    const micro::EnsembleParameters parameters = build_ensemble_parameters(settings, 1, force);
    const micro::StepLimit limit = micro::step_limit(parameters);
    if (parameters.time_step && !parameters.force && *parameters.time_step > limit.time_step) {
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

/// Options that an integrator or a law does not go with.
void check_options(const Settings& settings, FaultList& list) {
  const std::string law = micro::contact_law_faults(contact_law(settings));
  if (!law.empty()) list.add("micro.contact.law", law);
  const double ratio = settings.quantity("micro.drag.normal_ratio");
  const std::string integrator = integrator_name(settings);
  if (ratio != 1 && integrator != "explicit" && integrator != "chebyshev") {
    list.add("micro.drag.normal_ratio",
             fmt::format("{:g} needs micro.integrator = \"explicit\" or \"chebyshev\", and it is "
                         "{}; choose one of them, or 1",
                         ratio, quoted_integrator(settings)));
  }
  for (const char* key : {"micro.migration.wall_lift", "micro.migration.shear_lift",
                          "micro.migration.shear_diffusion"}) {
    if (!settings.has(key) || !(settings.quantity(key) > 0)) continue;
    if (settings.quantity("micro.platelets.per_cell") > 0) {
      list.add(key,
               "is a law of red cells and would move platelets too; choose 0, or "
               "micro.platelets.per_cell = 0");
    }
  }
}

void check_step(const Settings& settings, const BlockScene& scene, FaultList& list) {
  const micro::blocks::BlockLimit limit = micro::blocks::block_limit(scene.settings);
  if (scene.settings.time_step > limit.time_step && !scene.settings.force) {
    list.add("micro.time_step",
             fmt::format("{:.4g} s exceeds {:.4g} s: {}; reduce it, leave the key out (the program "
                         "then takes 0.8 of the limit or less){}; --force runs anyway",
                         scene.settings.time_step, limit.time_step, limit.because,
                         has_explicit_limit(settings) ? ", choose an implicit integrator" : ""));
  }
  const std::string precision = micro::blocks::single_precision_fault(scene.settings);
  if (scene.precision == micro::Precision::single && !precision.empty()) {
    list.add("micro.precision", precision);
  }
}

/// Lattices and tables are cheap; of random packing only what is impossible by its area alone is
/// found.
void check_packing(const Settings& settings, const BlockScene& scene, FaultList& list) {
  const auto cells = static_cast<std::size_t>(settings.integer("micro.cells"));
  if (settings.text("micro.packing.kind") != "random") {
    BlockScene red = scene;
    red.settings.kinds.resize(1);
    list.attempt("micro.packing.kind", [&] { pack_blocks(settings, red); });
  } else {
    list.attempt("fluid.hematocrit", [&] {
      micro::require_possible_fraction(cells, scene.settings.kinds.front().mesh.rest_area,
                                       scene.box);
    });
  }
}

void check_blocks(const Settings& settings, bool force, FaultList& list) {
  if (settings.text("micro.domain") == "shear-box") {
    list.add("micro.integrator",
             fmt::format("{} runs in a channel or geometry alone; choose \"explicit-reference\", "
                         "or micro.domain = \"channel\"",
                         quoted_integrator(settings)));
    return;
  }
  if (settings.text("micro.domain") == "geometry") {
    for (const auto& [key, message] : feed_faults(settings)) list.add(key, message);
  } else if (settings.text("micro.flow.kind") == "openfoam") {
    list.add("micro.flow.kind",
             "\"openfoam\" brings walls and openings of its own; choose micro.domain = "
             "\"geometry\", or another flow");
  }
  check_options(settings, list);
  if (!list.faults.empty() || settings.text("micro.domain") != "channel") return;
  list.attempt("micro.model", [&] {
    const BlockScene scene = build_blocks(settings, 1, force, {}, {});
    check_step(settings, scene, list);
    check_packing(settings, scene, list);
  });
}

std::string describe_cells(const Settings& settings, double node_drag) {
  return fmt::format(
      "micro: {} cells of {} nodes, hematocrit {:g} (area fraction), drag convention \"{}\"\n"
      "  drag of a node {:.4g} Pa s",
      settings.integer("micro.cells"), settings.integer("micro.nodes"),
      settings.quantity("fluid.hematocrit"), settings.text("micro.drag.convention"), node_drag);
}

std::string describe_step(double step, double limit) {
  return fmt::format("  limit of the time step {:.4g} s; step {:.4g} s, {:.2g} of the limit\n",
                     limit, step, step / limit);
}

}  // namespace

std::vector<Fault> ensemble_faults(const Settings& settings, bool force) {
  FaultList list(settings);
  if (integrator_name(settings) == "explicit-reference") {
    check_reference(settings, force, list);
  } else {
    check_blocks(settings, force, list);
  }
  return list.faults;
}

std::string describe_ensemble(const Settings& settings) {
  if (!runs_on_vectors(settings)) {
    const micro::EnsembleParameters parameters = build_ensemble_parameters(settings, 1, true);
    const micro::StepLimit limit = micro::step_limit(parameters);
    return describe_cells(settings, limit.drag) +
           fmt::format("; stiffness: ring {:.4g} Pa, contact {:.4g} Pa, wall {:.4g} Pa\n",
                       limit.ring, limit.contact, limit.wall) +
           describe_step(parameters.time_step.value_or(0.8 * limit.time_step), limit.time_step);
  }
  if (settings.text("micro.domain") == "geometry") {
    return fmt::format(
        "micro: cells of {} nodes enter through \"{}\" at a discharge hematocrit of {:g} (area "
        "fraction)\n  and leave through \"{}\"; drag of a node {:.4g} Pa s\n"
        "  the limit of the time step follows from the flow when the run begins\n",
        settings.integer("micro.nodes"), settings.text("micro.flow.inlet"),
        settings.quantity("fluid.hematocrit"), settings.text("micro.flow.outlets"),
        build_kinds(settings).kinds.front().node_drag);
  }
  const BlockScene scene = build_blocks(settings, 1, true, {}, {});
  const micro::blocks::BlockLimit limit = micro::blocks::block_limit(scene.settings);
  return describe_cells(settings, limit.drag) +
         fmt::format("; integrator {}; channel of {:.4g} m by {:.4g} m\n",
                     quoted_integrator(settings), scene.box.length, scene.box.height) +
         describe_step(scene.settings.time_step, limit.time_step) + "    " + limit.because + "\n";
}

}  // namespace hemoscale::coupling
