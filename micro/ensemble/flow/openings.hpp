#pragma once

#include <string>
#include <vector>

#include "micro/ensemble/flow/given_flow.hpp"

namespace hemoscale::micro {

/// Where a channel ends and fluid enters or leaves: the straight line from a to b. As with walls
/// the fluid lies on the left of the direction of travel, beyond it on the right.
struct Opening {
  std::string name;
  Vector<2> a = Vector<2>::Zero();  // [m]
  Vector<2> b = Vector<2>::Zero();  // [m]

  double length() const { return (b - a).norm(); }  // [m]
  Vector<2> tangent() const { return (b - a) / length(); }
  Vector<2> inward() const;  // unit normal into the fluid
};

/// @throws ParameterError unless its ends are finite and apart
void check(const Opening& opening);

/// A place by its distance along the opening from a and its depth in the fluid [m].
Vector<2> point_at(const Opening& opening, double along, double depth);

/// How deep x lies in the fluid behind the line of the opening [m]; negative beyond it.
double depth(const Opening& opening, const Vector<2>& x);

/// Whether x (the centre of a cell) has left through the opening: it lies beyond it, between the
/// continued walls, and no further out than `overhang`. Another branch of the vessel may lie
/// further out.
/// @param overhang  [m] for how far the channel is continued beyond its openings
bool has_left(const Opening& opening, const Vector<2>& x, double overhang);

/// The integral of u.n over the opening, n the normal into the fluid [m^2/s]: volume per time and
/// depth. By Gauss's quadrature of four points in each of 64 panels.
double volume_flux(const Opening& opening, const GivenFlow& flow, double time);

/// The same of the part that flows in, max(u.n, 0).
double inflow_flux(const Opening& opening, const GivenFlow& flow, double time);

}  // namespace hemoscale::micro
