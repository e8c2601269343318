#include "coupling/scene/child_process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cmath>
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

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// Waits until there is something to read, at most until the child's time is over.
/// @returns whether there is
bool wait_for_output(int descriptor, double remaining) {
  constexpr double longest_wait = 3600;  // [s] poll() counts milliseconds in an int
  const double wait = std::clamp(remaining, 0.0, longest_wait);
  pollfd waiting{descriptor, POLLIN, 0};
  return poll(&waiting, 1, static_cast<int>(std::ceil(1000 * wait))) > 0;
}

}  // namespace

int run_child(const ChildProcess& child, const std::function<void(const std::string&)>& on_line) {
  return run_measured_child(child, on_line).status;
}

ChildEnd run_measured_child(const ChildProcess& child,
                            const std::function<void(const std::string&)>& on_line) {
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
  const Clock::time_point start = Clock::now();
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

  ChildEnd end;
  std::ofstream log(child.log, std::ios::binary);
  std::string line;
  char buffer[4096];
  while (true) {
    const double remaining = child.longest - seconds_since(start);
    if (remaining <= 0) {
      end.timed_out = true;
      kill(process, SIGKILL);
      break;  // children of the child may keep the pipe open
    }
    if (!wait_for_output(output[0], remaining)) continue;
    const ssize_t count = read(output[0], buffer, sizeof buffer);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) break;
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
  rusage used{};
  while (wait4(process, &status, 0, &used) < 0 && errno == EINTR) {
  }
  end.wall = seconds_since(start);
  end.cpu = seconds(used.ru_utime) + seconds(used.ru_stime);
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
  end.status = WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
  return end;
}

}  // namespace hemoscale::coupling
