#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "coupling/report/series.hpp"
#include "coupling/report/summary.hpp"
#include "coupling/scene/build_feed.hpp"

namespace hemoscale::coupling {

/// The moment from which cells are counted at the outlets, and what had left until then.
struct FeedTally {
  bool has_begun = false;
  double since = 0;                                // [s]
  std::vector<std::vector<std::uint64_t>> before;  // [kind][outlet]

  void begin(double time, const std::vector<micro::FeedCounts>& counts);
  micro::Snapshot snapshot() const;
  /// @throws micro::ParameterError if the snapshot is none of so many kinds and outlets
  void restore(const micro::Snapshot& snapshot, std::size_t kinds, std::size_t outlets);
};

/// How the cells of one kind divide at the outlets, since the tally began.
///
///   cell share       cells that left through an outlet over all that left
///   partition        cell share over flow share: 1 where cells follow the plasma, above 1 in the
///                    branch that draws more than its part [Svanes and Zweifach 1968; Fung 1973]
///   discharge        area of the cells that left over area of the blood that did, a hematocrit
///
/// Not numbers where nothing has left. The standard error of a share p of n cells is that of
/// independent ones, sqrt(p (1 - p)/n): an order of magnitude, because neighbours do not choose
/// their branch independently. The spread over seeds is the measure.
struct FeedDivision {
  std::vector<std::uint64_t> counted;  // [outlet]
  std::vector<double> cell_share, standard_error, partition, discharge;
};
FeedDivision divide(const FeedScene& scene, const FeedTally& tally,
                    const std::vector<micro::FeedCounts>& counts, std::size_t kind, double time);

/// Tables of a vessel through which cells pass:
///
///   series.csv   one row per output time
///   places.csv   one row per output time and cell: number, kind, centre; cells come and go
///   walls.csv    the walls, continued beyond the openings
///   tables.txt   what the tables hold, and what the model does not
///   frames/cells-NNNNNN.h5   outlines at output N: H5MD files of one frame, because a trajectory
///                            holds one number of nodes; rings in the order of places.csv
///
/// Quantities of the first kind have plain names, those of others begin with the kind.
class FeedResults {
 public:
  /// @param scene  outlives this object
  /// @param restarted_at  [s] rows up to this time are kept; none: new files
  /// @throws EnvironmentError
  FeedResults(std::filesystem::path results, const FeedScene& scene, bool with_frames,
              const std::vector<std::string>& statements, std::optional<double> restarted_at);

  /// @param number  of the output, from 0
  void append(std::int64_t number, const micro::BlockEnsemble& ensemble,
              const micro::CellFeed& feed, const FeedTally& tally);

  /// What a row would hold, then how cells divided, with standard errors.
  std::vector<Figure> figures(const micro::BlockEnsemble& ensemble, const micro::CellFeed& feed,
                              const FeedTally& tally) const;

 private:
  std::vector<Column> columns() const;
  std::vector<double> row(const micro::BlockEnsemble& ensemble, const micro::CellFeed& feed,
                          const FeedTally& tally) const;
  void append_places(const micro::BlockEnsemble& ensemble);
  void write_frame(std::int64_t number, const micro::BlockEnsemble& ensemble) const;

  std::filesystem::path results_;
  const FeedScene& scene_;
  bool with_frames_ = true;
  SeriesWriter series_;
  SeriesWriter places_;
};

}  // namespace hemoscale::coupling
