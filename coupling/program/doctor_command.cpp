#include <fmt/format.h>
#include <hdf5.h>
#include <mpi.h>
#include <unistd.h>

#include <Eigen/Core>
#include <cstdlib>
#include <filesystem>
#include <ostream>
#include <sstream>
#include <thread>
#include <vector>

#include "coupling/config/units.hpp"
#include "coupling/error.hpp"
#include "coupling/program/commands.hpp"
#include "coupling/program/openfoam_probe.hpp"
#include "coupling/scene/child_process.hpp"

namespace hemoscale::coupling {

namespace {

namespace fs = std::filesystem;

/// One thing that may be installed.
struct Finding {
  std::string name;
  bool usable = false;
  bool required = false;  // no basic run (analytic macro flow, one process) without it
  std::string detail;     // version or place; why it is not usable
  std::string purpose;
  std::string package;  // of Debian
};

fs::path find_program(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    fs::path file = fs::path(folder) / name;
    std::error_code ignored;
    if (fs::is_regular_file(file, ignored) && access(file.c_str(), X_OK) == 0) return file;
  }
  return {};
}

struct Answer {
  bool succeeded = false;
  std::string first_line;
  std::string last_line;
};

Answer ask(const std::vector<std::string>& command) {
  Answer answer;
  try {
    const int status =
        run_child({command, ".", "/dev/null", {}}, [&answer](const std::string& line) {
          if (answer.first_line.empty()) answer.first_line = line;
          if (!line.empty()) answer.last_line = line;
        });
    answer.succeeded = status == 0;
  } catch (const EnvironmentError& error) {
    answer.last_line = error.what();
  }
  return answer;
}

Finding units() {
  Finding finding{"units", false, true, "", "quantities in case files", "libudunits2-data"};
  try {
    finding.usable = UnitSystem().convert(1, "um", "m") == 1e-6;
    finding.detail = finding.usable ? "UDUNITS-2" : "1 um is not 1e-6 m in this database";
  } catch (const EnvironmentError& error) {
    finding.detail = error.what();
  } catch (const UnitError& error) {
    finding.detail = "the database of units knows no micrometre";
  }
  return finding;
}

Finding hdf5() {
  unsigned major = 0;
  unsigned minor = 0;
  unsigned release = 0;
  const bool usable = H5get_libversion(&major, &minor, &release) >= 0;
#ifdef H5_HAVE_PARALLEL
  const char* flavour = ", parallel";
#else
  const char* flavour = ", serial";
#endif
  return {"HDF5",
          usable,
          true,
          fmt::format("{}.{}.{}{}", major, minor, release, flavour),
          "trajectories and checkpoints",
          "libhdf5-openmpi-103-1"};
}

Finding mpi_library() {
  char text[MPI_MAX_LIBRARY_VERSION_STRING] = {};
  int length = 0;
  MPI_Get_library_version(text, &length);
  const std::string version(text);
  return {"MPI",
          true,
          true,
          version.substr(0, version.find_first_of(",\n")),
          "several processes",
          "libopenmpi3"};
}

Finding program(const std::string& name, const std::string& purpose, const std::string& package) {
  const fs::path file = find_program(name);
  return {name,    !file.empty(), false, file.empty() ? "not on PATH" : file.string(),
          purpose, package};
}

Finding mpirun() {
  Finding finding = program("mpirun", "runs on several processes", "openmpi-bin");
  if (!finding.usable) return finding;
  const Answer answer = ask({finding.detail, "--version"});
  finding.usable = answer.succeeded;
  finding.detail += ": " + (answer.succeeded ? answer.first_line : answer.last_line);
  return finding;
}

/// Debian's Python, for which the packages named here are; another one only in its absence.
std::string python() {
  const fs::path debian = "/usr/bin/python3";
  std::error_code ignored;
  return fs::exists(debian, ignored) ? debian.string() : find_program("python3").string();
}

Finding python_module(const std::string& name, const std::string& purpose,
                      const std::string& package) {
  Finding finding{"python3 " + name, false, false, "there is no python3", purpose, package};
  const std::string interpreter = python();
  if (interpreter.empty()) return finding;
  const Answer answer =
      ask({interpreter, "-c", "import " + name + "; print(" + name + ".__version__)"});
  finding.usable = answer.succeeded;
  finding.detail = answer.last_line;
  return finding;
}

Finding openfoam_library() {
  const OpenFoamProbe probe = probe_openfoam();
  return {"OpenFOAM library",
          probe.usable,
          false,
          probe.detail,
          "macro flows of OpenFOAM, and the plug-in inside its solvers",
          "openfoam; then build HemoScale again"};
}

std::vector<Finding> examine() {
  return {units(),
          hdf5(),
          mpi_library(),
          mpirun(),
          openfoam_library(),
          program("blockMesh", "meshes of OpenFOAM cases", "openfoam"),
          program("simpleFoam", "steady macro flows", "openfoam"),
          program("nonNewtonianIcoFoam", "transient macro flows", "openfoam"),
          python_module("numpy", "plots of the cases", "python3-numpy"),
          python_module("matplotlib", "plots of the cases", "python3-matplotlib"),
          python_module("h5py", "plots of trajectories", "python3-h5py-mpi")};
}

std::string threads() {
  const char* wanted = std::getenv("OMP_NUM_THREADS");
  return fmt::format("{} (OMP_NUM_THREADS {})", std::thread::hardware_concurrency(),
                     wanted == nullptr ? "not set" : wanted);
}

}  // namespace

bool examine_machine(std::ostream& out) {
  out << "HemoScale " << HEMOSCALE_VERSION << ", compiler " << HEMOSCALE_COMPILER << ", Eigen "
      << EIGEN_WORLD_VERSION << '.' << EIGEN_MAJOR_VERSION << '.' << EIGEN_MINOR_VERSION
      << "\nthreads of this machine: " << threads() << "\n\n";
  bool all_required = true;
  int missing = 0;
  for (const Finding& finding : examine()) {
    out << fmt::format("{:<8} {:<20} {}\n", finding.usable ? "ok" : "missing", finding.name,
                       finding.detail);
    if (finding.usable) continue;
    ++missing;
    all_required = all_required && !finding.required;
    out << fmt::format("{:29} {}for {}; Debian package {}\n", "",
                       finding.required ? "required " : "", finding.purpose, finding.package);
  }
  out << "\n"
      << (missing == 0   ? "everything is there\n"
          : all_required ? "basic runs work; what is missing limits the rest\n"
                         : "no run is possible before what is required is there\n");
  return all_required;
}

}  // namespace hemoscale::coupling
