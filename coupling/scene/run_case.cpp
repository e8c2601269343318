#include "coupling/scene/run_case.hpp"

#include <fmt/format.h>

#include <ostream>

#include "coupling/config/read_case.hpp"
#include "coupling/error.hpp"
#include "coupling/scene/build_blocks.hpp"
#include "coupling/scene/build_law.hpp"
#include "coupling/scene/build_loop.hpp"
#include "coupling/scene/case_checks.hpp"
#include "coupling/scene/cell_scene.hpp"
#include "coupling/scene/coupled_run.hpp"
#include "coupling/scene/ensemble_checks.hpp"
#include "coupling/scene/hosts.hpp"
#include "coupling/scene/plasma_scene.hpp"
#include "coupling/scene/results_folder.hpp"
#include "macro/kinematics.hpp"

namespace hemoscale::coupling {

namespace {

namespace fs = std::filesystem;

std::string describe_channel(const Settings& settings) {
  const macro::ViscosityLaw law = build_law(settings, "law.initial", "law");
  const auto flow = build_channel(settings).solve(law);
  std::string text = fmt::format(
      "macro: plane channel of {:.4g} m; with the initial law: mean velocity {:.4g} m/s, pressure "
      "gradient {:.4g} Pa/m, wall shear rate {:.4g} 1/s\n",
      settings.quantity("macro.channel.height"), flow->mean_velocity(), flow->pressure_gradient(),
      flow->wall_shear_rate());
  text += "  shear rates at the sample points [1/s]:";
  for (const macro::Vector<2>& point : channel_points(settings)) {
    const auto state = flow->at(point, 0);
    text +=
        state ? fmt::format(" {:.4g}", macro::shear_rate<2>(state->velocity_gradient)) : " outside";
  }
  return text + "\n";
}

}  // namespace

CasePlace find_case(const fs::path& named) {
  std::error_code ignored;
  if (fs::is_regular_file(named, ignored)) {
    const fs::path folder = named.parent_path();
    return {folder.empty() ? fs::path(".") : folder, named};
  }
  if (!fs::is_directory(named, ignored)) {
    throw CaseError(
        {{named.string(), 0, 0, "",
          "there is no such folder or file; give a case folder (it holds case.toml), or "
          "the case file itself"}});
  }
  const fs::path file = named / "case.toml";
  if (fs::is_regular_file(file, ignored)) return {named, file};
  if (fs::is_regular_file(named / "system" / "controlDict", ignored)) {
    throw CaseError(
        {{named.string(), 0, 0, "",
          "is an OpenFOAM case without case.toml: its plug-in keys stand in "
          "system/controlDict and are checked when its solver starts; run the solver there, "
          "or give a folder with case.toml"}});
  }
  throw CaseError({{named.string(), 0, 0, "",
                    "is not a case folder: it holds neither case.toml nor system/controlDict"}});
}

Settings load_case(const fs::path& case_folder, const std::string& variant, bool force,
                   const std::vector<Override>& overrides) {
  const CasePlace place = find_case(case_folder);
  const Settings settings = interpret(read_toml(place.file), variant, overrides);
  std::vector<Fault> faults = find_faults(settings, force);
  if (settings.text("scene.kind") == "coupled" && settings.text("macro.model") == "openfoam") {
    for (const Override& setting : overrides) {
      const Location& at = setting.value.location;
      faults.push_back({at.file, at.line, at.column, setting.key,
                        "does not reach the solver of OpenFOAM, whose plug-in reads the case file "
                        "itself; write a variant with this key and name it with --variant"});
    }
  }
  if (!faults.empty()) throw CaseError(faults);
  return settings;
}

std::string describe_case(const Settings& settings) {
  std::string text =
      fmt::format("case {}, scene {}\n", settings.text("case.name"), settings.text("scene.kind"));
  if (settings.text("scene.kind") == "coupled") {
    text += settings.text("macro.model") == "channel"
                ? describe_channel(settings)
                : fmt::format("macro: {} in {}\n", settings.text("macro.openfoam.solver"),
                              settings.text("macro.openfoam.case"));
  }
  if (settings.text("micro.model") == "ensemble") text += describe_ensemble(settings);
  if (settings.text("micro.model") == "plasma") {
    text += has_cells_in_plasma(settings) ? describe_cells_in_plasma(settings)
                                          : describe_plasma(settings);
  }
  for (const std::string& statement : model_statements(settings))
    text += "note: " + statement + "\n";
  return text;
}

void run_case(const RunOptions& options, micro::Communicator&& communicator, std::ostream& log) {
  const auto ranks = std::make_shared<const micro::Communicator>(std::move(communicator));
  const micro::Communicator& group = *ranks;
  const CasePlace place = find_case(options.case_folder);
  const Settings settings =
      load_case(options.case_folder, options.variant, options.force, options.overrides);
  const bool is_micro = settings.text("scene.kind") == "micro";
  const bool has_cells = is_micro && has_cells_in_plasma(settings);
  const bool is_plasma = is_micro && !has_cells && settings.text("micro.model") == "plasma";
  const bool is_openfoam = !is_micro && settings.text("macro.model") == "openfoam";
  const bool on_vectors = is_micro && runs_on_vectors(settings);
  const bool on_ranks = is_plasma || (on_vectors && settings.text("micro.domain") != "geometry");
  if (group.size() > 1 && ((is_micro && !on_ranks) || is_openfoam)) {
    throw CaseError(
        {{place.file.string(), 0, 0, is_micro ? "scene.kind" : "macro.model",
          fmt::format("this scene runs on one process, but {} were started; {}", group.size(),
                      is_micro ? "run it without mpirun, it uses threads (OMP_NUM_THREADS)"
                               : "set macro.openfoam.ranks and run it without mpirun")}});
  }
  std::string variant = options.variant;
  if (variant.empty() && settings.has("case.variant")) variant = settings.text("case.variant");
  fs::path results = options.results;
  if (results.empty()) {
    results = place.folder / "results";
    if (place.file.stem() != "case") results /= place.file.stem();
    if (!variant.empty()) results /= variant;
  }

  const auto say = [&](const std::string& line) {
    if (group.is_root()) log << line << std::endl;
  };
  std::string failure;
  if (group.is_root()) {
    try {
      const std::string told = prepare_results_folder(results, options.restart);
      if (!told.empty()) say(told);
    } catch (const std::exception& error) {
      failure = error.what();
    }
  }
  if (group.size() == 1 && !failure.empty()) throw EnvironmentError(failure);
  group.agree(failure);

  const PreparedRun run{settings, place.folder,    place.file,    variant,
                        results,  options.restart, options.force, say};
  if (has_cells) {
    run_cells_in_plasma(run);
  } else if (is_plasma) {
    run_plasma(run, ranks);
  } else if (on_vectors) {
    run_ensemble(run, group);
  } else if (is_micro) {
    run_micro(run);
  } else if (is_openfoam) {
    run_openfoam(run);
  } else {
    run_channel(run, group);
  }
  say("results: " + results.string());
}

}  // namespace hemoscale::coupling
