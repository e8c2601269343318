#pragma once

#include <cstdint>

#include "micro/mps/flow_domain.hpp"
#include "micro/mps/least_squares.hpp"

namespace hemoscale::micro {

/// Whether particles enter or leave.
template <int dim>
bool has_openings(const ParticleSet<dim>& particles);

struct ExchangeCount {
  std::size_t inserted = 0;
  std::size_t removed = 0;
};

/// Lets moving nodes in at inlets and out at outlets.
///
/// A node that has come within a quarter of a spacing of the plane of an outlet, or passed it, is
/// removed. A node is inserted half a spacing inside each inlet node where no other is within 0.7
/// spacings; it takes the flow interpolated to its place (second order).
template <int dim>
ExchangeCount exchange_nodes(FlowDomain<dim>& domain, const LeastSquares& fit,
                             std::int64_t& next_identity);

}  // namespace hemoscale::micro
