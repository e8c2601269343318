#include <cstdlib>
#include <string_view>

#include "micro/ensemble/blocks/kernel_versions.hpp"
#include "micro/error.hpp"

namespace hemoscale::micro::blocks {
namespace {

struct Version {
  const char* name;
  bool runs_here;
  const Kernels<float>* single;
  const Kernels<double>* paired;
};

const Version& choose() {
#if defined(HEMOSCALE_X86_VERSIONS)
  __builtin_cpu_init();
  static const Version versions[] = {
      {"v4", __builtin_cpu_supports("x86-64-v4") != 0, &v4::single_kernels, &v4::double_kernels},
      {"v3", __builtin_cpu_supports("x86-64-v3") != 0, &v3::single_kernels, &v3::double_kernels},
      {"plain", true, &plain::single_kernels, &plain::double_kernels}};
#else
  static const Version versions[] = {
      {"plain", true, &plain::single_kernels, &plain::double_kernels}};
#endif
  const char* const wanted = std::getenv("HEMOSCALE_VECTORS");
  for (const Version& version : versions) {
    if (wanted == nullptr ? version.runs_here : std::string_view(wanted) == version.name) {
      if (!version.runs_here) {
        throw EnvironmentError(std::string("HEMOSCALE_VECTORS is ") + wanted +
                               ": this processor lacks the instructions of that version; unset it");
      }
      return version;
    }
  }
  throw EnvironmentError(std::string("HEMOSCALE_VECTORS is ") + wanted +
                         ": this build has no such version of the kernels; choose plain, v3 or v4 "
                         "on x86-64 and plain elsewhere, or unset it");
}

}  // namespace

template <>
const Kernels<float>& kernels<float>() {
  static const Kernels<float>& table = *choose().single;
  return table;
}
template <>
const Kernels<double>& kernels<double>() {
  static const Kernels<double>& table = *choose().paired;
  return table;
}

}  // namespace hemoscale::micro::blocks
