#include "coupling/report/timings.hpp"

#include <chrono>
#include <ctime>
#include <utility>

namespace hemoscale::coupling {
namespace {

double wall_clock() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double cpu_clock() {
  std::timespec now{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

const double loaded_at = wall_clock();  // [s]

}  // namespace

PartTiming process_timing() {
  return {wall_clock() - loaded_at, cpu_clock(), 1};
}

Timings::Scope::Scope(Timings& timings, std::string part)
    : timings_(timings),
      part_(std::move(part)),
      wall_start_(wall_clock()),
      cpu_start_(cpu_clock()) {}

Timings::Scope::~Scope() {
  timings_.add(part_, {wall_clock() - wall_start_, cpu_clock() - cpu_start_, 1});
}

void Timings::add(const std::string& part, const PartTiming& timing) {
  PartTiming& sum = parts_[part];
  sum.wall += timing.wall;
  sum.cpu += timing.cpu;
  sum.calls += timing.calls;
}

}  // namespace hemoscale::coupling
