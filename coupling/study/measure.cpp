#include "coupling/study/measure.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "coupling/config/nearest_key.hpp"
#include "coupling/config/read_value.hpp"
#include "coupling/error.hpp"

namespace hemoscale::coupling {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

double relative_difference(double value, double reference) {
  return std::abs(value - reference) / std::abs(reference);
}

/// The run that another one is compared with; null if there is none.
const Measured* finest_for(const Measured& run, const ErrorMeasure& measure,
                           const std::vector<Measured>& runs) {
  const std::string& series = measure.series.empty() ? run.series : measure.series;
  for (const Measured& other : runs) {
    if (other.is_finest && other.series == series && other.family == run.family) return &other;
  }
  return nullptr;
}

}  // namespace

const Figure& figure_of(const Summary& summary, const std::string& name, const Location& asked_at,
                        const std::string& key, const std::string& run) {
  std::vector<std::string> names;
  for (const Figure& figure : summary.figures) {
    if (figure.name == name) return figure;
    names.push_back(figure.name);
  }
  throw CaseError(
      {{asked_at.file, asked_at.line, asked_at.column, key,
        fmt::format("the run \"{}\" has no figure {}; the nearest is \"{}\"; it has: {}", run,
                    shown(name), nearest_word(name, names), fmt::join(names, ", "))}});
}

std::vector<double> errors_of(const ErrorMeasure& measure, const std::vector<Measured>& runs) {
  std::vector<double> errors;
  for (const Measured& run : runs) {
    switch (measure.against) {
      case ErrorMeasure::Against::itself:
        errors.push_back(std::abs(run.value));
        break;
      case ErrorMeasure::Against::number:
        errors.push_back(relative_difference(run.value, measure.reference));
        break;
      case ErrorMeasure::Against::finest: {
        const Measured* finest = finest_for(run, measure, runs);
        if (finest != nullptr && finest->value == 0) {
          throw CaseError({{measure.location.file, measure.location.line, measure.location.column,
                            "error.figure",
                            shown(measure.figure) +
                                " is 0 in the finest run, so that there is no relative difference "
                                "to it; chart another figure"}});
        }
        errors.push_back(finest == nullptr || finest == &run
                             ? none
                             : relative_difference(run.value, finest->value));
        break;
      }
    }
  }
  return errors;
}

}  // namespace hemoscale::coupling
