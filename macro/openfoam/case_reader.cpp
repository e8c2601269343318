#include "macro/openfoam/case_reader.hpp"

#include <mpi.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <system_error>
#include <vector>

#include "Time.H"
#include "argList.H"
#include "foamVersion.H"
#include "fvMesh.H"
#include "macro/error.hpp"
#include "macro/openfoam/floating_point_traps.hpp"
#include "macro/openfoam/foam_flow_field.hpp"
#include "macro/openfoam/outline_reader.hpp"

namespace hemoscale::macro {
namespace {

namespace fs = std::filesystem;

/// Makes OpenFOAM throw its errors, where it would print them and exit.
class FoamErrorsThrow {
 public:
  FoamErrorsThrow()
      : error_(Foam::FatalError.throwExceptions()),
        io_error_(Foam::FatalIOError.throwExceptions()) {}
  ~FoamErrorsThrow() {
    Foam::FatalError.throwExceptions(error_);
    Foam::FatalIOError.throwExceptions(io_error_);
  }
  FoamErrorsThrow(const FoamErrorsThrow&) = delete;
  FoamErrorsThrow& operator=(const FoamErrorsThrow&) = delete;

 private:
  bool error_;
  bool io_error_;
};

/// Keeps the signal handlers of the host: OpenFOAM's argList installs its own.
class SignalHandlersKept {
 public:
  SignalHandlersKept() {
    for (std::size_t i = 0; i < signals.size(); ++i) ::sigaction(signals[i], nullptr, &saved_[i]);
  }
  ~SignalHandlersKept() {
    for (std::size_t i = 0; i < signals.size(); ++i) ::sigaction(signals[i], &saved_[i], nullptr);
  }
  SignalHandlersKept(const SignalHandlersKept&) = delete;
  SignalHandlersKept& operator=(const SignalHandlersKept&) = delete;

 private:
  static constexpr std::array<int, 5> signals = {SIGFPE, SIGINT, SIGQUIT, SIGSEGV, SIGTERM};
  std::array<struct sigaction, 5> saved_{};
};

/// Silences what OpenFOAM's own reading would print on the host's output.
class FoamIsQuiet {
 public:
  FoamIsQuiet() : level_(Foam::infoDetailLevel) { Foam::infoDetailLevel = 0; }
  ~FoamIsQuiet() { Foam::infoDetailLevel = level_; }
  FoamIsQuiet(const FoamIsQuiet&) = delete;
  FoamIsQuiet& operator=(const FoamIsQuiet&) = delete;

 private:
  int level_;
};

/// Names the case in the environment, as OpenFOAM's programs do: dictionaries refer to $FOAM_CASE.
class CaseNamed {
 public:
  explicit CaseNamed(const fs::path& folder) {
    for (const char* name : names) {
      const char* value = std::getenv(name);
      saved_.push_back(value != nullptr ? std::optional<std::string>(value) : std::nullopt);
    }
    ::setenv(names[0], folder.c_str(), 1);
    ::setenv(names[1], folder.filename().c_str(), 1);
  }
  ~CaseNamed() {
    for (std::size_t i = 0; i < saved_.size(); ++i) {
      if (saved_[i]) {
        ::setenv(names[i], saved_[i]->c_str(), 1);
      } else {
        ::unsetenv(names[i]);
      }
    }
  }
  CaseNamed(const CaseNamed&) = delete;
  CaseNamed& operator=(const CaseNamed&) = delete;

 private:
  static constexpr std::array<const char*, 2> names = {"FOAM_CASE", "FOAM_CASENAME"};
  std::vector<std::optional<std::string>> saved_;
};

/// Fails on all ranks if it fails on one.
void agree(bool is_good, const std::string& message) {
  if (!Foam::returnReduce(is_good, Foam::andOp<bool>())) throw EnvironmentError(message);
}

/// "folder/name" or the same compressed
bool is_there(const fs::path& file) {
  std::error_code ignored;
  return fs::exists(file, ignored) || fs::exists(file.string() + ".gz", ignored);
}

void check_units(const MeshUnits& units) {
  if (units.length > 0 && units.time > 0 && units.density > 0) return;
  throw ParameterError("units of an OpenFOAM case: length " + std::to_string(units.length) +
                       " m, time " + std::to_string(units.time) + " s, density " +
                       std::to_string(units.density) + " kg/m^3; all must be positive");
}

void check_case(const fs::path& folder, bool decomposed) {
  std::error_code ignored;
  const std::string name = folder.string();
  if (!fs::is_directory(folder, ignored)) {
    throw EnvironmentError(name + ": no such folder; name the folder of an OpenFOAM case");
  }
  if (!is_there(folder / "system" / "controlDict")) {
    throw EnvironmentError(name + ": not an OpenFOAM case: it has no system/controlDict");
  }
  const bool has_mesh = is_there(folder / "constant" / "polyMesh" / "faces");
  const bool is_decomposed = fs::is_directory(folder / "processor0", ignored);
  if (!decomposed && !has_mesh && is_decomposed) {
    throw EnvironmentError(name +
                           ": the case is decomposed and has no whole mesh; run "
                           "reconstructParMesh and reconstructPar in it, or start as many ranks "
                           "as it has processor folders");
  }
  if (!decomposed && !has_mesh) {
    throw EnvironmentError(name +
                           ": the case has no mesh (constant/polyMesh); make one, for "
                           "instance with blockMesh");
  }
  if (decomposed && !is_decomposed) {
    throw EnvironmentError(name +
                           ": the case is not decomposed (no folder processor0); run "
                           "decomposePar in it, or start a single process");
  }
  if (!decomposed) return;
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);  // OpenFOAM v1912 always takes all ranks
  const std::string last = "processor" + std::to_string(ranks - 1);
  if (fs::exists(folder / ("processor" + std::to_string(ranks)), ignored) ||
      !is_there(folder / last / "constant" / "polyMesh" / "faces")) {
    throw EnvironmentError(name + ": the case is not decomposed for " + std::to_string(ranks) +
                           " ranks; run decomposePar with this number, or start as many ranks as "
                           "it has processor folders");
  }
}

/// One opened case; members are destroyed in the reverse order.
class OpenedCase : public FlowField<3> {
 public:
  OpenedCase(const fs::path& folder, const CaseReading& reading);

  std::optional<FlowState<3>> at(const Vector<3>& x, double t) const override {
    return field_->at(x, t);
  }
  std::vector<std::optional<FlowState<3>>> sample(const std::vector<Vector<3>>& points,
                                                  double t) const override {
    return field_->sample(points, t);
  }

 private:
  void choose_time(const std::string& folder, const std::string& wanted);
  template <class Field>
  std::unique_ptr<Field> read_field(const std::string& folder, const std::string& name) const;

  std::unique_ptr<Foam::Time> time_;
  std::unique_ptr<Foam::fvMesh> mesh_;
  std::unique_ptr<Foam::volVectorField> velocity_;
  std::unique_ptr<Foam::volScalarField> pressure_;
  std::unique_ptr<FoamFlowField> field_;
};

/// Joins the ranks for OpenFOAM, once per process: argList initialises its parallel side. It is
/// leaked, because its destructor would finalise MPI and exit.
void join_ranks(const fs::path& folder) {
  if (Foam::Pstream::parRun()) return;
  std::vector<std::string> words = {"hemoscale", "-case", folder.string(), "-parallel"};
  auto* kept = new std::vector<std::string>(std::move(words));
  auto* arguments = new std::vector<char*>();
  for (std::string& word : *kept) arguments->push_back(word.data());
  arguments->push_back(nullptr);
  auto* count = new int(static_cast<int>(kept->size()));
  auto* list = new char**(arguments->data());
  Foam::argList::noBanner();
  new Foam::argList(*count, *list, false, false);
}

OpenedCase::OpenedCase(const fs::path& folder, const CaseReading& reading) {
  const std::string name = folder.string();
  const Foam::fileName path(name);
  Foam::fileName part(path.name());
  if (reading.decomposed) {
    join_ranks(folder);
    part = part / ("processor" + Foam::name(Foam::Pstream::myProcNo()));
  }
  time_ = std::make_unique<Foam::Time>(Foam::Time::controlDictName, path.path(), part,
                                       Foam::word("system"), Foam::word("constant"), false);
  choose_time(name, reading.time);
  mesh_ = std::make_unique<Foam::fvMesh>(Foam::IOobject(
      Foam::polyMesh::defaultRegion, time_->timeName(), *time_, Foam::IOobject::MUST_READ));
  velocity_ = read_field<Foam::volVectorField>(name, reading.velocity_field);
  if (!reading.pressure_field.empty()) {
    pressure_ = read_field<Foam::volScalarField>(name, reading.pressure_field);
  }
  field_ = std::make_unique<FoamFlowField>(*velocity_, pressure_.get(), reading.units,
                                           reading.interpolation);
}

void OpenedCase::choose_time(const std::string& folder, const std::string& wanted) {
  const Foam::instantList times = time_->times();
  std::string known;
  Foam::label chosen = -1;
  for (Foam::label i = 0; i < times.size(); ++i) {
    if (times[i].name() == time_->constant()) continue;
    known += (known.empty() ? "" : " ") + std::string(times[i].name());
    Foam::scalar value = 0;
    const bool is_wanted = wanted.empty() || times[i].name() == wanted ||
                           (Foam::readScalar(wanted.c_str(), value) && times[i].equal(value));
    if (is_wanted) chosen = i;
  }
  agree(chosen >= 0, folder + ": " +
                         (wanted.empty() ? "the case has no time folder"
                                         : "the case has no time '" + wanted + "'") +
                         "; it has " + (known.empty() ? "none" : known));
  time_->setTime(times[chosen], chosen);
}

template <class Field>
std::unique_ptr<Field> OpenedCase::read_field(const std::string& folder,
                                              const std::string& name) const {
  Foam::IOobject header(name, time_->timeName(), *mesh_, Foam::IOobject::MUST_READ,
                        Foam::IOobject::NO_WRITE);
  const bool has_header = header.typeHeaderOk<Field>(false);
  agree(has_header, folder + ": no field '" + name + "' at time " + time_->timeName() +
                        "; name the field that the case has, or run its solver first");
  const std::string type = header.headerClassName();
  agree(type == Field::typeName, folder + ": field '" + name + "' at time " + time_->timeName() +
                                     " is a " + type + ", not a " + Field::typeName);
  return std::make_unique<Field>(header, *mesh_);
}

/// Prepares the process for OpenFOAM and does something with a case folder that has been checked.
template <class Action>
auto in_case(const fs::path& folder, const CaseReading& reading, const Action& action) {
  check_units(reading.units);
  std::error_code failure;
  const fs::path whole = fs::absolute(folder, failure).lexically_normal();
  // without a trailing separator, which would leave an empty name
  const fs::path tidy = whole.has_filename() ? whole : whole.parent_path();
  check_case(tidy, reading.decomposed);
  const FloatingPointTrapsOff traps_off;
  const SignalHandlersKept handlers_kept;
  const CaseNamed case_named(tidy);
  const FoamIsQuiet quiet;
  const FoamErrorsThrow errors_throw;
  try {
    return action(tidy);
  } catch (const Foam::error& error) {  // IOerror derives from it
    throw EnvironmentError(tidy.string() +
                           ": OpenFOAM cannot read the case: " + std::string(error.message()));
  }
}

MeshOutline read_outline(const fs::path& folder, const CaseReading& reading) {
  const Foam::fileName path(folder.string());
  Foam::Time time(Foam::Time::controlDictName, path.path(), path.name(), Foam::word("system"),
                  Foam::word("constant"), false);
  const Foam::polyMesh mesh(Foam::IOobject(Foam::polyMesh::defaultRegion, time.timeName(), time,
                                           Foam::IOobject::MUST_READ));
  return wall_polylines(mesh, reading.units);
}

}  // namespace
}  // namespace hemoscale::macro

hemoscale::macro::FlowField<3>* hemoscale_open_case(const std::filesystem::path* folder,
                                                    const hemoscale::macro::CaseReading* reading) {
  using namespace hemoscale::macro;
  return in_case(*folder, *reading, [&](const fs::path& checked) -> FlowField<3>* {
    return new OpenedCase(checked, *reading);
  });
}

hemoscale::macro::MeshOutline* hemoscale_read_outline(
    const std::filesystem::path* folder, const hemoscale::macro::CaseReading* reading) {
  using namespace hemoscale::macro;
  if (reading->decomposed) {
    throw ParameterError(
        "outline of an OpenFOAM mesh: every process reads the whole mesh; run "
        "reconstructParMesh and open the case as one that is not decomposed");
  }
  return in_case(*folder, *reading, [&](const fs::path& checked) {
    return new MeshOutline(read_outline(checked, *reading));
  });
}

int hemoscale_openfoam_compiled_version() {
  return OPENFOAM;
}

int hemoscale_openfoam_running_version() {
  return Foam::foamVersion::api;
}
