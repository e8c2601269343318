#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "coupling/report/series.hpp"
#include "coupling/report/summary.hpp"
#include "micro/ensemble/observables/observer.hpp"

namespace hemoscale::coupling {

/// The observers of a run, one for each kind of cells. Quantities of the first kind have plain
/// names, those of the others begin with the name of the kind, "platelets: ".
using ObservedKinds = std::vector<const micro::EnsembleObserver*>;

/// What the names of quantities of a kind begin with: nothing for the first.
std::string kind_prefix(const ObservedKinds& kinds, std::size_t kind);

/// Columns of series.csv, and the row of the last samples; the same order. What does not exist at
/// the time, like the mean of no cells, is not a number.
std::vector<Column> ensemble_columns(const ObservedKinds& kinds);
std::vector<double> ensemble_row(const ObservedKinds& kinds);

/// Tables of the cells of an ensemble:
///
///   series.csv         one row per output time: every quantity
///   concentration.csv  one row per output time: area fraction by bin of y, share of the centres by
///                      bin of the distance from the axis; concentration-platelets.csv likewise
///   profile.csv        averages over the run by bin of y
///   red-cells.csv      one row per cell at the end; platelets.csv likewise
///   tables.txt         what the tables hold, and what the model does not
///
/// concentration.csv and profile.csv exist for straight channels only.
class EnsembleResults {
 public:
  /// @param kinds  at least one; they outlive this object
  /// @param height  [m] of the channel; not used unless it is straight
  /// @param statements  what the results are not: see `ensemble_statements`
  /// @param restarted_at  [s] rows up to this time are kept; none: new files
  /// @throws EnvironmentError
  EnsembleResults(std::filesystem::path results, ObservedKinds kinds, double height,
                  const std::vector<std::string>& statements, std::optional<double> restarted_at);

  /// Appends the last samples of all kinds.
  void append();

  /// Writes the averages, if there are any, and the cells at the end.
  void finish() const;

  /// For summary.json: the last row, and what it was at the first row of this process.
  /// @pre append() was called
  std::vector<Figure> figures() const;

 private:
  std::filesystem::path results_;
  ObservedKinds kinds_;
  SeriesWriter series_;
  std::vector<std::optional<SeriesWriter>> concentrations_;  // by kind
  std::vector<double> first_row_, last_row_;
};

/// What every result of an ensemble states.
/// @param optional_laws  names of the laws that are on although the model is defined without them,
///                       e.g. "wall lift after Olla (1997)"
std::vector<std::string> ensemble_statements(const std::vector<std::string>& optional_laws);

}  // namespace hemoscale::coupling
