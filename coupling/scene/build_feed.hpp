#pragma once

#include <vector>

#include "coupling/config/settings.hpp"
#include "coupling/scene/build_blocks.hpp"
#include "micro/ensemble/packing/cell_feed.hpp"

namespace hemoscale::coupling {

/// An ensemble in a vessel with an inlet and outlets, ready to be fed.
struct FeedScene {
  BlockScene blocks;
  micro::FeedPlan plan;
  double inflow = 0;                // [m^2/s] of blood through the inlet
  std::vector<double> flow_shares;  // [-] of the outlets in it, in the order of the plan
  double fluid_area = 0;            // [m^2] between the openings

  /// Whether a place (the centre of a cell) lies beyond none of the openings.
  bool is_inside(const micro::Vector<2>& place) const;
};

/// What contradicts itself in a case with the domain geometry, before its flow is known: one entry
/// for each key, with a message.
std::vector<std::pair<std::string, std::string>> feed_faults(const Settings& settings);

/// Red cells enter at the hematocrit of the case; platelets, the second kind, so that as many of
/// them as micro.platelets.per_cell go with each.
/// @throws what build_blocks throws; CaseError for a step or an inlet that do not fit the cells
FeedScene build_feed(const Settings& settings, int threads, bool force,
                     const std::filesystem::path& case_folder,
                     const std::filesystem::path& results);

}  // namespace hemoscale::coupling
