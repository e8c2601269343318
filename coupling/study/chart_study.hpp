#pragma once

#include <filesystem>
#include <iosfwd>

#include "coupling/study/runner.hpp"
#include "coupling/study/study.hpp"

namespace hemoscale::coupling {

struct StudyOptions {
  RunnerOptions runner;
  std::filesystem::path script;  // chart.py
  bool list = false;             // tell what would be run, run nothing
};

/// Runs the chart of a study: error against CPU time, and observed orders. Leaves chart.csv,
/// orders.csv and chart.png in the results of the study.
/// @throws CaseError with all faults of the study, EnvironmentError
void chart_study(const Study& study, const StudyOptions& options, std::ostream& out);

/// Finds the stability boundary that the study's [map] asks for. Leaves map.csv and map.png.
/// @throws CaseError with all faults of the study, EnvironmentError
void map_study(const Study& study, const StudyOptions& options, std::ostream& out);

}  // namespace hemoscale::coupling
