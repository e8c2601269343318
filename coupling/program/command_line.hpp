#pragma once

#include <filesystem>
#include <string>
#include <variant>

namespace hemoscale::coupling {

struct CheckCommand {
  std::filesystem::path case_folder;  // or its case.toml
  std::string variant;                // empty: the case's own
};

struct RunCommand {
  std::filesystem::path case_folder;  // or its case.toml
  std::string variant;                // empty: the case's own
  std::filesystem::path results;      // empty: in the case
  bool restart = false;
  bool force = false;
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

using Command = std::variant<Answered, CheckCommand, RunCommand, ReferenceCommand, DoctorCommand>;

/// What the user asks for. Help and version go to standard output, complaints to standard error.
Command parse_command_line(int count, char** arguments);

}  // namespace hemoscale::coupling
