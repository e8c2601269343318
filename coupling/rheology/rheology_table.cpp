#include "coupling/rheology/rheology_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

#include "coupling/rheology/monotone_regression.hpp"
#include "coupling/rheology/pooled_knots.hpp"
#include "coupling/rheology/student_t.hpp"

namespace hemoscale::coupling {

namespace {

constexpr double confidence = 0.95;  // [-] of the whole band

// The shear rates at the ends of the range come back from logarithms and from other programs.
constexpr double rounding = 1e-9;  // [-] relative

constexpr double infinity = std::numeric_limits<double>::infinity();

void require(bool holds, const std::string& what, double value, const char* allowed) {
  if (!holds) {
    throw std::invalid_argument(
        fmt::format("rheology table: {} is {}; it must be {}", what, value, allowed));
  }
}

void check(const std::vector<RheologySample>& samples, const FitBounds& bounds,
           const Pooling& pooling) {
  if (samples.empty()) {
    throw std::invalid_argument(
        "rheology table: there are no samples; at least one is needed to make a law");
  }
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const RheologySample& s = samples[i];
    const auto positive = [&](double value, const char* name) {
      require(std::isfinite(value) && value > 0, fmt::format("{} of sample {}", name, i + 1), value,
              "positive");
    };
    positive(s.shear_rate, "shear rate [1/s]");
    positive(s.viscosity, "viscosity [Pa s]");
    require(std::isfinite(s.viscosity_error) && s.viscosity_error >= 0,
            fmt::format("standard error [Pa s] of sample {}", i + 1), s.viscosity_error,
            "finite, zero or positive");
    require(std::isfinite(s.hematocrit) && s.hematocrit >= 0,
            fmt::format("hematocrit of sample {}", i + 1), s.hematocrit, "zero or positive");
    require(s.dimension == samples[0].dimension, fmt::format("dimension of sample {}", i + 1),
            s.dimension, "that of the first sample: 2-D viscosity is not 3-D viscosity");
  }
  require(bounds.lowest_viscosity >= 0, "lowest viscosity [Pa s]", bounds.lowest_viscosity,
          "zero or positive");
  require(bounds.highest_viscosity > bounds.lowest_viscosity, "highest viscosity [Pa s]",
          bounds.highest_viscosity, "above the lowest one");
  require(bounds.steepest_slope > -1 && bounds.steepest_slope < 0, "steepest slope",
          bounds.steepest_slope, "between -1 and 0");
  require(pooling.shear_ratio >= 1, "ratio of pooled shear rates", pooling.shear_ratio,
          "at least 1");
  require(pooling.hematocrit >= 0, "width of a row in hematocrit", pooling.hematocrit,
          "zero or positive");
}

// Half-widths after the monotone fit. If every raw value errs by at most h, the fitted value of
// knot i in a block errs by at most the larger of the weighted means of h from the begin of the
// block to i and from i to its end (derivation in the README).
std::vector<double> widths_after_fit(const std::vector<Uncertain>& half_widths,
                                     const MonotoneFit& fit) {
  std::vector<double> result;
  for (std::size_t i = 0; i < half_widths.size(); ++i) {
    result.push_back(std::max(weighted_mean(half_widths, fit.block_begin[i], i),
                              weighted_mean(half_widths, i, fit.block_end[i] - 1)));
  }
  return result;
}

MonotoneFit no_fit(const std::vector<Uncertain>& values) {
  MonotoneFit fit;
  for (std::size_t i = 0; i < values.size(); ++i) {
    fit.values.push_back(values[i].value);
    fit.block_begin.push_back(i);
    fit.block_end.push_back(i + 1);
  }
  return fit;
}

bool is_inside(const macro::ViscosityRow& row, double shear_rate) {
  return shear_rate >= row.shear_rates.front() * (1 - rounding) &&
         shear_rate <= row.shear_rates.back() * (1 + rounding);
}

// Between two knots: the larger of their half-widths, and s (1 - s) more because the slopes of the
// cubic are uncertain too; s is the position between the knots (see the README).
double width_in_row(const macro::ViscosityRow& row, const std::vector<double>& widths,
                    double shear_rate) {
  const std::vector<double>& rates = row.shear_rates;
  const auto above = std::lower_bound(rates.begin(), rates.end(), shear_rate);
  if (above == rates.end()) return widths.back();  // by rounding
  const auto j = static_cast<std::size_t>(above - rates.begin());
  if (*above == shear_rate || j == 0) return widths[j];
  const double s = std::log(shear_rate / rates[j - 1]) / std::log(rates[j] / rates[j - 1]);
  return std::max(widths[j - 1], widths[j]) * (1 + s * (1 - s));
}

// The rows whose values make the law at a hematocrit: first and last of them; none if it lies
// outside the rows by more than the width of one.
std::pair<std::size_t, std::size_t> rows_around(const std::vector<macro::ViscosityRow>& rows,
                                                double hematocrit, double width) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (std::abs(rows[i].hematocrit - hematocrit) <= width) return {i, i + 1};
    if (i + 1 < rows.size() && rows[i].hematocrit < hematocrit &&
        hematocrit < rows[i + 1].hematocrit - width) {
      return {i, i + 2};
    }
  }
  return {0, 0};
}

// One row of the law with what is known of its knots.
struct FittedRow {
  macro::ViscosityRow row;
  std::vector<Knot> knots;
  MonotoneFit monotone;
  int moved_by_bounds = 0;
};

FittedRow fit_row(const std::vector<SampleGroup>& groups, const FitBounds& bounds) {
  FittedRow result;
  result.row.hematocrit = mean_hematocrit(groups);
  std::vector<Uncertain> values;
  for (const SampleGroup& group : groups) {
    result.knots.push_back(pool(group));
    result.row.shear_rates.push_back(result.knots.back().shear_rate);
    values.push_back(result.knots.back().log_viscosity);
  }
  result.monotone = bounds.shear_thinning ? fit_not_increasing(values) : no_fit(values);
  for (const double value : result.monotone.values) {
    const double viscosity = std::exp(value);
    const double bounded = std::clamp(viscosity, bounds.lowest_viscosity, bounds.highest_viscosity);
    result.row.viscosities.push_back(bounded);
    result.moved_by_bounds += bounded != viscosity;
  }
  return result;
}

// The knot whose interval to the next one falls most steeply, if that is too steep.
std::optional<std::size_t> too_steep(const macro::ViscosityRow& row, double steepest_slope) {
  const macro::ViscosityLaw law(macro::ViscosityTable({row}));
  constexpr int probes = 16;  // in each interval, of a slope that is quadratic there
  std::optional<std::size_t> worst;
  double steepest = steepest_slope;
  for (std::size_t i = 0; i + 1 < row.shear_rates.size(); ++i) {
    const double ratio = row.shear_rates[i + 1] / row.shear_rates[i];
    for (int k = 1; k < probes; ++k) {
      const double rate = row.shear_rates[i] * std::pow(ratio, double(k) / probes);
      const double slope = law.logarithmic_slope(rate, row.hematocrit);
      if (slope < steepest) {
        steepest = slope;
        worst = i;
      }
    }
  }
  return worst;
}

std::vector<double> half_widths(const FittedRow& fitted, double probability) {
  std::vector<Uncertain> raw;  // with the errors of the values, for their weights
  for (const Knot& knot : fitted.knots) {
    const double error = knot.log_viscosity.error;
    raw.push_back(
        {error == 0 ? 0 : error * student_t_half_width(probability, knot.degrees_of_freedom),
         error});
  }
  return widths_after_fit(raw, fitted.monotone);
}

}  // namespace

double degrees_of_freedom(const RheologySample& sample) {
  return sample.effective_samples / 4;
}

struct RheologyTable::Fit {
  std::vector<macro::ViscosityRow> rows;
  std::vector<std::vector<double>> log_errors;
  std::vector<std::vector<double>> log_half_widths;
  int moved_by_bounds = 0;
  int pooled_by_monotonicity = 0;
  int merged_for_rising_stress = 0;
};

RheologyTable::Fit RheologyTable::fit(const std::vector<RheologySample>& samples,
                                      const FitBounds& bounds, const Pooling& pooling) {
  check(samples, bounds, pooling);
  Fit result;
  std::vector<FittedRow> rows;
  int knots = 0;
  for (std::vector<SampleGroup>& groups : groups_by_row(samples, pooling)) {
    rows.push_back(fit_row(groups, bounds));
    while (const auto steep = too_steep(rows.back().row, bounds.steepest_slope)) {
      SampleGroup& merged = groups[*steep];
      const auto next = groups.begin() + static_cast<std::ptrdiff_t>(*steep) + 1;
      merged.insert(merged.end(), next->begin(), next->end());
      groups.erase(next);
      ++result.merged_for_rising_stress;
      rows.back() = fit_row(groups, bounds);
    }
    knots += static_cast<int>(groups.size());
  }
  const double probability = sidak_probability(confidence, knots);
  for (FittedRow& row : rows) {
    result.log_half_widths.push_back(half_widths(row, probability));
    result.log_errors.emplace_back();
    for (std::size_t i = 0; i < row.knots.size(); ++i) {
      result.log_errors.back().push_back(row.knots[i].log_viscosity.error);
      result.pooled_by_monotonicity += row.monotone.block_end[i] - row.monotone.block_begin[i] > 1;
    }
    result.moved_by_bounds += row.moved_by_bounds;
    result.rows.push_back(std::move(row.row));
  }
  return result;
}

RheologyTable::RheologyTable(std::vector<RheologySample> samples, const FitBounds& bounds,
                             const Pooling& pooling)
    : RheologyTable(samples, pooling, fit(samples, bounds, pooling)) {}

RheologyTable::RheologyTable(std::vector<RheologySample> samples, const Pooling& pooling, Fit fit)
    : samples_(std::move(samples)),
      pooling_(pooling),
      rows_(std::move(fit.rows)),
      log_errors_(std::move(fit.log_errors)),
      log_half_widths_(std::move(fit.log_half_widths)),
      law_(macro::ViscosityTable(rows_)),
      knots_moved_by_bounds_(fit.moved_by_bounds),
      knots_pooled_by_monotonicity_(fit.pooled_by_monotonicity),
      knots_merged_for_rising_stress_(fit.merged_for_rising_stress) {}

bool RheologyTable::is_trusted(double shear_rate, double hematocrit) const {
  const auto [first, last] = rows_around(rows_, hematocrit, pooling_.hematocrit);
  if (first == last) return false;
  for (std::size_t r = first; r < last; ++r) {
    if (!is_inside(rows_[r], shear_rate)) return false;
  }
  return true;
}

double RheologyTable::log_half_width(double shear_rate, double hematocrit) const {
  if (!is_trusted(shear_rate, hematocrit)) return infinity;
  const auto [first, last] = rows_around(rows_, hematocrit, pooling_.hematocrit);
  double widest = 0;
  for (std::size_t r = first; r < last; ++r) {
    widest = std::max(widest, width_in_row(rows_[r], log_half_widths_[r], shear_rate));
  }
  return widest;
}

}  // namespace hemoscale::coupling
