#pragma once

#include <limits>
#include <string>
#include <vector>

#include "coupling/study/study.hpp"

namespace hemoscale::coupling {

/// One run of a case, before it is made.
struct PlannedRun {
  std::filesystem::path case_folder;
  std::string variant;
  std::vector<Override> overrides;  // each key once
  bool force = false;
  std::string label;     // for the user, e.g. "paper, spacing 2 um"
  std::string identity;  // sixteen digits that stand for settings, program and number of threads
};

/// A run with its place on the refinement axis.
struct PlannedPoint {
  PlannedRun run;
  double refinement = std::numeric_limits<double>::quiet_NaN();  // SI; nan without an axis
};

/// The runs of one series with one combination of the swept values.
struct Curve {
  std::string name;                  // for the legend, e.g. "paper, kernel_radius 2.1"
  std::string series;                // its name
  std::vector<std::string> swept;    // values, in the order of Plan::swept_keys
  std::vector<PlannedPoint> points;  // in the order of the refinement axis
};

/// All runs of a chart.
struct Plan {
  std::vector<std::string> swept_keys;  // "case" first if there are several cases
  std::string refinement_key;           // empty if there is no such axis
  std::string refinement_unit;          // "-" for a pure number
  std::vector<Curve> curves;
};

/// The runs of a chart; every one is checked as `hemoscale check` would.
/// @throws CaseError with the faults of all runs
Plan plan_chart(const Study& study);

/// One search for a boundary.
struct MapCurve {
  std::string name;
  std::string series;
  std::vector<std::string> swept;
  std::vector<Step> along;  // one search each; a single empty step without such an axis
  std::vector<std::string> along_texts;  // as the user wrote it
  std::vector<double> abscissas;         // SI; nan if it is no number
  PlannedRun base;                       // without the keys of the axis and of the map
};

struct MapPlan {
  std::vector<std::string> swept_keys;
  std::string along_key;  // empty if there is no such axis
  std::string along_unit;
  std::vector<MapCurve> curves;
};

/// The searches of a map; their runs are checked at both ends of the key of the map.
/// @throws CaseError with the faults of all
MapPlan plan_map(const Study& study);

/// A run of a map: the boundary is asked beyond limits, so that it is forced.
PlannedRun probe(const Study& study, const MapCurve& curve, std::size_t along, double value);

}  // namespace hemoscale::coupling
