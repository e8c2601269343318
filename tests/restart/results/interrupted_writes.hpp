#pragma once

#include <functional>
#include <ostream>

namespace hemoscale::tests {

/// What happens at a chosen call that changes a file.
enum class Interruption {
  kill_before,  // the process is killed (SIGKILL) before the call has any effect
  kill_within,  // ... between two pages of memory, where the system's kernel looks for signals;
                // before the call if its bytes lie in one page
  disk_full     // this and every later call fails with ENOSPC
};

inline void PrintTo(Interruption interruption, std::ostream* stream) {
  switch (interruption) {
    case Interruption::kill_before:
      *stream << "kill before";
      break;
    case Interruption::kill_within:
      *stream << "kill within";
      break;
    case Interruption::disk_full:
      *stream << "disk full";
      break;
  }
}

/// How a process ended in which a file was written.
struct Ending {
  bool was_killed = false;
  int exit_status = 0;       // of the function, if it was not killed
  bool was_reached = false;  // whether the chosen call happened
};

/// Runs `write` in a child process and interrupts the call number `call` (from 0) among those that
/// change a file (write, pwrite, ftruncate, posix_fallocate, fsync, rename), by this process or any
/// library in it.
/// The executable replaces these functions of the C library by its own.
Ending interrupt(Interruption interruption, int call, const std::function<int()>& write);

/// In the child: from here on all calls succeed again, as after someone made room on the disk.
void end_interruption();

}  // namespace hemoscale::tests
