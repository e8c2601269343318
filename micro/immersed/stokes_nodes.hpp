#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "micro/immersed/boundary_integral.hpp"
#include "micro/mps/coupled_solver.hpp"
#include "micro/mps/flow_domain.hpp"
#include "micro/mps/node_sampler.hpp"
#include "micro/mps/stage_options.hpp"
#include "micro/parallel/communicator.hpp"

namespace hemoscale::micro {

/// Velocity and pressure of some flow at given places.
using FlowAt = std::function<FlowValues(const std::vector<Vector<2>>& places)>;

/// Stokes flow on nodes that rest, by the least-squares particle method: one factorisation serves
/// the flow without cells and its reaction to them.
class StokesNodes {
 public:
  /// @throws ParameterError for fluids without viscosity and options other than coupled resting
  /// nodes
  StokesNodes(FlowDomain<2> domain, const Fluid& fluid, const StageOptions& options);

  /// The flow of the domain's patches and body force at time t, without cells.
  FlowValues background(double t) const;

  /// The flow that takes a disturbance away from the boundaries: minus its velocity at walls and
  /// inlets, and at outlets minus its pressure, its velocity across the normal and the normal
  /// derivative of its normal velocity. The sum of both is the flow between the boundaries at rest.
  FlowValues reaction(const FlowAt& disturbance) const;

  /// Weights of the nodes around points in the fluid.
  SampleWeights sample(const std::vector<Vector<2>>& points) const {
    return sampler_->weights(points);
  }

  /// L(i,j) = d u_i / d x_j of a flow at points in the fluid.
  std::vector<Tensor<2>> gradients(const std::vector<Vector<2>>& points,
                                   const FlowValues& flow) const {
    return sampler_->gradients(points, flow.velocities);
  }

  const FlowDomain<2>& domain() const { return domain_; }
  const NodeGeometry<2>& nodes() const { return nodes_; }
  const Fluid& fluid() const { return fluid_; }
  std::string describe_solver() const { return solver_->describe(); }

 private:
  FlowDomain<2> domain_;
  Fluid fluid_;
  NodeGeometry<2> nodes_;
  std::unique_ptr<Communicator> alone_;
  std::unique_ptr<CoupledSolver<2>> solver_;
  std::unique_ptr<NodeSampler<2>> sampler_;
  std::vector<std::size_t> bounding_;  // nodes where something is imposed
  std::vector<Vector<2>> places_;      // [m] theirs, then two beside each outlet node
  double outlet_offset_ = 0;           // [m] of these
};

}  // namespace hemoscale::micro
