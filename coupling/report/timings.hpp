#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

namespace hemoscale::coupling {

/// Time spent in one part of a run.
struct PartTiming {
  double wall = 0;         // [s]
  double cpu = 0;          // [s] of the whole process, all threads together
  std::int64_t calls = 0;  // [-]
};

/// The whole process until now; its wall time counts from the loading of this library.
PartTiming process_timing();

/// Named timers. Parts may nest; the time of an inner part is then also in the outer one.
class Timings {
 public:
  /// Measures from its making to its end.
  class Scope {
   public:
    Scope(Timings& timings, std::string part);
    ~Scope();
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Timings& timings_;
    std::string part_;
    double wall_start_;  // [s]
    double cpu_start_;   // [s]
  };

  /// Usage: `const auto scope = timings.measure("micro");`
  [[nodiscard]] Scope measure(std::string part) { return Scope(*this, std::move(part)); }

  /// Adds time measured elsewhere: on another rank, or before a restart.
  void add(const std::string& part, const PartTiming& timing);

  const std::map<std::string, PartTiming>& parts() const { return parts_; }

 private:
  std::map<std::string, PartTiming> parts_;
};

}  // namespace hemoscale::coupling
