#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <vector>

#include "micro/immersed/cell.hpp"
#include "micro/immersed/membrane_watch.hpp"
#include "micro/immersed/ring_step.hpp"
#include "micro/immersed/secant_map.hpp"
#include "micro/immersed/surrounding_flow.hpp"
#include "micro/model.hpp"

namespace hemoscale::micro {

struct ImplicitOptions {
  double longest_step = 0;  // [s] positive

  /// How far a node may end from where its way so far leads it, over the radius of its cell: the
  /// length of the steps follows. 0: all steps have the longest length.
  double step_tolerance = 0.005;  // [-]

  /// Change of the velocities by walls and other cells that ends the sweeps of a step, over the
  /// largest speed.
  double sweep_tolerance = 3e-4;  // [-]
  int most_sweeps = 60;

  MembraneThresholds thresholds = {.strain = 100, .area = 0.05, .node_step = 1e6};
};

/// What was done since the start.
struct ImplicitCounters {
  std::int64_t steps = 0;
  std::int64_t refused = 0;         // steps that were too long, done again in shorter ones
  std::int64_t sweeps = 0;          // solutions of the surrounding flow
  std::int64_t factorisations = 0;  // of a Newton matrix
};

/// Cells in quasi-steady Stokes flow, advanced implicitly: steps are limited by the motion of the
/// cells alone, whatever their stiffness.
///
/// The flow is split: every membrane moves the fluid as in free space, by boundary integrals of
/// spectral accuracy [Pozrikidis1992]; the nodes of the plasma carry what is smooth, the flow
/// without cells and the reaction of the boundaries. At a membrane with viscosity ratio lambda
///
///   (1 + lambda)/2 u = u_flow + u_reaction + sum over cells [ S F + (1 - lambda) D u ].
///
/// Time: backward differences of second order with steps of variable length (the first: Euler); the
/// linear operators are those of the extrapolated configuration, the forces those of the new one,
/// found by Newton's method with the ring's own mobility (see RingStep). What walls and other cells
/// add is iterated; the map from the forces of a cell to it is learned on the way (SecantMap), so
/// that most steps need one solution of the surrounding flow.
class ImplicitMembranes {
 public:
  /// @throws ParameterError for cells or options that are not admissible
  ImplicitMembranes(std::shared_ptr<const Surroundings> surroundings, std::vector<Cell> cells,
                    const ImplicitOptions& options);

  /// @throws NumericalError naming step, time and cell; the state is then that before the step that
  ///         failed
  void advance_by(double duration);

  const std::vector<Cell>& cells() const { return cells_; }
  const std::vector<double>& tensions(std::size_t cell) const {
    return rings_[cell].unknowns.tensions;
  }
  const Surroundings& surroundings() const { return *surroundings_; }
  const ImplicitOptions& options() const { return options_; }
  double time() const { return time_; }
  double last_step() const { return last_step_; }  // [s] 0 before the first
  const ImplicitCounters& counters() const { return counters_; }

  /// Speed along the normals that kept the area of a cell in the last step [m/s]: what the discrete
  /// flow leaks.
  double leak(std::size_t cell) const { return rings_[cell].unknowns.leak; }

  /// What the cells added to the pressure drop in the last step, see Surroundings [Pa].
  double extra_pressure_drop() const { return extra_pressure_drop_; }

  /// The cells as sources of flow, where they are now.
  std::vector<RingSource> sources() const;

  Snapshot snapshot() const;

  /// @throws ParameterError if the snapshot does not belong to such a run
  void restore(const Snapshot& snapshot);

 private:
  /// Forces and the velocities by walls and other cells that went with them.
  struct Answer {
    Eigen::VectorXd forces;    // [N/m] over (x_0, y_0, x_1, ...); empty: none yet
    Eigen::VectorXd velocity;  // [m/s]
    double time = 0;           // [s]
  };

  /// What belongs to one cell besides its place.
  struct Ring {
    RingQuadrature quadrature;
    std::shared_ptr<const RingMembrane> resistance;  // the laws but stretch
    std::vector<double> compliances;                 // [m/N]
    std::vector<Vector<2>> before;                   // [m] positions one step ago; empty at first
    RingUnknowns unknowns;
    std::vector<double> tensions_before;  // [N/m]
    SecantMap map;
    std::vector<Answer> answers;  // of the last steps, at most three, the newest first
  };
  struct Stage;  // of one cell during a step

  bool step(double dt);
  void attempt(double dt, std::vector<Stage>& stages);
  Stage prepare(std::size_t cell, double dt) const;
  void move(std::size_t cell, Stage& stage);
  double answer(std::vector<Stage>& stages);
  double deviation(const std::vector<Stage>& stages) const;
  double first_step(double duration) const;
  void watch() const;

  std::shared_ptr<const Surroundings> surroundings_;
  std::vector<Cell> cells_;
  std::vector<Ring> rings_;
  ImplicitOptions options_;
  MembraneBounds bounds_;
  double time_ = 0;                 // [s]
  double last_step_ = 0;            // [s] 0: none
  double next_step_ = 0;            // [s] 0: not known
  double extra_pressure_drop_ = 0;  // [Pa]
  ImplicitCounters counters_;
};

}  // namespace hemoscale::micro
