// CLI11 is seen by this file alone.
#include "coupling/program/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "coupling/config/nearest_key.hpp"
#include "coupling/config/read_value.hpp"
#include "coupling/program/failure.hpp"

namespace hemoscale::coupling {

namespace {

constexpr const char* description =
    "HemoScale: multiscale blood flow. A macroscopic flow drives models of many red\n"
    "cells, whose stress returns to it as viscosity.\n";

constexpr const char* footer =
    "\nExamples:\n"
    "  hemoscale check cases/channel-feedback\n"
    "  hemoscale run cases/channel-feedback --variant openfoam\n"
    "  mpirun -np 4 hemoscale run cases/channel-feedback\n"
    "  hemoscale run cases/channel-feedback --restart\n"
    "  hemoscale chart cases/ensemble-time-step --map\n"
    "  hemoscale reference micro.membrane\n"
    "\nExit codes:\n"
    "  0  done\n"
    "  1  the command line is wrong\n"
    "  2  the case is wrong; all its faults are listed\n"
    "  3  a file, a library, MPI or OpenFOAM failed\n"
    "  4  the numerics failed\n"
    "  5  anything else: a defect of this program\n";

constexpr const char* case_help = "Case folder, or the case.toml in it";
constexpr const char* set_help =
    "KEY=VALUE: replace a key of the case and its variant, e.g. micro.cells=40; repeatable";
constexpr const char* variant_help = "Variant of the case; default: case.variant, or none";

/// CLI11 says of a misspelled command only that one is required.
void complain(const CLI::App& app, const CLI::ParseError& error, int count, char** arguments) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  const std::string first = count > 1 ? arguments[1] : "";
  const bool is_command = std::count(names.begin(), names.end(), first) > 0;
  if (!first.empty() && first.front() != '-' && !is_command) {
    fmt::print(stderr, "hemoscale: there is no command {}; did you mean {}? Commands are {}\n",
               shown(first), nearest_word(first, names), fmt::join(names, ", "));
    return;
  }
  app.exit(error);
}

void add_overrides(CLI::App& command, std::vector<std::string>& texts) {
  // One value each time: what follows may be the case.
  command.add_option("--set", texts, set_help)
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

}  // namespace

Command parse_command_line(int count, char** arguments) {
  CLI::App app(description, "hemoscale");
  app.footer(footer);
  app.set_version_flag("--version", std::string("hemoscale ") + HEMOSCALE_VERSION,
                       "Print the version and exit");
  app.require_subcommand(1);

  CheckCommand check;
  CLI::App* check_app = app.add_subcommand("check", "Read a case and report all its faults");
  check_app->add_option("CASE", check.case_folder, case_help)->required();
  check_app->add_option("--variant", check.variant, variant_help);
  add_overrides(*check_app, check.set);
  check_app->footer("\nExample:\n  hemoscale check cases/channel-feedback --variant openfoam\n");

  RunCommand run;
  CLI::App* run_app = app.add_subcommand("run", "Run a case; also under mpirun");
  run_app->add_option("CASE", run.case_folder, case_help)->required();
  run_app->add_option("--variant", run.variant, variant_help);
  add_overrides(*run_app, run.set);
  run_app->add_option("--results", run.results,
                      "Folder of the results; default: results in the case, results/FILE for "
                      "FILE.toml, then /VARIANT");
  run_app->add_flag("--restart", run.restart, "Continue from the newest checkpoint");
  run_app->add_flag("--force", run.force, "Run although a stability limit is exceeded");
  run_app->footer(
      "\nExamples:\n"
      "  hemoscale run cases/channel-feedback\n"
      "  mpirun -np 4 hemoscale run cases/channel-feedback --results out\n"
      "  hemoscale run cases/channel-feedback --set fluid.hematocrit=0.3 --results thin\n"
      "  hemoscale run cases/channel-feedback --restart\n");

  ChartCommand chart;
  CLI::App* chart_app = app.add_subcommand(
      "chart", "Run a study: error against CPU time, observed orders, or a stability map");
  chart_app->add_option("STUDY", chart.study, "Study file, or a folder with study.toml")
      ->required();
  chart_app->add_flag("--map", chart.map, "Find the stability boundary of the study's [map]");
  chart_app->add_flag("--list", chart.list, "Tell what would be run, and run nothing");
  chart_app->add_flag("--fresh", chart.fresh, "Run again what is finished already");
  chart_app->add_option("--jobs", chart.jobs, "Runs at once; more than 1 spoils their CPU times")
      ->check(CLI::Range(1, 1024));
  chart_app->footer(
      "\nExamples:\n"
      "  hemoscale chart cases/ensemble-time-step --list\n"
      "  hemoscale chart cases/ensemble-time-step --map --jobs 2\n");

  ReferenceCommand reference;
  CLI::App* reference_app =
      app.add_subcommand("reference", "Print the keys of a case file: meaning, unit, default");
  reference_app->add_option("KEY", reference.key, "Key or section, e.g. micro.membrane");
  reference_app->add_flag("--markdown", reference.markdown, "As Markdown, for the documentation");
  reference_app->footer(
      "\nExamples:\n"
      "  hemoscale reference\n"
      "  hemoscale reference micro.membrane.stretch_modulus\n");

  CLI::App* doctor_app =
      app.add_subcommand("doctor", "Tell what is installed and usable on this machine");

  try {
    app.parse(count, arguments);
  } catch (const CLI::ParseError& answer) {
    if (answer.get_exit_code() == 0) return Answered{app.exit(answer)};  // help, version
    complain(app, answer, count, arguments);
    return Answered{exit_usage};
  }
  if (check_app->parsed()) return check;
  if (run_app->parsed()) return run;
  if (chart_app->parsed()) return chart;
  if (reference_app->parsed()) return reference;
  if (doctor_app->parsed()) return DoctorCommand{};
  return Answered{exit_usage};
}

}  // namespace hemoscale::coupling
