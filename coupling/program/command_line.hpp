#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace hemoscale::coupling {

struct CheckCommand {
  std::filesystem::path case_folder;  // or its case.toml
  std::string variant;                // empty: the case's own
  std::vector<std::string> set;       // KEY=VALUE each
};

struct RunCommand {
  std::filesystem::path case_folder;  // or its case.toml
  std::string variant;                // empty: the case's own
  std::filesystem::path results;      // empty: in the case
  bool restart = false;
  bool force = false;
  std::vector<std::string> set;  // KEY=VALUE each
};

struct ChartCommand {
  std::filesystem::path study;  // study file, or a folder that holds study.toml
  bool map = false;             // the stability map instead of the chart
  bool list = false;            // tell what would be run, run nothing
  bool fresh = false;           // run again what is finished
  int jobs = 1;                 // [-] runs at once
};

struct ReferenceCommand {
  std::string key;  // or a section; empty: all
  bool markdown = false;
};

struct DoctorCommand {};

/// The command line has been answered (help, version) or refused; the text has been printed.
struct Answered {
  int exit_code = 0;
};

using Command =
    std::variant<Answered, CheckCommand, RunCommand, ChartCommand, ReferenceCommand, DoctorCommand>;

/// What the user asks for. Help and version go to standard output, complaints to standard error.
Command parse_command_line(int count, char** arguments);

}  // namespace hemoscale::coupling
