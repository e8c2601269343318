#include "coupling/program/openfoam_probe.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <exception>

#include "macro/openfoam/loader.hpp"

namespace hemoscale::coupling {

namespace {

constexpr unsigned patience = 60;  // [s] a library that takes longer to load hangs

/// Runs in the child: the answer goes to the pipe, as does whatever OpenFOAM prints.
[[noreturn]] void load_and_tell(int pipe) {
  alarm(patience);
  dup2(pipe, STDOUT_FILENO);
  dup2(pipe, STDERR_FILENO);
  std::string answer;
  int exit_code = 0;
  try {
    const macro::OpenFoamLibrary library;
    answer = fmt::format("{}, for OpenFOAM v{}", library.file().string(), library.version());
  } catch (const std::exception& error) {
    answer = error.what();
    exit_code = 1;
  }
  const bool written = write(pipe, answer.data(), answer.size()) >= 0;
  _exit(written ? exit_code : 2);
}

std::string read_all(int pipe) {
  std::string text;
  char buffer[4096];
  for (;;) {
    const ssize_t count = read(pipe, buffer, sizeof buffer);
    if (count > 0) {
      text.append(buffer, static_cast<std::size_t>(count));
    } else if (count == 0 || errno != EINTR) {
      return text;
    }
  }
}

/// Lines and runs of blanks become single blanks.
std::string on_one_line(const std::string& text) {
  std::string line;
  for (const char c : text) {
    const bool blank = c == '\n' || c == '\t' || c == ' ';
    if (!blank) line += c;
    if (blank && !line.empty() && line.back() != ' ') line += ' ';
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line;
}

}  // namespace

OpenFoamProbe probe_openfoam() {
  int pipe[2] = {-1, -1};
  if (pipe2(pipe, O_CLOEXEC) != 0) return {false, std::strerror(errno)};
  const pid_t child = fork();
  if (child < 0) {
    const std::string reason = std::strerror(errno);
    close(pipe[0]);
    close(pipe[1]);
    return {false, reason};
  }
  if (child == 0) load_and_tell(pipe[1]);
  close(pipe[1]);
  const std::string answer = on_one_line(read_all(pipe[0]));
  close(pipe[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0 && !answer.empty()) return {true, answer};
  if (WIFSIGNALED(status)) {
    return {false, fmt::format("loading it ended with signal {} {}", WTERMSIG(status), answer)};
  }
  return {false, answer.empty() ? "loading it ended the process without a word" : answer};
}

}  // namespace hemoscale::coupling
