#include "coupling/scene/ensemble_flow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "coupling/error.hpp"
#include "macro/analytic/womersley.hpp"
#include "micro/ensemble/flow/expansion_error.hpp"
#include "micro/ensemble/flow/parallel_flow.hpp"
#include "micro/ensemble/flow/table_flow.hpp"

namespace hemoscale::coupling {

namespace {

const std::string expansion_statement =
    "largest error of one expansion for a whole cell over the largest speed";

/// Places of cells across a plane channel.
std::vector<micro::Vector<2>> places_across(double height) {
  std::vector<micro::Vector<2>> places;
  for (int k = 1; k < 40; ++k) places.push_back({0, height * k / 40});
  return places;
}

EnsembleFlow build_poiseuille(const Settings& settings) {
  micro::VelocityProfile profile;
  profile.height = settings.quantity("micro.channel.height");
  const double mean = settings.quantity("micro.mean_velocity");
  const int intervals = 16;
  for (int k = 0; k <= intervals; ++k) {
    const double s = static_cast<double>(k) / intervals;
    profile.velocities.push_back(6 * mean * s * (1 - s));
  }
  EnsembleFlow result;
  result.flow = std::make_shared<micro::ParallelFlow>(profile);
  return result;
}

macro::WomersleyChannelProfile womersley_profile(const Settings& settings) {
  macro::WomersleyChannelProfile profile;
  profile.height = settings.quantity("micro.channel.height");
  profile.viscosity = settings.quantity("fluid.plasma_viscosity");
  profile.density = settings.quantity("fluid.density");
  profile.steady_gradient = 12 * profile.viscosity * settings.quantity("micro.mean_velocity") /
                            (profile.height * profile.height);
  profile.oscillating_gradient =
      settings.quantity("micro.flow.amplitude") * profile.steady_gradient;
  profile.angular_frequency = 2 * std::numbers::pi * settings.quantity("micro.flow.frequency");
  macro::check(profile);
  return profile;
}

EnsembleFlow build_womersley(const Settings& settings) {
  const macro::WomersleyChannelProfile exact = womersley_profile(settings);
  // Some 16 points in each of the layers at the walls in which the flow oscillates.
  const double layers = std::ceil(16 * macro::womersley_number(exact));
  const int intervals = static_cast<int>(std::max(64.0, layers));
  const auto instants = settings.integer("micro.flow.instants");
  const double period = 1 / settings.quantity("micro.flow.frequency");
  std::vector<double> times;
  std::vector<std::shared_ptr<const micro::GivenFlow>> flows;
  for (std::int64_t n = 0; n < instants; ++n) {
    times.push_back(period * static_cast<double>(n) / static_cast<double>(instants));
    micro::VelocityProfile profile{.height = exact.height, .velocities = {}};
    for (int k = 0; k <= intervals; ++k) {
      const double y = exact.height * k / intervals;
      profile.velocities.push_back(macro::evaluate(exact, y, times.back()).velocity);
    }
    flows.push_back(std::make_shared<micro::ParallelFlow>(profile));
  }
  EnsembleFlow result;
  result.flow = std::make_shared<micro::TableFlow>(times, flows, period);

  // Half-way between the points and instants of the table, where its error is largest.
  double error = 0;
  for (std::int64_t n = 0; n < instants; ++n) {
    const double t = period * (static_cast<double>(n) + 0.5) / static_cast<double>(instants);
    for (int k = 0; k < intervals; ++k) {
      const double y = exact.height * (k + 0.5) / intervals;
      const double u = macro::evaluate(exact, y, t).velocity;
      error = std::max(error, std::abs(result.flow->at({0, y}, t).velocity[0] - u));
    }
  }
  const double speed = result.flow->largest_speed();
  result.statements = {
      {"Womersley number", macro::womersley_number(exact)},
      {"largest error of the tabulated velocity over the largest speed", error / speed}};
  return result;
}

void check_domain(const Settings& settings) {
  const std::string& kind = settings.text("micro.flow.kind");
  const std::string& domain = settings.text("micro.domain");
  if ((kind == "openfoam") == (domain == "geometry")) return;
  const Location place = settings.location("micro.flow.kind");
  throw CaseError({{place.file, place.line, place.column, "micro.flow.kind",
                    fmt::format("\"{}\" does not fit micro.domain = \"{}\"; openfoam needs the "
                                "domain geometry, poiseuille and womersley the domain channel",
                                kind, domain)}});
}

}  // namespace

EnsembleFlow build_ensemble_flow(const Settings& settings, const std::filesystem::path& case_folder,
                                 const std::filesystem::path& results) {
  check_domain(settings);
  const std::string& kind = settings.text("micro.flow.kind");
  if (kind == "openfoam") return build_openfoam_flow(settings, case_folder, results);
  EnsembleFlow result =
      kind == "womersley" ? build_womersley(settings) : build_poiseuille(settings);
  const double radius = 0.5 * settings.quantity("micro.shape.length");
  const double error = micro::expansion_error(
      *result.flow, 0, radius, places_across(settings.quantity("micro.channel.height")));
  result.statements.push_back({expansion_statement, error / result.flow->largest_speed()});
  return result;
}

}  // namespace hemoscale::coupling
