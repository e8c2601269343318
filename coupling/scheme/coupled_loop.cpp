#include "coupling/scheme/coupled_loop.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "coupling/error.hpp"
#include "coupling/scheme/shear_groups.hpp"
#include "coupling/transfer/to_rheology.hpp"

namespace hemoscale::coupling {

namespace {

void check(const LoopOptions& options) {
  std::vector<Fault> faults = faults_of(options.relaxation);
  const auto require = [&](bool holds, const char* key, double value, const char* allowed) {
    if (holds) return;
    Fault fault;
    fault.key = key;
    fault.message = fmt::format("{} is out of range; it must be {}", value, allowed);
    faults.push_back(std::move(fault));
  };
  require(options.tolerance > 0 && options.tolerance < 1, "coupling.tolerance", options.tolerance,
          "between 0 and 1");
  require(options.distinct_ratio >= 1, "sampling.distinct_ratio", options.distinct_ratio,
          "at least 1");
  require(options.lowest_shear_rate > 0, "sampling.lowest_shear_rate", options.lowest_shear_rate,
          "positive [1/s]");
  require(options.threads >= 1, "threads", options.threads, "at least 1");
  if (!faults.empty()) throw CaseError(std::move(faults));
}

template <class Use>
void for_each_knot(const std::vector<macro::ViscosityRow>& rows, const Use& use) {
  for (const macro::ViscosityRow& row : rows) {
    for (std::size_t i = 0; i < row.shear_rates.size(); ++i) {
      use(row.shear_rates[i], row.hematocrit, row.viscosities[i]);
    }
  }
}

// log(candidate) - log(law) at the knots of a table.
std::vector<double> residual_of(const macro::ViscosityLaw& law,
                                const macro::ViscosityLaw& candidate,
                                const std::vector<macro::ViscosityRow>& knots) {
  std::vector<double> residual;
  for_each_knot(knots, [&](double shear_rate, double hematocrit, double) {
    residual.push_back(std::log(candidate.viscosity(shear_rate, hematocrit) /
                                law.viscosity(shear_rate, hematocrit)));
  });
  return residual;
}

// log(law) + factor * residual at the knots of a table.
macro::ViscosityLaw moved(const macro::ViscosityLaw& law, const std::vector<double>& residual,
                          double factor, std::vector<macro::ViscosityRow> rows) {
  std::size_t k = 0;
  for (macro::ViscosityRow& row : rows) {
    for (std::size_t i = 0; i < row.shear_rates.size(); ++i, ++k) {
      row.viscosities[i] =
          law.viscosity(row.shear_rates[i], row.hematocrit) * std::exp(factor * residual[k]);
      if (!std::isfinite(row.viscosities[i]) || row.viscosities[i] <= 0) {
        throw NumericalError(fmt::format(
            "coupled iteration: relaxation with factor {:.3g} makes the viscosity at {:.6g} 1/s "
            "{}; it must be finite and positive. Reduce coupling.relaxation_factor",
            factor, row.shear_rates[i], row.viscosities[i]));
      }
    }
  }
  return macro::ViscosityLaw(macro::ViscosityTable(std::move(rows)));
}

std::vector<double> all_knots(const std::vector<std::vector<double>>& rows) {
  std::vector<double> result;
  for (const std::vector<double>& row : rows) result.insert(result.end(), row.begin(), row.end());
  return result;
}

}  // namespace

CoupledLoop::CoupledLoop(macro::ViscosityLaw initial_law, LoopOptions options, MicroFactory factory,
                         const micro::Communicator& communicator)
    : initial_law_(std::move(initial_law)),
      options_((check(options), std::move(options))),
      micro_runs_(std::move(factory), communicator, options_.threads),
      state_{initial_law_, false, {}, std::nullopt, {}, std::nullopt, 0, false} {}

RheologyTable CoupledLoop::table_of(std::vector<RheologySample> samples) const {
  Pooling pooling;
  pooling.shear_ratio = options_.distinct_ratio;
  return RheologyTable(std::move(samples), options_.bounds, pooling);
}

LoopReport CoupledLoop::pass(const std::vector<ShearForcing>& flows) {
  return advance(flows, true);
}

LoopReport CoupledLoop::measure(const std::vector<ShearForcing>& flows) {
  return advance(flows, false);
}

void CoupledLoop::end_window() {
  state_.changes.clear();
  state_.history.reset();
  state_.has_converged = false;
}

// Which runs the flows ask for, and what they need not.
std::vector<PlannedRun> CoupledLoop::plan(const std::vector<ShearForcing>& flows,
                                          LoopReport& report) const {
  ShearGroups groups =
      group_by_shear_rate(flows, options_.distinct_ratio, options_.lowest_shear_rate);
  report.points_below_lowest_shear_rate = groups.points_below_lowest;
  for (const ShearForcing& flow : flows) {
    if (flow.shear_rate >= options_.lowest_shear_rate &&
        std::abs(flow.flow_type) > std::abs(report.worst_flow_type)) {
      report.worst_flow_type = flow.flow_type;
    }
  }
  if (options_.memory == Memory::latest) return std::move(groups.runs);
  std::vector<PlannedRun> result;
  for (PlannedRun& run : groups.runs) {
    if (is_covered(run.flow, state_.samples, options_.distinct_ratio,
                   options_.run.relative_standard_error)) {
      ++report.shear_rates_covered;
    } else {
      result.push_back(std::move(run));
    }
  }
  return result;
}

LoopReport CoupledLoop::advance(const std::vector<ShearForcing>& flows, bool feedback) {
  LoopReport report;
  const std::vector<PlannedRun> planned = plan(flows, report);
  const std::map<int, micro::Snapshot> states_before = micro_runs_.states();
  report.runs = micro_runs_.advance(planned, options_.run, on_run_);
  report.micro_runs = static_cast<int>(report.runs.size());
  try {
    State next = state_;
    report.pass = ++next.passes;
    for (std::size_t i = 0; i < planned.size(); ++i) {
      report.samples.push_back(
          to_rheology<2>(report.runs[i].observation, planned[i].flow.forcing.hematocrit));
      report.runs_without_precision += !report.samples.back().precision_reached;
    }
    if (options_.memory == Memory::latest) next.samples.clear();
    next.samples.insert(next.samples.end(), report.samples.begin(), report.samples.end());
    digest(next, report, feedback);
    next.has_converged = report.converged;
    if (!next.candidate) {
      report.lowest_viscosity = std::numeric_limits<double>::infinity();
      for (const ShearForcing& flow : flows) {
        const double mu = next.law.viscosity(flow.shear_rate, flow.forcing.hematocrit);
        report.lowest_viscosity = std::min(report.lowest_viscosity, mu);
        report.highest_viscosity = std::max(report.highest_viscosity, mu);
      }
    }
    state_ = std::move(next);
  } catch (...) {
    micro_runs_.restore(states_before);
    throw;
  }
  return report;
}

// From samples to candidate, change and new law.
void CoupledLoop::digest(State& next, LoopReport& report, bool feedback) const {
  if (next.samples.empty()) {
    next.candidate.reset();
    return;
  }
  next.candidate.emplace(table_of(next.samples));
  const RheologyTable& candidate = *next.candidate;
  report.knots_moved_by_bounds = candidate.knots_moved_by_bounds();
  report.knots_pooled_by_monotonicity = candidate.knots_pooled_by_monotonicity();
  report.knots_merged_for_rising_stress = candidate.knots_merged_for_rising_stress();

  const std::vector<double> weights = knot_weights(candidate.rows());
  const std::vector<double> residual = residual_of(next.law, candidate.law(), candidate.rows());
  report.change = weighted_rms(residual, weights);
  // The law carries about as much error as the candidate does, independently of it.
  report.noise = std::sqrt(2.0) * weighted_rms(all_knots(candidate.log_errors()), weights);
  const bool within_tolerance = report.change <= options_.tolerance;
  report.limited_by_noise =
      !within_tolerance && options_.stop_at_noise && report.change <= report.noise;
  report.converged = within_tolerance || report.limited_by_noise;
  if (feedback) relax(next, residual, weights, report);

  report.lowest_viscosity = std::numeric_limits<double>::infinity();
  for_each_knot(candidate.rows(), [&](double shear_rate, double hematocrit, double) {
    const double mu = next.law.viscosity(shear_rate, hematocrit);
    report.lowest_viscosity = std::min(report.lowest_viscosity, mu);
    report.highest_viscosity = std::max(report.highest_viscosity, mu);
  });
}

void CoupledLoop::relax(State& next, const std::vector<double>& residual,
                        const std::vector<double>& weights, LoopReport& report) const {
  const RheologyTable& candidate = *next.candidate;
  FactorChoice choice{initial_factor(options_.relaxation), false};
  if (next.history) {
    // Knots move and grow in number from pass to pass, so the residual before is taken as the
    // function that it is and evaluated at the knots of today.
    choice = next_factor(options_.relaxation, next.history->factor,
                         residual_of(next.history->law, next.history->candidate, candidate.rows()),
                         residual, weights);
  }
  report.relaxation_factor = choice.factor;
  report.factor_was_bounded = choice.bounded;
  next.changes.push_back(report.change);
  require_no_divergence(next.changes, options_.divergence, choice.factor);
  next.history = History{next.law, next.law_is_table, candidate.law(), choice.factor};
  next.law = choice.factor == 1 ? candidate.law()
                                : moved(next.law, residual, choice.factor, candidate.rows());
  next.law_is_table = true;
}

}  // namespace hemoscale::coupling
