#include "coupling/scene/plasma_method.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <vector>

#include "coupling/error.hpp"

namespace hemoscale::coupling {

namespace {

const std::string prefix = "micro.plasma.";

/// Reads choices and notes those that the method cannot take.
class ChoiceReader {
 public:
  explicit ChoiceReader(const Settings& settings) : settings_(settings) {}

  bool gives(const std::string& key) const { return settings_.has(prefix + key); }

  /// Sets `target` to the value that belongs to the word of the key, if the key is given.
  template <typename Value>
  void take(const std::string& key, const std::vector<std::pair<std::string, Value>>& meanings,
            Value& target) {
    if (!gives(key)) return;
    const std::string& word = settings_.text(prefix + key);
    std::vector<std::string> words;
    for (const auto& [name, value] : meanings) {
      if (name == word) {
        target = value;
        return;
      }
      words.push_back(name);
    }
    refuse(key,
           fmt::format("\"{}\" is not for {}; it takes {}", word, method, fmt::join(words, ", ")));
  }

  void take(const std::string& key, double& target) {
    if (gives(key)) target = settings_.quantity(prefix + key);
  }

  /// Notes keys that mean nothing to the method.
  void forbid(const std::vector<std::string>& keys) {
    for (const std::string& key : keys) {
      if (gives(key)) refuse(key, fmt::format("has no meaning for {}; remove it", method));
    }
  }

  void refuse(const std::string& key, const std::string& message) {
    const Location place = settings_.location(prefix + key);
    faults_.push_back({place.file, place.line, place.column, prefix + key, message});
  }

  void finish() const {
    if (!faults_.empty()) throw CaseError(faults_);
  }

  std::string method;

 private:
  const Settings& settings_;
  std::vector<Fault> faults_;
};

micro::StageOptions stage_options(const Settings& settings, const std::string& scheme) {
  using micro::Inertia, micro::NodeMotion, micro::PressureCoupling, micro::Shifting;
  using micro::LinearSolverKind, micro::TimeScheme, micro::ViscosityTreatment;
  micro::StageOptions options;
  if (scheme == "moving") {
    options.motion = NodeMotion::lagrangian;
    options.shifting = Shifting::concentration;
    options.shifting_strength = 0.3;
  }
  ChoiceReader read(settings);
  read.method = "the operators lsmps2";
  read.take<PressureCoupling>("coupling",
                              {{"chorin", PressureCoupling::chorin},
                               {"incremental", PressureCoupling::incremental},
                               {"coupled", PressureCoupling::coupled}},
                              options.coupling);
  read.take<ViscosityTreatment>("viscosity",
                                {{"explicit", ViscosityTreatment::explicit_euler},
                                 {"implicit", ViscosityTreatment::implicit}},
                                options.viscosity);
  read.take<TimeScheme>("time_scheme",
                        {{"euler", TimeScheme::euler}, {"sdirk2", TimeScheme::sdirk2}},
                        options.time_scheme);
  read.take<Inertia>("inertia",
                     {{"unsteady", Inertia::unsteady}, {"quasi-steady", Inertia::quasi_steady}},
                     options.inertia);
  if (settings.text(prefix + "membranes") == "implicit" && !read.gives("inertia")) {
    options.inertia = Inertia::quasi_steady;  // the only kind that it takes
  }
  read.take<NodeMotion>("motion",
                        {{"lagrangian", NodeMotion::lagrangian},
                         {"ale", NodeMotion::ale},
                         {"eulerian", NodeMotion::eulerian}},
                        options.motion);
  if (options.motion == NodeMotion::eulerian) {
    options.shifting = Shifting::none;
  } else if (scheme != "moving") {
    options.shifting = Shifting::concentration;
    options.shifting_strength = 0.3;
  }
  read.take<Shifting>("shifting",
                      {{"none", Shifting::none}, {"concentration", Shifting::concentration}},
                      options.shifting);
  read.take<LinearSolverKind>("linear_solver",
                              {{"automatic", LinearSolverKind::automatic},
                               {"banded", LinearSolverKind::banded},
                               {"sparse-direct", LinearSolverKind::sparse_direct},
                               {"aggregate", LinearSolverKind::aggregate},
                               {"hypre", LinearSolverKind::hypre}},
                              options.linear_solver);
  int ignored = 0;
  read.take<int>("source", {{"divergence", 0}}, ignored);
  read.take<int>("walls", {{"lsmps", 0}}, ignored);
  read.take("kernel_ratio", options.kernel_ratio);
  read.take("stabilisation", options.stabilisation);
  read.take("tolerance", options.tolerance.relative_residual);
  read.forbid({"gradient_form", "laplacian_scale", "laplacian_ratio", "relaxation"});
  read.finish();
  micro::check(options);
  return options;
}

micro::SemiImplicitOptions semi_implicit_options(const Settings& settings,
                                                 const std::string& scheme,
                                                 micro::OperatorKind operators) {
  using micro::GradientForm, micro::IncompressibilitySource, micro::LaplacianScale;
  using micro::ParticleCoupling, micro::ShiftKind, micro::ViscousStepping, micro::WallVelocity;
  micro::SemiImplicitOptions options =
      scheme == "paper" ? micro::paper_literal() : micro::best_repaired();
  options.operators = operators;
  ChoiceReader read(settings);
  read.method = "the operators mps, cmps and gc";
  read.take<GradientForm>("gradient_form",
                          {{"difference", GradientForm::difference},
                           {"minimum", GradientForm::minimum},
                           {"antisymmetric", GradientForm::antisymmetric}},
                          options.gradient_form);
  read.take<LaplacianScale>(
      "laplacian_scale",
      {{"local", LaplacianScale::local}, {"reference", LaplacianScale::reference}},
      options.laplacian_scale);
  read.take<IncompressibilitySource>("source",
                                     {{"pnd", IncompressibilitySource::pnd},
                                      {"divergence", IncompressibilitySource::divergence},
                                      {"hs-ecs", IncompressibilitySource::hs_ecs}},
                                     options.source);
  read.take<ParticleCoupling>(
      "coupling",
      {{"chorin", ParticleCoupling::chorin}, {"incremental", ParticleCoupling::incremental}},
      options.coupling);
  read.take<ViscousStepping>("viscosity",
                             {{"explicit", ViscousStepping::explicit_euler},
                              {"implicit", ViscousStepping::implicit_euler}},
                             options.viscosity);
  read.take<WallVelocity>(
      "walls", {{"dummy", WallVelocity::dummy}, {"antisymmetric", WallVelocity::antisymmetric}},
      options.wall_velocity);
  read.take<ShiftKind>("shifting",
                       {{"none", ShiftKind::none},
                        {"concentration", ShiftKind::concentration},
                        {"ops", ShiftKind::ops}},
                       options.shift);
  int ignored = 0;
  read.take<int>("time_scheme", {{"euler", 0}}, ignored);
  read.take<int>("inertia", {{"unsteady", 0}}, ignored);
  read.take<int>("motion", {{"lagrangian", 0}}, ignored);
  read.take("kernel_ratio", options.gradient_ratio);
  read.take("laplacian_ratio", options.laplacian_ratio);
  read.take("relaxation", options.relaxation);
  read.forbid({"stabilisation", "linear_solver", "tolerance"});
  read.finish();
  return options;
}

}  // namespace

micro::PlasmaMethod build_plasma_method(const Settings& settings) {
  const std::string& scheme = settings.text(prefix + "scheme");
  const bool is_particle_scheme = scheme == "paper" || scheme == "repaired";
  std::string operators = is_particle_scheme ? (scheme == "paper" ? "mps" : "gc") : "lsmps2";
  if (settings.has(prefix + "operators")) operators = settings.text(prefix + "operators");
  if (operators == "lsmps2") return stage_options(settings, scheme);
  const micro::OperatorKind kind = operators == "mps"    ? micro::OperatorKind::mps
                                   : operators == "cmps" ? micro::OperatorKind::cmps
                                                         : micro::OperatorKind::gc;
  return semi_implicit_options(settings, scheme, kind);
}

}  // namespace hemoscale::coupling
