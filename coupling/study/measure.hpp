#pragma once

#include <string>
#include <vector>

#include "coupling/report/summary.hpp"
#include "coupling/study/study.hpp"

namespace hemoscale::coupling {

/// The figure of that name.
/// @param asked_at  where the study names it
/// @param run       of which the summary is, for the message
/// @throws CaseError with the nearest name and all names if there is none
const Figure& figure_of(const Summary& summary, const std::string& name, const Location& asked_at,
                        const std::string& key, const std::string& run);

/// A run as far as its error is concerned.
struct Measured {
  std::string series;
  std::string family;  // the swept values: runs of one family share a reference
  bool is_finest = false;
  double value = 0;  // of the figure; nan if the run has none
};

/// The error of every run: |value|, or |value - reference| / |reference|. Runs without a value, the
/// reference itself, and runs whose reference has no value have none (nan).
/// @throws CaseError if the value of a reference is 0
std::vector<double> errors_of(const ErrorMeasure& measure, const std::vector<Measured>& runs);

}  // namespace hemoscale::coupling
