#include <sched.h>
#include <unistd.h>

#include <array>
#include <fstream>
#include <string>

#include "coupling/report/summary.hpp"

namespace hemoscale::coupling {
namespace {

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const std::size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != std::string::npos) return line.substr(colon + 2);
  }
  return {};
}

}  // namespace

std::string program_version() {
  return HEMOSCALE_VERSION;
}

Host this_host(int threads, int ranks) {
  Host host;
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) == 0) host.name = name.data();
  host.processor = processor_name();
  cpu_set_t allowed;
  if (::sched_getaffinity(0, sizeof allowed, &allowed) == 0) host.processors = CPU_COUNT(&allowed);
  host.threads = threads;
  host.ranks = ranks;
  return host;
}

}  // namespace hemoscale::coupling
