#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "micro/ensemble/box.hpp"
#include "micro/ensemble/flow/given_flow.hpp"
#include "micro/ensemble/neighbour_list.hpp"
#include "micro/ensemble/observables/cell_flux.hpp"
#include "micro/ensemble/observables/cell_free_layer.hpp"
#include "micro/ensemble/observables/contacts.hpp"
#include "micro/ensemble/observables/lateral.hpp"
#include "micro/ensemble/observables/lateral_average.hpp"
#include "micro/ensemble/observables/moment_balance.hpp"
#include "micro/ensemble/observables/node_forces.hpp"
#include "micro/ensemble/observables/orientation.hpp"
#include "micro/ensemble/observables/passages.hpp"
#include "micro/model.hpp"

namespace hemoscale::micro {

/// One kind of cells: what their observables are measured against.
struct ObservedKind {
  std::string name = "red cells";  // or "platelets"
  double rest_area = 0;            // [m^2]
  double rest_perimeter = 0;       // [m]
  double node_drag = 0;            // [Pa s] zeta
  PairLaw law;                     // of contact within the kind
};

struct ObserverOptions {
  std::size_t bins = 75;           // [-] of the profiles, from wall to wall
  std::size_t distance_bins = 10;  // [-] of the histogram of centres, from axis to wall
  double column_width = 1e-6;      // [m] of the envelope
  double average_from = 0;         // [s] earlier samples do not enter the averages
  bool is_straight = true;         // a channel between two plane walls; else no profiles across it
  std::vector<CountedSection> sections = {};
  double period = 0;  // [m] of the domain along x, for the sections; 0: none
};

/// The nodes of all cells at a sample.
struct ObservedNodes {
  NodeForces forces;
  std::span<const double> velocity_x, velocity_y;  // [m/s] empty: flow + forces over drag
  std::span<const std::int64_t> identities;        // of the cells; empty: their numbers
};

/// What makes sense only across a straight channel.
struct LateralSample {
  LateralMoments moments;
  MomentBalance balance;
  std::optional<EnvelopeLayer> envelope;     // cell-free layer by the envelope
  std::optional<double> half_core_distance;  // [m] cell-free layer by half the core's area fraction
  Hematocrits hematocrits;
  double shear_stress =
      0;  // [Pa] of the cells, mean of Sigma_xy below and -Sigma_xy above the axis
  double normal_stress = 0;             // [Pa] mean of Sigma_yy
  std::vector<double> area_fractions;   // [-] by bin
  std::vector<double> distance_shares;  // [-] by bin of the distance from the axis
};

/// What is seen of one kind at one time.
struct EnsembleSample {
  double time = 0;  // [s]
  std::size_t cells = 0;
  double area_fraction = 0;             // [-] of the box
  double speed = 0;                     // [m/s] mean over cells of the speed of the centroid
  Orientation orientation;              //
  double deformation = 0;               // [-] Taylor's, mean over cells
  double mean_area_strain = 0;          // [-] mean of |A/A0 - 1|
  double largest_area_strain = 0;       // [-]
  double mean_perimeter_strain = 0;     // [-] mean of |P/P0 - 1|
  double largest_perimeter_strain = 0;  // [-]
  Contacts contacts;
  std::vector<Passages> passages;        // by section
  std::optional<LateralSample> lateral;  // straight channels only
};

/// One cell at the last sample.
struct CellRecord {
  CellShape shape;
  CellMotion motion;
  Tensor<2> stresslet = Tensor<2>::Zero();  // [N] of the membrane; zero if its forces are not given
  double area_strain = 0;                   // [-] A/A0 - 1
  double perimeter_strain = 0;              // [-]
};

/// Observes one kind of cells of an ensemble: a sample at each output time, averages at the end. It
/// changes nothing and depends on the samples alone, whichever scheme moved the cells. Every kind
/// has its own observer; contacts between kinds enter by their forces.
class EnsembleObserver {
 public:
  /// @throws ParameterError for fewer than 2 bins, columns without width, a kind without area,
  ///         perimeter or drag
  EnsembleObserver(ObservedKind kind, ObserverOptions options);

  /// @param flow  at the time of the state; its transport must be along x in a straight channel
  /// @throws NumericalError if a cell is inside out, torn, or outside the channel
  const EnsembleSample& sample(const EnsembleState& state, const Box& box, const GivenFlow& flow,
                               const ObservedNodes& nodes);

  const EnsembleSample& last() const { return last_; }
  const std::vector<CellRecord>& cells() const { return records_; }
  const LateralAverage& average() const { return average_; }
  const ObservedKind& kind() const { return kind_; }
  const ObserverOptions& options() const { return options_; }

  /// Averages and passages so far: a restart continues with the same numbers.
  Snapshot snapshot() const;
  /// @throws ParameterError if it is not that of such an observer
  void restore(const Snapshot& snapshot);

 private:
  void record_cells(const EnsembleState& state, const ObservedNodes& nodes,
                    std::span<const CellShape> shapes, std::span<const CellMotion> motions);
  LateralSample sample_lateral(const EnsembleState& state, const Box& box, const GivenFlow& flow,
                               const NodeForces& forces, const PairParts& pairs,
                               std::span<const double> flow_y, std::span<const CellShape> shapes,
                               std::span<const CellMotion> motions);
  /// Adds what was seen, nothing in an empty channel, and the flow to the profiles.
  void average(LateralContribution contribution, const EnsembleState& state, const Box& box,
               const GivenFlow& flow);

  ObservedKind kind_;
  ObserverOptions options_;
  PassageCounter passages_;
  NeighbourList list_;
  EnsembleSample last_;
  std::vector<CellRecord> records_;
  LateralAverage average_;
};

}  // namespace hemoscale::micro
