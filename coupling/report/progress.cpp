#include "coupling/report/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace hemoscale::coupling {
namespace {

double system_clock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// Width of the terminal behind a stream; 0 if it is none.
int terminal_columns(std::FILE* stream) {
  constexpr int usual = 80;  // of a terminal that does not tell
  const int descriptor = ::fileno(stream);
  if (descriptor < 0 || ::isatty(descriptor) == 0) return 0;
  winsize size{};
  if (::ioctl(descriptor, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return usual;
  return size.ws_col;
}

}  // namespace

std::string format_duration(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0) return "unknown time";
  if (seconds < 9.95) return fmt::format("{:.1f} s", seconds);
  const double most = 1e15;  // [s] what a whole number of seconds can still hold
  const auto whole = static_cast<std::int64_t>(std::round(std::min(seconds, most)));
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
  const std::int64_t minutes = (whole + 30) / 60;
  constexpr std::int64_t day = 1440;  // [min]
  if (minutes < 2 * day) return fmt::format("{} h {:02} min", minutes / 60, minutes % 60);
  return fmt::format("{} d {:02} h", minutes / day, minutes / 60 % 24);
}

Progress::Progress(std::string title, double start, double total, ProgressOptions options)
    : title_(std::move(title)), start_(start), total_(total), options_(std::move(options)) {
  if (!options_.clock) options_.clock = system_clock;
  columns_ = options_.terminal_columns >= 0 ? options_.terminal_columns
                                            : terminal_columns(options_.stream);
  start_time_ = options_.clock();
  last_done_ = start;
}

Progress::~Progress() {
  try {
    finish();
  } catch (...) {  // NOLINT(bugprone-empty-catch): progress must not end a run
  }
}

void Progress::update(double done, const std::string& note) {
  if (is_finished_ || !options_.is_root) return;
  last_done_ = done;
  const double interval = columns_ > 0 ? options_.refresh_interval : options_.line_interval;
  if (has_shown_ && options_.clock() - last_time_ < interval) return;
  show(done, note, false);
}

void Progress::message(const std::string& text) {
  if (!options_.is_root) return;
  if (last_width_ > 0) fmt::print(options_.stream, "\r{:{}}\r", "", last_width_);
  last_width_ = 0;
  fmt::print(options_.stream, "{}\n", text);
  std::fflush(options_.stream);
}

void Progress::finish(const std::string& note) {
  if (std::exchange(is_finished_, true) || !options_.is_root) return;
  show(last_done_, note, true);
}

void Progress::show(double done, const std::string& note, bool is_last) {
  const double now = options_.clock();
  const double elapsed = now - start_time_;
  const bool is_bounded = std::isfinite(total_) && total_ > 0;
  std::string line = title_;
  if (is_bounded) {
    line += fmt::format(" {:.4g} of {:.4g} ({:.0f} %)", done, total_, 100 * done / total_);
  } else {
    line += fmt::format(" {:.4g}", done);
  }
  if (!note.empty()) line += ", " + note;
  if (is_last) {
    line += fmt::format(", took {}", format_duration(elapsed));
  } else if (is_bounded && done > start_ && elapsed > 0) {
    const double remaining = elapsed * std::max(total_ - done, 0.0) / (done - start_);
    line += fmt::format(", {} left", format_duration(remaining));
  }
  if (columns_ > 0) {
    // The last column stays free: some terminals wrap when it is filled.
    const auto room = static_cast<std::size_t>(std::max(columns_ - 1, 1));
    if (line.size() > room) line.resize(room);
    const std::size_t width = std::max(line.size(), last_width_);
    fmt::print(options_.stream, "\r{:{}}{}", line, width, is_last ? "\n" : "");
    last_width_ = is_last ? 0 : line.size();
  } else {
    fmt::print(options_.stream, "{}\n", line);
  }
  std::fflush(options_.stream);
  last_time_ = now;
  has_shown_ = true;
}

}  // namespace hemoscale::coupling
