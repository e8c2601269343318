#include "coupling/scene/coupled_session.hpp"

#include <fmt/format.h>

#include <iostream>
#include <utility>

#include "coupling/error.hpp"
#include "coupling/sampling/sample_flow.hpp"
#include "coupling/scene/case_checks.hpp"
#include "coupling/scene/coupled_run.hpp"
#include "coupling/scene/results_folder.hpp"
#include "coupling/scheme/coupling_scheme.hpp"

namespace hemoscale::coupling {

struct CoupledSession::State {
  Settings settings;
  micro::Communicator communicator;
  std::unique_ptr<CoupledRun> run;
};

CoupledSession::CoupledSession(const Settings& settings, const std::filesystem::path& results,
                               bool restart, micro::Communicator communicator)
    : state_(std::make_unique<State>()) {
  if (const std::vector<Fault> faults = find_faults(settings, false); !faults.empty()) {
    throw CaseError(faults);
  }
  state_->settings = settings;
  state_->communicator = std::move(communicator);
  const micro::Communicator& group = state_->communicator;

  // The solver owns the terminal; its log is the place for ours.
  const bool is_root = group.is_root();
  const auto log = [is_root](const std::string& line) {
    if (is_root) std::cout << "hemoscale: " << line << std::endl;
  };
  std::string failure;
  if (is_root) {
    try {
      const std::string told = prepare_results_folder(results, restart);
      if (!told.empty()) log(told);
    } catch (const std::exception& error) {
      failure = error.what();
    }
  }
  if (group.size() == 1 && !failure.empty()) throw EnvironmentError(failure);
  group.agree(failure);
  state_->run = std::make_unique<CoupledRun>(state_->settings, results, restart, false, group, log);
}

CoupledSession::~CoupledSession() = default;

const macro::ViscosityLaw& CoupledSession::law() const {
  return state_->run->loop().law();
}
double CoupledSession::hematocrit() const {
  return state_->settings.quantity("fluid.hematocrit");
}
double CoupledSession::density() const {
  return state_->settings.quantity("fluid.density");
}

const Settings::Points& CoupledSession::points() const {
  return state_->settings.points("sampling.points");
}

bool CoupledSession::is_converged() const {
  return state_->run->is_converged();
}

PassReport CoupledSession::advance(const macro::FlowField<3>& flow, const macro::Window& window) {
  CoupledRun& run = *state_->run;
  const auto scope = run.timings().measure("coupled loop");
  const std::vector<macro::Vector<3>> points(this->points().begin(), this->points().end());
  CoupledLoop& loop = run.loop();
  LoopReport report;
  if (state_->settings.text("coupling.scheme") == "one-way") {
    std::vector<ShearForcing> forcings;
    for (const macro::FlowState<3>& state : sample_flow<3>(flow, points, window.end)) {
      forcings.push_back(to_forcing<3>(state, hematocrit()));
    }
    report = loop.measure(forcings);
  } else {
    report = coupled_pass<3>(loop, flow, points, window.end, hematocrit());
  }
  loop.end_window();
  run.record(report, window.end, {});
  return {report.pass,
          window.end,
          report.change,
          report.relaxation_factor,
          report.micro_runs,
          report.lowest_viscosity,
          report.highest_viscosity,
          report.converged};
}

void CoupledSession::finish(const std::map<std::string, double>& host_figures) {
  std::vector<Figure> figures;
  for (const auto& [name, value] : host_figures) {
    // "nu, lowest [m^2/s]": the host gives the unit with the name.
    const std::size_t open = name.rfind(" [");
    const bool has_unit = open != std::string::npos && name.back() == ']';
    figures.push_back({has_unit ? name.substr(0, open) : name, value,
                       has_unit ? name.substr(open + 2, name.size() - open - 3) : "-"});
  }
  state_->run->finish(std::move(figures), state_->run->loop().law());
}

}  // namespace hemoscale::coupling
