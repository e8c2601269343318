#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <sstream>

#include "coupling/error.hpp"
#include "coupling/report/series.hpp"
#include "coupling/report/summary.hpp"
#include "coupling/scene/child_process.hpp"
#include "coupling/scene/hosts.hpp"
#include "macro/analytic/channel_model.hpp"
#include "macro/kinematics.hpp"
#include "macro/openfoam/loader.hpp"

namespace hemoscale::coupling {

namespace {

namespace fs = std::filesystem;

macro::CaseReading build_reading(const Settings& settings) {
  macro::CaseReading reading;
  reading.velocity_field = settings.text("macro.openfoam.velocity_field");
  reading.units.length = settings.quantity("macro.openfoam.length_unit");
  reading.units.time = settings.quantity("macro.openfoam.time_unit");
  reading.units.density = settings.quantity("fluid.density");
  const std::string& interpolation = settings.text("macro.openfoam.interpolation");
  if (interpolation == "cell-point") reading.interpolation = macro::Interpolation::cell_point;
  if (interpolation == "cell-point-face") {
    reading.interpolation = macro::Interpolation::cell_point_face;
  }
  return reading;
}

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> result;
  for (std::string word; stream >> word;) result.push_back(word);
  return result;
}

/// The solver and what must come before it, in an OpenFOAM case folder of its own.
class SolverRun {
 public:
  SolverRun(const PreparedRun& run, fs::path library)
      : run_(run), folder_(run.results / "openfoam"), library_(std::move(library)) {}

  const fs::path& folder() const { return folder_; }

  void prepare() const {
    const fs::path original = run_.case_folder / run_.settings.text("macro.openfoam.case");
    if (!fs::is_regular_file(original / "system" / "controlDict")) {
      const Location place = run_.settings.location("macro.openfoam.case");
      throw CaseError(
          {{place.file, place.line, place.column, "macro.openfoam.case",
            fmt::format("{} is not an OpenFOAM case: it has no system/controlDict; give the "
                        "folder that holds 0, constant and system",
                        original.string())}});
    }
    try {
      fs::copy(original, folder_, fs::copy_options::recursive);
    } catch (const fs::filesystem_error& error) {
      throw EnvironmentError(fmt::format("{}: cannot be copied to {}: {}", original.string(),
                                         folder_.string(), error.code().message()));
    }
    step("mesh", words(run_.settings.text("macro.openfoam.mesh_command")));
    if (ranks() > 1) step("decompose", {"decomposePar"});
  }

  void solve() const {
    std::vector<std::string> command = words(run_.settings.text("macro.openfoam.solver"));
    if (ranks() > 1) {
      std::vector<std::string> launcher = {"mpirun",
                                           "-np",
                                           std::to_string(ranks()),
                                           "--oversubscribe",
                                           "--bind-to",
                                           "none",
                                           "--mca",
                                           "mpi_yield_when_idle",
                                           "1"};
      if (geteuid() == 0) launcher.push_back("--allow-run-as-root");
      command.insert(command.begin(), launcher.begin(), launcher.end());
      command.push_back("-parallel");
    }
    step("solver", command);
    if (ranks() > 1) step("reconstruct", {"reconstructPar", "-latestTime"});
  }

 private:
  std::int64_t ranks() const { return run_.settings.integer("macro.openfoam.ranks"); }

  void step(const std::string& name, const std::vector<std::string>& command) const {
    ChildProcess child;
    child.command = command;
    child.folder = folder_;
    child.log = run_.results / ("log." + name);
    child.environment["HEMOSCALE_CASE"] = fs::absolute(run_.case_file).string();
    child.environment["HEMOSCALE_VARIANT"] = run_.variant;
    child.environment["HEMOSCALE_RESULTS"] = fs::absolute(run_.results).string();
    child.environment["HEMOSCALE_RESTART"] = run_.restart ? "true" : "false";
    child.environment["HEMOSCALE_OPENFOAM_LIBRARY"] = library_.string();
    if (std::getenv("WM_PROJECT_DIR") == nullptr) {
      child.environment["WM_PROJECT_DIR"] = "/usr/share/openfoam";
    }
    std::vector<std::string> last_lines;
    const int status = run_child(child, [&](const std::string& line) {
      const std::string mark = "hemoscale: ";
      if (line.rfind(mark, 0) == 0) run_.log(line.substr(mark.size()));
      last_lines.push_back(line);
      if (last_lines.size() > 30) last_lines.erase(last_lines.begin());
    });
    if (status == 0) return;
    std::string tail;
    for (const std::string& line : last_lines) tail += "\n  | " + line;
    throw EnvironmentError(
        fmt::format("{} ended with status {}; its output is in {}, the last lines:{}",
                    command.front(), status, child.log.string(), tail));
  }

  const PreparedRun& run_;
  fs::path folder_;
  fs::path library_;
};

macro::ViscosityLaw read_law(const fs::path& file) {
  macro::ViscosityRow row;
  for (const std::vector<double>& values : read_table(file).rows) {
    row.shear_rates.push_back(values.at(0));
    row.hematocrit = values.at(1);
    row.viscosities.push_back(values.at(2));
  }
  return macro::ViscosityLaw(macro::ViscosityTable({row}));
}

/// Velocity on the line that the case names, beside the channel flow of the final law by
/// quadrature.
std::vector<Figure> compare_profile(const PreparedRun& run, const macro::FlowField<3>& flow) {
  const Settings& settings = run.settings;
  if (!settings.has("macro.openfoam.profile")) return {};
  const Settings::Points& ends = settings.points("macro.openfoam.profile");
  const macro::Vector<3> begin = ends.at(0);
  const macro::Vector<3> along = ends.at(1) - ends.at(0);
  const double length = along.norm();
  const macro::Vector<3> direction = along / length;

  const macro::ViscosityLaw law = read_law(run.results / "law.csv");
  const double hematocrit = settings.quantity("fluid.hematocrit");
  std::shared_ptr<const macro::ChannelFlow<2>> reference;
  if (settings.has("macro.openfoam.profile_mean_velocity")) {
    const macro::MeanVelocity drive{settings.quantity("macro.openfoam.profile_mean_velocity")};
    reference = macro::ChannelModel<2>({length, hematocrit, drive}).solve(law);
  }

  const int count = 161;
  std::vector<macro::Vector<3>> points;
  for (int k = 0; k < count; ++k) points.push_back(begin + along * ((k + 0.5) / count));
  const auto states = flow.sample(points, 0);
  std::vector<std::vector<double>> rows;
  double largest = 0;
  double deviation = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (!states[k]) continue;
    const double y = (points[k] - begin).norm();
    const macro::Vector<3>& u = states[k]->velocity;
    const double speed = (u - u.dot(direction) * direction).norm();
    const double rate = macro::shear_rate<3>(states[k]->velocity_gradient);
    double exact = std::nan("");
    if (reference) {
      exact = reference->velocity(y);
      deviation = std::max(deviation, std::abs(speed - exact));
    }
    largest = std::max(largest, speed);
    rows.push_back({y, speed, rate, law.viscosity(rate, hematocrit), exact});
  }
  write_table(run.results / "profile.csv",
              {{"y", "m"},
               {"velocity", "m/s"},
               {"shear rate", "1/s"},
               {"viscosity", "Pa s"},
               {"reference velocity", "m/s"}},
              rows);
  std::vector<Figure> figures = {{"largest velocity on the profile", largest, "m/s"}};
  if (reference) {
    figures.push_back(
        {"largest deviation from the channel flow by quadrature over largest velocity",
         deviation / largest, "-"});
  }
  return figures;
}

}  // namespace

void run_openfoam(const PreparedRun& run) {
  // Loading it first tells at once what is missing.
  const macro::OpenFoamLibrary library;
  const SolverRun solver(run, library.file());
  if (!run.restart) solver.prepare();
  solver.solve();

  const fs::path summary_file = run.results / "summary.json";
  if (!fs::exists(summary_file)) {
    throw EnvironmentError(fmt::format(
        "the solver ended, but the plug-in left no {}: OpenFOAM only warns when a library or "
        "a function object does not load; look for \"hemoscale\" in {}, and at libs and "
        "functions in system/controlDict",
        summary_file.string(), (run.results / "log.solver").string()));
  }
  // The case names the plug-in by this variable; it is read again here.
  setenv("HEMOSCALE_OPENFOAM_LIBRARY", library.file().c_str(), 1);
  const auto flow = library.open_case(solver.folder(), build_reading(run.settings));
  Summary summary = read_summary(summary_file);
  const std::vector<Figure> figures = compare_profile(run, *flow);
  summary.figures.insert(summary.figures.begin(), figures.begin(), figures.end());
  write_summary(summary_file, summary);
}

}  // namespace hemoscale::coupling
