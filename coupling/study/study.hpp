#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "coupling/config/read_case.hpp"

namespace hemoscale::coupling {

/// One value of an axis: the key of the axis first, then keys that change along with it.
using Step = std::vector<Override>;

/// Values of one key, in the order in which they are run.
struct Axis {
  std::string key;
  Location location;
  std::vector<Step> steps;
};

/// Runs in which every one of these keys has this value are left out.
struct Skip {
  Location location;
  std::vector<Override> matches;
};

/// One curve of the chart; with sweeps, one family of curves.
struct Series {
  std::string name;  // may be empty if there is one series
  Location location;
  std::vector<Override> set;
  std::optional<Axis> refine;  // instead of the study's
  std::vector<Skip> skip;
};

/// What the error of a run is.
struct ErrorMeasure {
  enum class Against {
    itself,  // the figure is the error
    finest,  // relative difference to the run with the last value of the refinement axis
    number   // relative difference to a known value
  };
  std::string figure;  // name in summary.json
  Location location;
  Against against = Against::itself;
  double reference = 0;  // SI, in the unit of the figure; not 0
  std::string series;    // whose finest run; empty: each series its own
};

/// Where along one key the runs cease to be stable.
struct MapQuestion {
  std::string key;
  std::string unit;  // SI; "-" for a pure number
  Location location;
  double stable = 0;        // [unit] runs here
  double unstable = 0;      // [unit] and fails here
  double tolerance = 0.02;  // [-] the boundary is bracketed within a factor of 1 + tolerance
  std::string predicted;    // figure of the stable runs, in the unit of the key; may be empty
  std::optional<Axis> along;
};

/// A study file: runs of a case with different options, and what is asked of them.
struct Study {
  std::string name;
  std::filesystem::path file;
  std::filesystem::path folder;              // of the file
  std::vector<std::filesystem::path> cases;  // at least one
  std::string variant;
  std::vector<Override> set;  // of every run
  int repeats = 1;            // [-] of every run; its time is the smallest
  int threads = 1;            // [-] of a run
  double longest = std::numeric_limits<double>::infinity();  // [s] wall, of a run
  bool force = false;                                        // beyond a stability limit
  std::vector<Skip> skip;
  std::optional<ErrorMeasure> error;
  std::vector<Series> series;  // at least one
  std::optional<Axis> refine;
  std::vector<Axis> sweeps;
  std::optional<MapQuestion> map;
};

}  // namespace hemoscale::coupling
