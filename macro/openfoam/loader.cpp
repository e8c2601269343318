#include "macro/openfoam/loader.hpp"

#include <dlfcn.h>
#include <unistd.h>

#include <array>
#include <climits>
#include <cstdlib>
#include <string>
#include <system_error>
#include <vector>

#include "macro/error.hpp"

namespace hemoscale::macro {
namespace {

namespace fs = std::filesystem;

constexpr const char* library_name = "libhemoscale_openfoam.so";

bool is_file(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

fs::path folder_of_this_code() {
  Dl_info info;
  const auto address = reinterpret_cast<const void*>(&folder_of_this_code);
  if (dladdr(address, &info) == 0 || info.dli_fname == nullptr) return {};
  std::error_code ignored;
  return fs::absolute(info.dli_fname, ignored).parent_path();
}

fs::path folder_of_program() {
  std::array<char, PATH_MAX> path{};
  const ssize_t length = ::readlink("/proc/self/exe", path.data(), path.size() - 1);
  if (length <= 0) return {};
  return fs::path(std::string(path.data(), static_cast<std::size_t>(length))).parent_path();
}

fs::path find_library(const fs::path& wanted) {
  if (!wanted.empty()) {
    if (is_file(wanted)) return wanted;
    throw EnvironmentError(wanted.string() +
                           ": no such file; name the OpenFOAM library of HemoScale (" +
                           library_name + ")");
  }
  std::vector<fs::path> candidates;
  if (const char* named = std::getenv("HEMOSCALE_OPENFOAM_LIBRARY"); named && *named != '\0') {
    if (is_file(named)) return named;
    throw EnvironmentError(std::string(named) +
                           ": no such file, named by HEMOSCALE_OPENFOAM_LIBRARY; correct or unset "
                           "that variable");
  }
  const fs::path here = folder_of_this_code();
  const fs::path program = folder_of_program();
  candidates = {here / library_name, here / ".." / HEMOSCALE_LIBRARY_FOLDER / library_name,
                program / ".." / HEMOSCALE_LIBRARY_FOLDER / library_name};
  std::string tried;
  for (const fs::path& candidate : candidates) {
    if (is_file(candidate)) return candidate.lexically_normal();
    tried += (tried.empty() ? "" : ", ") + candidate.lexically_normal().string();
  }
  throw EnvironmentError(
      "the OpenFOAM library of HemoScale is not there (tried " + tried +
      "); it is built when OpenFOAM and its headers are found: run "
      "cases/support/openfoam-headers.sh and configure again, or use the analytic macro flow");
}

void provide_project_folder() {
  const char* given = std::getenv("WM_PROJECT_DIR");
  if (given != nullptr && *given != '\0') {
    if (is_file(fs::path(given) / "etc" / "controlDict")) return;
    throw EnvironmentError("WM_PROJECT_DIR is " + std::string(given) +
                           ", which has no etc/controlDict; source the OpenFOAM installation again "
                           "or unset that variable");
  }
  for (const char* folder : {HEMOSCALE_OPENFOAM_PROJECT_DIR, "/usr/share/openfoam"}) {
    if (*folder != '\0' && is_file(fs::path(folder) / "etc" / "controlDict")) {
      ::setenv("WM_PROJECT_DIR", folder, 1);
      return;
    }
  }
  throw EnvironmentError(
      "OpenFOAM is not installed (no etc/controlDict in " HEMOSCALE_OPENFOAM_PROJECT_DIR
      " or /usr/share/openfoam); install it (Debian: apt-get install --no-install-recommends "
      "openfoam) or source its etc/bashrc");
}

template <class Function>
Function symbol(void* library, const char* name, const fs::path& file) {
  void* address = ::dlsym(library, name);
  if (address == nullptr) {
    throw EnvironmentError(file.string() +
                           ": not the OpenFOAM library of this version of HemoScale "
                           "(no function " +
                           name + "); build and install it again");
  }
  return reinterpret_cast<Function>(address);
}

}  // namespace

OpenFoamLibrary::OpenFoamLibrary(const fs::path& file) : file_(find_library(file)) {
  provide_project_folder();
  void* library = ::dlopen(file_.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) {
    const char* reason = ::dlerror();
    throw EnvironmentError(file_.string() + ": the OpenFOAM library cannot be loaded: " +
                           (reason != nullptr ? reason : "unknown reason") +
                           "; is OpenFOAM installed, in the version HemoScale was built for?");
  }
  const int compiled = symbol<decltype(&hemoscale_openfoam_compiled_version)>(
      library, "hemoscale_openfoam_compiled_version", file_)();
  version_ = symbol<decltype(&hemoscale_openfoam_running_version)>(
      library, "hemoscale_openfoam_running_version", file_)();
  if (compiled != version_) {
    throw EnvironmentError(file_.string() + ": compiled for OpenFOAM v" + std::to_string(compiled) +
                           ", but v" + std::to_string(version_) +
                           " is installed; build HemoScale again");
  }
  open_case_ = symbol<decltype(open_case_)>(library, "hemoscale_open_case", file_);
  read_outline_ = symbol<decltype(read_outline_)>(library, "hemoscale_read_outline", file_);
}

std::unique_ptr<FlowField<3>> OpenFoamLibrary::open_case(const fs::path& folder,
                                                         const CaseReading& reading) const {
  return std::unique_ptr<FlowField<3>>(open_case_(&folder, &reading));
}

MeshOutline OpenFoamLibrary::read_outline(const std::filesystem::path& folder,
                                          const CaseReading& reading) const {
  const std::unique_ptr<MeshOutline> outline(read_outline_(&folder, &reading));
  return *outline;
}

}  // namespace hemoscale::macro
