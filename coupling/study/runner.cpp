#include "coupling/study/runner.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <exception>
#include <thread>
#include <utility>
#include <vector>

#include "coupling/config/overrides.hpp"
#include "coupling/error.hpp"
#include "coupling/scene/child_process.hpp"
#include "coupling/study/this_build.hpp"

namespace hemoscale::coupling {

namespace {

namespace fs = std::filesystem;

constexpr int exit_numerics = 4;  // of `hemoscale run`: the numerics failed

/// The digits of an identity that end the name of a folder.
std::string short_identity(const std::string& identity) {
  return identity.substr(0, 8);
}

/// What a label looks like as the name of a folder.
std::string as_name(const std::string& label) {
  constexpr std::size_t longest = 60;  // [-] bytes
  std::string name;
  for (const char c : label) {
    const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '.' || c == '_';
    if (plain) {
      name += c;
    } else if (!name.empty() && name.back() != '-') {
      name += '-';
    }
  }
  return name.substr(0, longest);
}

/// "hemoscale: the numerics failed" is followed by what happened.
std::string reason_in(const std::vector<std::string>& lines) {
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    if (lines[i].rfind("hemoscale: ", 0) != 0) continue;
    const std::size_t begin = lines[i + 1].find_first_not_of(' ');
    return begin == std::string::npos ? "" : lines[i + 1].substr(begin);
  }
  return lines.empty() ? "" : lines.back();
}

int take(const fs::path& results) {
  std::error_code error;
  fs::create_directories(results / "runs", error);
  const fs::path file = results / "lock";
  const int lock = error ? -1 : open(file.c_str(), O_CREAT | O_RDWR | O_CLOEXEC, 0666);
  if (lock < 0) {
    throw EnvironmentError(fmt::format("{}: cannot be used for results: {}", results.string(),
                                       error ? error.message() : std::strerror(errno)));
  }
  if (flock(lock, LOCK_EX | LOCK_NB) != 0) {
    close(lock);
    throw EnvironmentError(results.string() +
                           ": another `hemoscale chart` is at work on this study; wait for it");
  }
  return lock;
}

}  // namespace

fs::path results_of(const Study& study) {
  return study.folder / "results" / study.name;
}

Runner::Runner(const Study& study, RunnerOptions options)
    : study_(study),
      options_(std::move(options)),
      results_(results_of(study)),
      lock_(take(results_)) {
  for (const auto& entry : fs::directory_iterator(results_ / "runs")) {
    const std::string name = entry.path().filename().string();
    folders_[name.substr(name.rfind('-') + 1)] = entry.path();
  }
}

Runner::~Runner() {
  close(lock_);
}

fs::path Runner::folder_of(const PlannedRun& run) {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::string end = short_identity(run.identity);
  const auto [entry, is_new] =
      folders_.try_emplace(end, results_ / "runs" / (as_name(run.label) + "-" + end));
  return entry->second;
}

std::optional<RunRecord> Runner::finished(const PlannedRun& run) {
  using Status = RunRecord::Status;
  const fs::path folder = folder_of(run);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (options_.fresh && made_.count(run.identity) == 0) return std::nullopt;
  }
  std::optional<RunRecord> record = read_record(folder / "record.json");
  if (!record || record->identity != run.identity) return std::nullopt;
  switch (record->status) {
    case Status::failed:
      break;
    case Status::timed_out:
      if (record->longest < study_.longest) return std::nullopt;
      break;
    case Status::finished:
      if (record->repeats < study_.repeats) return std::nullopt;
      if (!fs::exists(folder / "results" / "summary.json")) return std::nullopt;
      break;
  }
  return record;
}

RunRecord Runner::run(const PlannedRun& run) {
  {
    std::unique_lock<std::mutex> lock(mutex_);
    freed_.wait(lock, [&] { return busy_.count(run.identity) == 0; });
    busy_.insert(run.identity);
  }
  struct Release {
    Runner& runner;
    const std::string& identity;
    ~Release() {
      const std::lock_guard<std::mutex> lock(runner.mutex_);
      runner.busy_.erase(identity);
      runner.freed_.notify_all();
    }
  } const release{*this, run.identity};
  const std::optional<RunRecord> earlier = finished(run);
  const RunRecord record = earlier ? *earlier : make(run, folder_of(run));
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!earlier) made_.insert(run.identity);
  of_other_build_ += record.build != this_build() ? 1 : 0;
  beside_others_ += record.jobs > 1 ? 1 : 0;
  return record;
}

RunRecord Runner::make(const PlannedRun& run, const fs::path& folder) const {
  std::error_code error;
  fs::remove_all(folder, error);
  if (!error) fs::create_directories(folder, error);
  if (error) {
    throw EnvironmentError(folder.string() + ": cannot be made anew: " + error.message());
  }
  RunRecord record;
  record.identity = run.identity;
  record.jobs = options_.jobs;
  record.longest = study_.longest;
  record.build = this_build();
  record.repeats = 0;
  while (record.repeats < study_.repeats) {
    const fs::path results = folder / (record.repeats == 0 ? "results" : "repeat");
    ChildProcess child{{options_.program.string(), "run", fs::absolute(run.case_folder).string()},
                       ".",
                       folder / "log",
                       {{"OMP_NUM_THREADS", fmt::format("{}", study_.threads)}},
                       study_.longest};
    const auto add = [&child](std::initializer_list<std::string> words) {
      child.command.insert(child.command.end(), words);
    };
    add({"--results", fs::absolute(results).string()});
    if (!run.variant.empty()) add({"--variant", run.variant});
    if (run.force) add({"--force"});
    for (const Override& setting : run.overrides) add({"--set", override_text(setting)});

    std::vector<std::string> lines;
    const ChildEnd end = run_measured_child(child, [&lines](const std::string& line) {
      constexpr std::size_t kept = 40;
      lines.push_back(line);
      if (lines.size() > kept) lines.erase(lines.begin());
    });
    ++record.repeats;
    record.cpu = record.repeats == 1 ? end.cpu : std::min(record.cpu, end.cpu);
    record.wall = record.repeats == 1 ? end.wall : std::min(record.wall, end.wall);
    if (record.repeats > 1) fs::remove_all(results, error);
    if (end.timed_out) {
      record.status = RunRecord::Status::timed_out;
      record.message =
          fmt::format("longer than the {:g} s that study.timeout allows", study_.longest);
      break;
    }
    if (end.status == exit_numerics) {
      record.status = RunRecord::Status::failed;
      record.message = reason_in(lines);
      break;
    }
    if (end.status != 0) {
      throw EnvironmentError(fmt::format(
          "the run \"{}\" ended with exit code {}: {}\nits output is in {}; correct the cause and "
          "start the study again: finished runs are kept",
          run.label, end.status, reason_in(lines), child.log.string()));
    }
  }
  if (record.status == RunRecord::Status::finished) {
    const Summary summary = read_summary(folder / "results" / "summary.json");
    if (summary.outcome != "finished") record.message = summary.outcome;
  }
  write_record(folder / "record.json", record);
  return record;
}

Summary Runner::summary_of(const PlannedRun& run) {
  return read_summary(folder_of(run) / "results" / "summary.json");
}

std::string Runner::notes(bool times_matter) const {
  std::string text;
  if (of_other_build_ > 0) {
    text += fmt::format(
        "note: {} runs were made by another build of this version; --fresh makes them again\n",
        of_other_build_);
  }
  if (times_matter && beside_others_ > 0) {
    text += fmt::format(
        "note: {} runs were made beside others (--jobs), so that their CPU times are too large; "
        "--fresh makes them again\n",
        beside_others_);
  }
  return text;
}

void for_each_at_once(std::size_t count, int jobs, const std::function<void(std::size_t)>& action) {
  std::atomic<std::size_t> next{0};
  std::mutex mutex;
  std::exception_ptr failure;
  const auto work = [&] {
    for (std::size_t i = next++; i < count; i = next++) {
      try {
        action(i);
      } catch (...) {
        const std::lock_guard<std::mutex> lock(mutex);
        if (!failure) failure = std::current_exception();
        next = count;
      }
    }
  };
  std::vector<std::thread> threads;
  for (std::size_t i = 1; i < std::min(count, static_cast<std::size_t>(jobs)); ++i) {
    threads.emplace_back(work);
  }
  work();
  for (std::thread& thread : threads) thread.join();
  if (failure) std::rethrow_exception(failure);
}

}  // namespace hemoscale::coupling
