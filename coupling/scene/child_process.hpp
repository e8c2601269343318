#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

namespace hemoscale::coupling {

/// A program to be run to its end.
struct ChildProcess {
  std::vector<std::string> command;                          // program and arguments; no shell
  std::filesystem::path folder;                              // working directory
  std::filesystem::path log;                                 // stdout and stderr go there
  std::map<std::string, std::string> environment;            // added to that of this process
  double longest = std::numeric_limits<double>::infinity();  // [s] wall; it is then ended
};

/// How a program ended and what it took.
struct ChildEnd {
  int status = 0;          // exit status; 128 + signal if a signal ended it
  bool timed_out = false;  // ended because it took longer than it may
  double wall = 0;         // [s]
  double cpu = 0;          // [s] user and system, with the children that it waited for
};

/// Runs a program to its end. What MPI put into the environment of this process is withheld, so
/// that the child may start MPI of its own. If this process is ended by a signal, so is the child.
///
/// @param on_line  called with each line that the child has written, while it runs
/// @throws EnvironmentError if it cannot be started
ChildEnd run_measured_child(const ChildProcess& child,
                            const std::function<void(const std::string&)>& on_line);

/// The same; its exit status alone.
int run_child(const ChildProcess& child, const std::function<void(const std::string&)>& on_line);

}  // namespace hemoscale::coupling
