#include "coupling/scene/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>

#include "coupling/error.hpp"

extern char** environ;

namespace hemoscale::coupling {

namespace {

bool is_of_mpi(const std::string& entry) {
  for (const char* prefix : {"OMPI_", "PMIX_", "PMI_", "PRTE_", "ORTE_"}) {
    if (entry.rfind(prefix, 0) == 0) return true;
  }
  return false;
}

std::vector<std::string> child_environment(const std::map<std::string, std::string>& added) {
  std::vector<std::string> entries;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const std::string text = *entry;
    // Permission to run as root is the user's choice, not the state of a running MPI.
    if (is_of_mpi(text) && text.rfind("OMPI_ALLOW_RUN_AS_ROOT", 0) != 0) continue;
    if (added.count(text.substr(0, text.find('='))) == 0) entries.push_back(text);
  }
  for (const auto& [name, value] : added) entries.push_back(name + "=" + value);
  return entries;
}

std::vector<char*> pointers(std::vector<std::string>& texts) {
  std::vector<char*> result;
  for (std::string& text : texts) result.push_back(text.data());
  result.push_back(nullptr);
  return result;
}

std::string name(const ChildProcess& child) {
  return child.command.front();
}

}  // namespace

int run_child(const ChildProcess& child, const std::function<void(const std::string&)>& on_line) {
  std::vector<std::string> command = child.command;
  std::vector<std::string> environment = child_environment(child.environment);
  const std::vector<char*> arguments = pointers(command);
  const std::vector<char*> variables = pointers(environment);

  // One pipe carries the output, the other the reason if the program cannot be started.
  int output[2] = {-1, -1};
  int failure[2] = {-1, -1};
  if (pipe2(output, O_CLOEXEC) != 0 || pipe2(failure, O_CLOEXEC) != 0) {
    throw EnvironmentError(fmt::format("{}: no pipe: {}", name(child), std::strerror(errno)));
  }
  const pid_t parent = getpid();
  const pid_t process = fork();
  if (process < 0) {
    throw EnvironmentError(
        fmt::format("{}: cannot be started: {}", name(child), std::strerror(errno)));
  }
  if (process == 0) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() == parent && chdir(child.folder.c_str()) == 0) {
      dup2(output[1], STDOUT_FILENO);
      dup2(output[1], STDERR_FILENO);
      execvpe(arguments[0], arguments.data(), variables.data());
    }
    const int reason = errno;
    if (write(failure[1], &reason, sizeof reason) < 0) _exit(126);
    _exit(127);
  }
  close(output[1]);
  close(failure[1]);

  std::ofstream log(child.log, std::ios::binary);
  std::string line;
  char buffer[4096];
  ssize_t count = 0;
  while ((count = read(output[0], buffer, sizeof buffer)) > 0 || (count < 0 && errno == EINTR)) {
    if (count < 0) continue;
    log.write(buffer, count);
    log.flush();
    for (ssize_t i = 0; i < count; ++i) {
      if (buffer[i] == '\n') {
        on_line(line);
        line.clear();
      } else {
        line += buffer[i];
      }
    }
  }
  if (!line.empty()) on_line(line);
  int reason = 0;
  const bool failed_to_start = read(failure[0], &reason, sizeof reason) == sizeof reason;
  close(output[0]);
  close(failure[0]);
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  if (failed_to_start) {
    throw EnvironmentError(
        fmt::format("{}: cannot be started: {}; `hemoscale doctor` tells what is "
                    "installed here",
                    name(child), std::strerror(reason)));
  }
  if (!log) {
    throw EnvironmentError(
        fmt::format("{}: cannot be written: {}", child.log.string(), std::strerror(errno)));
  }
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

}  // namespace hemoscale::coupling
