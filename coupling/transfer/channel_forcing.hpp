#pragma once

#include "macro/flow_field.hpp"
#include "micro/forcing.hpp"

namespace hemoscale::coupling {

/// Where a micro channel lies in a plane macro flow: its inlet is the straight line from one wall
/// to the other.
struct InletSection {
  macro::Vector<2> lower = macro::Vector<2>::Zero();  // [m] on the lower wall
  macro::Vector<2> upper = macro::Vector<2>::Zero();  // [m] on the upper wall
  int points = 33;  // [-] at which the flow is sampled; at least 4
};

/// The flow through a section as what drives a plasma channel: the velocity along the normal of the
/// section, tabulated from wall to wall; its transverse part is left out, and told.
struct ChannelForcing {
  micro::Forcing<2> forcing;
  double transverse = 0;  // [-] largest velocity along the section over the largest across it
};

/// @param t  [s]
/// @throws NumericalError if the section has no length or too few points, leaves the flow, or is
/// not
///         flowed through
ChannelForcing to_channel_forcing(const macro::FlowField<2>& flow, const InletSection& section,
                                  double t);

}  // namespace hemoscale::coupling
