#include "coupling/plugin/function_object.hpp"

#include <chrono>
#include <exception>
#include <iostream>
#include <sstream>

#include "addToRunTimeSelectionTable.H"
#include "fvMesh.H"
#include "macro/error.hpp"
#include "macro/openfoam/floating_point_traps.hpp"
#include "singlePhaseTransportModel.H"

namespace Foam {
namespace functionObjects {

defineTypeNameAndDebug(hemoscaleCoupling, 0);
addToRunTimeSelectionTable(functionObject, hemoscaleCoupling, dictionary);

namespace {

namespace hs = hemoscale;

/// Runs code of this project, with floating-point traps off. @returns what it threw, or ""
std::string failure_of(const std::function<void()>& code) {
  const hs::macro::FloatingPointTrapsOff traps_off;
  try {
    code();
  } catch (const IOerror&) {
    throw;  // an entry of a dictionary, with its file and line: OpenFOAM ends the run with it
  } catch (const error& error) {
    return error.message();
  } catch (const std::exception& error) {
    return error.what()[0] != '\0' ? error.what() : "unknown failure";
  }
  return {};
}

/// The ranks of this solver: the only place of the plug-in that names the world communicator.
hs::micro::Communicator ranks() {
  return Pstream::parRun() ? hs::micro::Communicator(MPI_COMM_WORLD) : hs::micro::Communicator();
}

hs::macro::Interpolation interpolation_named(const std::string& name) {
  if (name == "cell-point") return hs::macro::Interpolation::cell_point;
  if (name == "cell-point-face") return hs::macro::Interpolation::cell_point_face;
  return hs::macro::Interpolation::taylor;
}

hs::macro::MeshUnits units_of(const hs::coupling::Settings& settings) {
  hs::macro::MeshUnits units;
  units.length = settings.quantity("macro.openfoam.length_unit");
  units.time = settings.quantity("macro.openfoam.time_unit");
  units.density = settings.quantity("fluid.density");
  return units;
}

singlePhaseTransportModel* transport_of(const fvMesh& mesh) {
  return mesh.getObjectPtr<singlePhaseTransportModel>("transportProperties");
}

bool differ(double a, double b) {
  return mag(a - b) > 1e-9 * max(mag(a), mag(b));
}

}  // namespace

hemoscaleCoupling::hemoscaleCoupling(const word& name, const Time& runTime, const dictionary& dict)
    : fvMeshFunctionObject(name, runTime, dict) {
  const std::string failure = failure_of([&] { begin(dict); });
  if (failure.empty()) return;
  // OpenFOAM prints the message of the master alone
  if (!Pstream::master()) std::cerr << "[" << Pstream::myProcNo() << "] " << failure << std::endl;
  FatalIOErrorInFunction(dict) << "hemoscale: " << failure.c_str() << exit(FatalIOError);
}

hemoscaleCoupling::~hemoscaleCoupling() = default;

void hemoscaleCoupling::begin(const dictionary& dict) {
  given_ = hs::coupling::read_plugin_settings(dict, time_.globalPath());
  const hs::coupling::Settings& settings = given_.settings;
  const std::string scheme = settings.text("coupling.scheme");
  if (scheme == "implicit") {
    throw hs::macro::ParameterError(
        "coupling.scheme is implicit; inside a solver of OpenFOAM a window cannot be repeated, "
        "because the solver keeps no state to return to: use explicit, with a relaxation factor, "
        "or run the case with the program");
  }
  is_one_way_ = scheme == "one-way";
  velocity_name_ = word(settings.text("macro.openfoam.velocity_field"));
  steps_in_window_ = static_cast<label>(settings.integer("coupling.interval"));
  first_step_ = time_.timeIndex();
  window_begin_ = time_.value();
  is_steady_ = word(mesh_.ddtScheme("default")) == "steadyState";

  if (!mesh_.foundObject<volVectorField>(velocity_name_)) {
    throw hs::macro::EnvironmentError("the solver has no velocity field '" + velocity_name_ +
                                      "'; correct macro.openfoam.velocity_field");
  }
  check_viscosity_model();
  usual_speed_ = highest_speed();
  locator_ = std::make_shared<hs::macro::PointLocator>(mesh_);
  session_ = std::make_unique<hs::coupling::CoupledSession>(settings, std::string(given_.results),
                                                            given_.restart, ranks());
  check_points_inside();
  deliver_law();
  Info << "hemoscale: " << scheme.c_str() << " coupling every " << steps_in_window_ << " steps, "
       << label(session_->points().size()) << " sample points, results in " << given_.results << nl
       << endl;
}

void hemoscaleCoupling::check_viscosity_model() {
  law_in_use_ = hemoscaleLawInUse::find(mesh_);
  if (is_one_way_ && law_in_use_ == nullptr) return;
  const singlePhaseTransportModel* transport = transport_of(mesh_);
  if (transport == nullptr) {
    throw hs::macro::EnvironmentError(
        "no feedback possible: solver " +
        time_.controlDict().lookupOrDefault<word>("application", "of this case") +
        " has no transport model that it asks for the viscosity (icoFoam reads a "
        "constant nu once); use simpleFoam, pisoFoam, pimpleFoam or nonNewtonianIcoFoam, or set "
        "coupling.scheme to one-way");
  }
  if (law_in_use_ == nullptr) {
    throw hs::macro::EnvironmentError(
        "no feedback possible: transportModel in constant/transportProperties is not hemoscale; "
        "set 'transportModel hemoscale;' and hemoscaleCoeffs, or set coupling.scheme to one-way");
  }
  if (&transport->nu()() != law_in_use_->nu()) {
    throw hs::macro::EnvironmentError(
        "no feedback possible: the viscosity that the solver uses is not that of the viscosity "
        "model hemoscale; use one transport model only");
  }
  check_units();
}

void hemoscaleCoupling::check_units() const {
  const hs::macro::MeshUnits& model = law_in_use_->units();
  const hs::macro::MeshUnits wanted = units_of(given_.settings);
  std::ostringstream message;
  const auto compare = [&message](const char* key, double in_model, double in_case) {
    if (!differ(in_model, in_case)) return;
    message << key << " is " << in_model << " in hemoscaleCoeffs of constant/transportProperties, "
            << in_case << " in the case; ";
  };
  compare("macro.openfoam.length_unit", model.length, wanted.length);
  compare("macro.openfoam.time_unit", model.time, wanted.time);
  compare("fluid.density", model.density, wanted.density);
  if (!message.str().empty()) {
    throw hs::macro::ParameterError(message.str() + "both must be the same (SI)");
  }
}

void hemoscaleCoupling::check_points_inside() const {
  const double length = units_of(given_.settings).length;
  const hs::coupling::Settings::Points& points = session_->points();
  pointField in_mesh(static_cast<label>(points.size()));
  forAll(in_mesh, i) {
    const Eigen::Vector3d& x = points[static_cast<std::size_t>(i)];
    in_mesh[i] = point(x(0), x(1), x(2)) / length;
  }
  const labelList owners = locator_->locate(in_mesh).owners;
  std::ostringstream outside;
  forAll(in_mesh, i) {
    if (owners[i] >= 0) continue;
    outside << (outside.str().empty() ? "" : ", ") << "("
            << points[static_cast<std::size_t>(i)].transpose() << ")";
  }
  if (outside.str().empty()) return;
  const boundBox& box = mesh_.bounds();
  const vector low = box.min() * length;
  const vector high = box.max() * length;
  std::ostringstream message;
  message << "sampling.points: outside the mesh: " << outside.str() << " m; the mesh lies within ("
          << low.x() << " " << low.y() << " " << low.z() << ") and (" << high.x() << " " << high.y()
          << " " << high.z() << ") m with macro.openfoam.length_unit " << length
          << " m; correct the points or that unit";
  throw hs::macro::ParameterError(message.str());
}

hs::macro::FoamFlowField hemoscaleCoupling::flow() const {
  return {lookupObject<volVectorField>(velocity_name_), findObject<volScalarField>("p"),
          units_of(given_.settings),
          interpolation_named(given_.settings.text("macro.openfoam.interpolation")), locator_};
}

void hemoscaleCoupling::deliver_law() {
  if (is_one_way_ && law_in_use_ == nullptr) return;
  law_in_use_->assign(session_->law(), session_->hematocrit());
  // Most solvers compute the viscosity at the end of a step: without this call the next step would
  // still run with the old law.
  transport_of(mesh_)->correct();
  ++own_corrections_;
}

bool hemoscaleCoupling::read(const dictionary& dict) {
  fvMeshFunctionObject::read(dict);
  if (session_) {
    WarningInFunction
        << "hemoscale: its dictionary changed while the solver runs; the change takes "
        << "effect when the solver is started again" << endl;
  }
  return true;
}

bool hemoscaleCoupling::window_is_complete() const {
  return (time_.timeIndex() - first_step_) % steps_in_window_ == 0;
}

void hemoscaleCoupling::check_feedback() const {
  if (is_one_way_) return;
  if (law_in_use_->corrections() > own_corrections_ + 1) return;  // 1: in the model's constructor
  throw hs::macro::EnvironmentError(
      "no feedback possible: the solver made " + std::to_string(steps_in_window_) +
      " steps without asking its viscosity model; use simpleFoam, pisoFoam, pimpleFoam or "
      "nonNewtonianIcoFoam, or set coupling.scheme to one-way");
}

scalar hemoscaleCoupling::highest_speed() const {
  const volVectorField& velocity = lookupObject<volVectorField>(velocity_name_);
  scalar highest = 0;
  for (const vector& u : velocity.primitiveField()) highest = max(highest, mag(u));
  // ranks have different numbers of patches: nothing collective inside this loop
  forAll(velocity.boundaryField(), patch) {
    for (const vector& u : velocity.boundaryField()[patch]) highest = max(highest, mag(u));
  }
  return returnReduce(highest, maxOp<scalar>());
}

/// Solvers diverge without a word at low Reynolds numbers (PISO with nu dt / dy^2 above about 5,
/// SIMPLE with large relaxation factors). Divergence multiplies speeds without end; no flow that is
/// merely accelerated comes near this factor.
void hemoscaleCoupling::check_speed() {
  const scalar highest = highest_speed();
  if (usual_speed_ <= 0) usual_speed_ = highest;
  if (highest <= 1e4 * usual_speed_) return;
  const double unit = units_of(given_.settings).speed();
  std::ostringstream message;
  message << "the solver diverged: the highest speed is " << highest * unit << " m/s, it was "
          << usual_speed_ * unit
          << " m/s; reduce the time step (PISO: nu dt / dy^2 below 3), raise "
          << "nCorrectors, or reduce the relaxation factors";
  throw hs::macro::NumericalError(message.str());
}

void hemoscaleCoupling::advance_window() {
  const auto start = std::chrono::steady_clock::now();
  const double time_unit = units_of(given_.settings).time;
  check_feedback();
  check_speed();
  if (mesh_.changing()) locator_ = std::make_shared<hs::macro::PointLocator>(mesh_);
  const hs::coupling::PassReport pass =
      session_->advance(flow(), {window_begin_ * time_unit, time_.value() * time_unit});
  window_begin_ = time_.value();
  ++windows_;
  if (!is_one_way_) deliver_law();

  const bool was_last = pass.pass >= given_.settings.integer("coupling.maximum_passes");
  is_settled_ = is_steady_ && (pass.converged || was_last);
  coupling_time_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  if (!is_settled_) return;
  Info << "hemoscale: " << (pass.converged ? "converged" : "last pass allowed, not converged")
       << ": the steady flow goes on under this law, no more windows" << nl << endl;
}

bool hemoscaleCoupling::execute() {
  if (is_settled_ || !window_is_complete()) return true;
  const std::string failure = failure_of([this] { advance_window(); });
  if (!failure.empty()) {
    FatalErrorInFunction << "hemoscale: " << failure.c_str() << exit(FatalError);
  }
  return true;
}

bool hemoscaleCoupling::end() {
  if (is_finished_) return true;
  is_finished_ = true;
  const std::string failure = failure_of([this] {
    if (windows_ == 0) {
      throw hs::macro::NumericalError(
          "the solver ended after " + std::to_string(time_.timeIndex() - first_step_) +
          " steps, before the first window of " + std::to_string(steps_in_window_) +
          " steps (coupling.interval) was complete: nothing was coupled; reduce coupling.interval, "
          "or remove the solver's residualControl");
    }
    session_->finish(figures());
  });
  if (!failure.empty()) {
    FatalErrorInFunction << "hemoscale: " << failure.c_str() << exit(FatalError);
  }
  Info << "hemoscale: " << windows_ << " windows, results in " << given_.results << nl << endl;
  return true;
}

std::map<std::string, double> hemoscaleCoupling::figures() const {
  std::map<std::string, double> figures;
  const hs::macro::MeshUnits units = units_of(given_.settings);
  figures["highest speed in the mesh [m/s]"] = highest_speed() * units.speed();
  figures["cells of the mesh [-]"] = returnReduce(mesh_.nCells(), sumOp<label>());
  figures["ranks of the solver [-]"] = Pstream::nProcs();
  figures["steps of the solver [-]"] = time_.timeIndex() - first_step_;
  figures["windows [-]"] = windows_;
  figures["wall time of the coupled loop in the solver [s]"] = coupling_time_;
  if (law_in_use_ != nullptr && law_in_use_->nu() != nullptr) {
    const scalarField& nu = law_in_use_->nu()->primitiveField();
    figures["lowest viscosity in the mesh [Pa s]"] = gMin(nu) * units.dynamic_viscosity();
    figures["highest viscosity in the mesh [Pa s]"] = gMax(nu) * units.dynamic_viscosity();
    figures["laws given to the solver [-]"] = law_in_use_->applied_revision();
    figures["evaluations of the viscosity [-]"] = law_in_use_->corrections();
  }
  return figures;
}

}  // namespace functionObjects
}  // namespace Foam
