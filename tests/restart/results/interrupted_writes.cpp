#include "tests/restart/results/interrupted_writes.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstddef>
#include <cstdlib>

namespace {

// Armed in the child alone.
struct Plan {
  bool is_armed = false;
  hemoscale::tests::Interruption interruption{};
  int calls_left = 0;
  bool* was_reached = nullptr;  // shared with the parent
} plan;                         // NOLINT(readability-identifier-naming)

/// How many of `count` bytes at `offset` the call may write; fewer than none: it fails.
ssize_t allowed(std::size_t count, off_t offset) {
  using hemoscale::tests::Interruption;
  constexpr off_t page = 4096;
  const auto all = static_cast<ssize_t>(count);
  if (!plan.is_armed || plan.calls_left-- > 0) return all;
  *plan.was_reached = true;
  switch (plan.interruption) {
    case Interruption::kill_before:
      ::raise(SIGKILL);
      break;
    case Interruption::kill_within: {
      const off_t middle = offset + static_cast<off_t>(count) / 2;
      return std::max<off_t>((middle + page - 1) / page * page - offset, 0);
    }
    case Interruption::disk_full:
      return -1;
  }
  return all;
}

ssize_t write_some(int descriptor, const void* bytes, std::size_t count, const off_t* offset) {
  const off_t start = offset != nullptr ? *offset : ::lseek(descriptor, 0, SEEK_CUR);
  const ssize_t granted = allowed(count, start);
  if (granted < 0) {
    errno = ENOSPC;
    return -1;
  }
  const auto size = std::min(static_cast<std::size_t>(granted), count);
  const bool is_cut = plan.is_armed && plan.calls_left < 0 &&
                      plan.interruption == hemoscale::tests::Interruption::kill_within;
  if (is_cut && size == count) ::raise(SIGKILL);  // no page boundary in the second half
  const long written = offset == nullptr
                           ? ::syscall(SYS_write, descriptor, bytes, size)
                           : ::syscall(SYS_pwrite64, descriptor, bytes, size, *offset);
  if (is_cut) ::raise(SIGKILL);
  return written;
}

bool is_full() {
  return plan.is_armed && plan.interruption == hemoscale::tests::Interruption::disk_full;
}

/// A call that happens wholly or not at all: kills, or tells whether it fails.
bool interrupt_whole() {
  if (!plan.is_armed || plan.calls_left-- > 0) return false;
  *plan.was_reached = true;
  if (!is_full()) ::raise(SIGKILL);
  return true;
}

}  // namespace

extern "C" {

ssize_t write(int descriptor, const void* bytes, size_t count) {
  return write_some(descriptor, bytes, count, nullptr);
}

ssize_t pwrite(int descriptor, const void* bytes, size_t count, off_t offset) {
  return write_some(descriptor, bytes, count, &offset);
}

ssize_t pwrite64(int descriptor, const void* bytes, size_t count, off64_t offset) {
  return write_some(descriptor, bytes, count, &offset);
}

int ftruncate(int descriptor, off_t length) noexcept {
  if (!is_full()) interrupt_whole();  // a disk that is full can still shorten a file
  return static_cast<int>(::syscall(SYS_ftruncate, descriptor, length));
}

int ftruncate64(int descriptor, off64_t length) noexcept {
  return ftruncate(descriptor, length);
}

int posix_fallocate(int descriptor, off_t offset, off_t length) {
  if (interrupt_whole()) return ENOSPC;
  return ::syscall(SYS_fallocate, descriptor, 0, offset, length) == 0 ? 0 : errno;
}

int fsync(int descriptor) {
  if (interrupt_whole()) {
    errno = ENOSPC;  // of file systems that find their places late
    return -1;
  }
  return static_cast<int>(::syscall(SYS_fsync, descriptor));
}

int rename(const char* from, const char* to) noexcept {
  if (!is_full()) interrupt_whole();
  return static_cast<int>(::syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0));
}

}  // extern "C"

namespace hemoscale::tests {

void end_interruption() {
  plan.is_armed = false;
}

Ending interrupt(Interruption interruption, int call, const std::function<int()>& write) {
  void* const shared =
      ::mmap(nullptr, sizeof(bool), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  auto* const was_reached = static_cast<bool*>(shared);
  *was_reached = false;
  const pid_t child = ::fork();
  if (child == 0) {
    plan = {true, interruption, call, was_reached};
    const int status = write();
    // With what libraries do at the end of a process; the disk stays full for them.
    std::exit(status);  // NOLINT(concurrency-mt-unsafe)
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  const Ending ending{WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL,
                      WIFEXITED(status) ? WEXITSTATUS(status) : -1, *was_reached};
  ::munmap(shared, sizeof(bool));
  return ending;
}

}  // namespace hemoscale::tests
