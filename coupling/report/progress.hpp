#pragma once

#include <cstddef>
#include <cstdio>
#include <functional>
#include <string>

namespace hemoscale::coupling {

/// How progress is shown.
struct ProgressOptions {
  std::FILE* stream = stderr;       // where to
  bool is_root = true;              // other ranks show nothing
  double line_interval = 10;        // [s] least time between two plain lines
  double refresh_interval = 0.2;    // [s] least time between two updates of a terminal's line
  std::function<double()> clock{};  // [s] monotonic; empty: the system's
  int terminal_columns = -1;        // [-] width; 0: not a terminal; -1: ask the system
};

/// Shows how far a run is and when it will end: one line that is rewritten on a terminal, a plain
/// line now and then elsewhere (log files). The remaining time is extrapolated from the mean speed
/// since the start of this process. A line that cannot be written is not an error of the run.
class Progress {
 public:
  /// @param title  what is counted, e.g. "pass"
  /// @param start  amount done before this process started (restart), in the unit of `total`
  /// @param total  amount at the end; zero or not finite if unknown
  Progress(std::string title, double start, double total, ProgressOptions options = {});
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// @param done  amount done, in the unit of `total`
  /// @param note  one short phrase, e.g. "change 3.1e-3"
  void update(double done, const std::string& note = {});

  /// A line of its own that progress does not overwrite.
  void message(const std::string& text);

  /// The last line; later calls do nothing. Called by the destructor if not before.
  void finish(const std::string& note = {});

 private:
  void show(double done, const std::string& note, bool is_last);

  std::string title_;
  double start_ = 0;
  double total_ = 0;
  ProgressOptions options_;
  int columns_ = 0;             // [-] of the terminal; 0: none
  double start_time_ = 0;       // [s]
  double last_time_ = 0;        // [s] of the last output
  double last_done_ = 0;        // in the unit of total
  std::size_t last_width_ = 0;  // [-] characters on the terminal's line
  bool has_shown_ = false;
  bool is_finished_ = false;
};

/// "1 h 02 min", "3 min 20 s", "12 s", "0.4 s".
std::string format_duration(double seconds);

}  // namespace hemoscale::coupling
