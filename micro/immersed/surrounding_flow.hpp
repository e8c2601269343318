#pragma once

#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "micro/immersed/boundary_integral.hpp"
#include "micro/immersed/stokes_nodes.hpp"

namespace hemoscale::micro {

/// Linear flow without boundaries, u = velocity + gradient x.
struct UnboundedFlow {
  double viscosity = 0;                    // [Pa s] of the fluid outside the cells
  Vector<2> velocity = Vector<2>::Zero();  // [m/s] at the origin
  Tensor<2> gradient = Tensor<2>::Zero();  // [1/s] L(i,j) = d u_i / d x_j, without trace
};

/// Plasma between boundaries, on nodes.
struct BoundedFlow {
  std::shared_ptr<const StokesNodes> nodes;
  double kept_flow_rate = 0;  // [m^2/s] periodic along x: the driving force grows with the
                              // resistance of the cells so that the flow rate stays; 0: the force
                              // stays
};

/// What surrounds the cells, and how it answers them.
///
/// The reaction of the boundaries is linear in the forces of the membranes; with a kept flow rate
/// it holds the growth of the driving force, too, by the reciprocal theorem with the flow without
/// cells (u0, driven by the force f0 per volume) as test flow: without that growth the cells would
/// change the flow rate by
///
///   Q' = (1 / (f0 L)) [ sum_i F_i.u0(X_i) + (1 - lambda) closed int u.sigma0.n ds ],
///   sigma0 = f0 x I + mu (grad u0 + (grad u0)^T).
class Surroundings {
 public:
  using Flow = std::variant<UnboundedFlow, BoundedFlow>;

  /// @throws ParameterError for values that are not admissible
  explicit Surroundings(Flow flow);

  bool is_bounded() const { return std::holds_alternative<BoundedFlow>(flow_); }
  const StokesNodes* nodes() const;
  const StokesKernel& kernel() const { return kernel_; }
  double viscosity() const;  // [Pa s]

  /// Largest speed of the flow without cells; in unbounded flow zero: it has no bound.
  double fastest() const { return fastest_; }

  /// Where the reaction is wanted again and again.
  struct Places {
    std::vector<Vector<2>> positions;  // [m]
    SampleWeights weights;             // of the nodes; empty in unbounded flow
    std::vector<Vector<2>> flow;       // [m/s] without cells
  };
  Places places(std::vector<Vector<2>> positions) const;

  /// The answer of the boundaries to some rings: what comes on top of the flow without cells and
  /// the flow of the rings in free space.
  struct Reaction {
    FlowValues nodes;        // empty in unbounded flow
    double extra_drive = 0;  // [-] growth of the driving force over itself
  };
  Reaction reaction(std::span<const RingSource> sources) const;

  /// Velocities of the reaction at the places [m/s].
  std::vector<Vector<2>> at(const Reaction& reaction, const Places& places) const;

  /// What the rings add to the pressure drop of the flow without them, at the same flow rate [Pa]:
  /// between the ends of a channel, over the period of a periodic one that keeps its flow rate;
  /// zero in unbounded flow.
  double extra_pressure_drop(const Reaction& reaction, std::span<const RingSource> sources) const;

  const FlowValues& without_cells() const { return background_; }

  /// Of the whole domain by the extra drive [Pa]; bounded flow.
  double driving_pressure() const { return driving_pressure_; }

 private:
  double power_of(const RingSource& source) const;  // [W/m] of a ring in the flow without cells

  Flow flow_;
  StokesKernel kernel_;
  FlowValues background_;
  double fastest_ = 0;           // [m/s]
  double driving_pressure_ = 0;  // [Pa] f0 L
  double drive_per_power_ = 0;   // [m/N] 1/(f0 L Q)
};

}  // namespace hemoscale::micro
