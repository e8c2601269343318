#include "macro/viscosity/viscosity_table.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "macro/error.hpp"
#include "macro/parameter_check.hpp"
#include "macro/viscosity/monotone_slopes.hpp"

namespace hemoscale::macro {

namespace {

std::string entry(const char* list, std::size_t index) {
  return std::string(list) + "[" + std::to_string(index) + "]";
}

void check_row(const ViscosityRow& row, const std::string& owner) {
  if (row.shear_rates.empty()) {
    throw ParameterError(owner +
                         ": shear_rates is empty; allowed: at least one knot; remove the row or "
                         "give a shear rate and a viscosity");
  }
  if (row.viscosities.size() != row.shear_rates.size()) {
    throw ParameterError(owner + ": " + std::to_string(row.viscosities.size()) +
                         " viscosities for " + std::to_string(row.shear_rates.size()) +
                         " shear rates; allowed: as many as shear rates; complete the row");
  }
  for (std::size_t i = 0; i < row.shear_rates.size(); ++i) {
    require_positive({owner, entry("shear_rates", i), row.shear_rates[i], "1/s"},
                     "a knot at rest is not needed: the value at the first knot is held below it");
    require_positive({owner, entry("viscosities", i), row.viscosities[i], "Pa s"},
                     "give the dynamic viscosity in Pa s");
    // Compared as logarithms: two knots must remain two after taking them.
    require(i == 0 || std::log(row.shear_rates[i]) > std::log(row.shear_rates[i - 1]),
            {owner, entry("shear_rates", i), row.shear_rates[i], "1/s"},
            "above the shear rate before it", "sort the knots and merge those that coincide");
  }
}

std::vector<double> logarithms(const std::vector<double>& values) {
  std::vector<double> logs;
  logs.reserve(values.size());
  for (const double value : values) logs.push_back(std::log(value));
  return logs;
}

}  // namespace

ViscosityTable::ViscosityTable(std::vector<ViscosityRow> rows) : rows_(std::move(rows)) {
  if (rows_.empty()) {
    throw ParameterError(
        "viscosity table: there are no rows; allowed: at least one; give one row for each "
        "hematocrit");
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const ViscosityRow& row = rows_[i];
    const std::string owner = "viscosity table, row " + std::to_string(i);
    require(row.hematocrit >= 0 && row.hematocrit < 1, {owner, "hematocrit", row.hematocrit, "-"},
            "0 to less than 1", "give a volume fraction, not a percentage");
    require(i == 0 || row.hematocrit > rows_[i - 1].hematocrit,
            {owner, "hematocrit", row.hematocrit, "-"}, "above the hematocrit of the row before it",
            "sort the rows and merge those of equal hematocrit");
    check_row(row, owner);
    Knots knots{logarithms(row.shear_rates), logarithms(row.viscosities), {}};
    knots.slopes = monotone_slopes(knots.x, knots.y);
    knots_.push_back(std::move(knots));
  }
}

ViscosityTable::Blend ViscosityTable::blend(double hematocrit) const {
  const std::size_t last = rows_.size() - 1;
  if (last == 0 || hematocrit <= rows_.front().hematocrit) return {0, 0, 0};
  if (hematocrit >= rows_.back().hematocrit) return {last, last, 0};
  std::size_t upper = 1;
  while (upper < last && rows_[upper].hematocrit <= hematocrit) ++upper;
  const double below = rows_[upper - 1].hematocrit;
  if (hematocrit == below) return {upper - 1, upper - 1, 0};
  return {upper - 1, upper, (hematocrit - below) / (rows_[upper].hematocrit - below)};
}

ViscosityTable::Value ViscosityTable::along_row(const Knots& knots, double shear_rate) {
  if (shear_rate <= 0) return {knots.y.front(), 0};
  const double x = std::log(shear_rate);
  if (x < knots.x.front()) return {knots.y.front(), 0};
  if (x > knots.x.back()) return {knots.y.back(), 0};
  if (knots.x.size() == 1) return {knots.y.front(), 0};
  // NaN falls through to the first interval and stays NaN.
  const auto above = std::upper_bound(knots.x.begin() + 1, knots.x.end() - 1, x);
  const std::size_t i = static_cast<std::size_t>(above - knots.x.begin()) - 1;
  const double h = knots.x[i + 1] - knots.x[i];
  const double secant = (knots.y[i + 1] - knots.y[i]) / h;
  const double quadratic = (3 * secant - 2 * knots.slopes[i] - knots.slopes[i + 1]) / h;
  const double cubic = (knots.slopes[i] + knots.slopes[i + 1] - 2 * secant) / (h * h);
  const double s = x - knots.x[i];
  return {knots.y[i] + s * (knots.slopes[i] + s * (quadratic + s * cubic)),
          knots.slopes[i] + s * (2 * quadratic + s * 3 * cubic)};
}

ViscosityTable::Value ViscosityTable::between_rows(double shear_rate, double hematocrit) const {
  const Blend rows = blend(hematocrit);
  const Value lower = along_row(knots_[rows.lower], shear_rate);
  if (rows.lower == rows.upper) return lower;
  const Value upper = along_row(knots_[rows.upper], shear_rate);
  return {(1 - rows.weight) * lower.y + rows.weight * upper.y,
          (1 - rows.weight) * lower.slope + rows.weight * upper.slope};
}

double ViscosityTable::viscosity(double shear_rate, double hematocrit) const {
  return std::exp(between_rows(shear_rate, hematocrit).y);
}

double ViscosityTable::logarithmic_slope(double shear_rate, double hematocrit) const {
  return between_rows(shear_rate, hematocrit).slope;
}

bool ViscosityTable::in_range(double shear_rate, double hematocrit) const {
  if (!(hematocrit >= rows_.front().hematocrit && hematocrit <= rows_.back().hematocrit)) {
    return false;
  }
  const Blend rows = blend(hematocrit);
  for (const std::size_t i : {rows.lower, rows.upper}) {
    const std::vector<double>& knots = rows_[i].shear_rates;
    if (!(shear_rate >= knots.front() && shear_rate <= knots.back())) return false;
  }
  return true;
}

}  // namespace hemoscale::macro
