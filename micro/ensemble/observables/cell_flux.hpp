#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "micro/ensemble/box.hpp"
#include "micro/ensemble/flow/given_flow.hpp"
#include "micro/ensemble/observables/cell_shape.hpp"
#include "micro/ensemble/observables/slices.hpp"
#include "micro/ensemble/state.hpp"

namespace hemoscale::micro {

/// Velocity of the matter of one cell, v(r) = velocity + gradient (r - centre): the affine field
/// that fits the velocities of its nodes best. Exact for cells that translate, rotate or deform
/// with a linear flow.
struct CellMotion {
  Vector<2> velocity = Vector<2>::Zero();  // [m/s] at the centroid
  Tensor<2> gradient = Tensor<2>::Zero();  // [1/s]
};

/// @param velocity_x, velocity_y  of all nodes [m/s]
std::vector<CellMotion> cell_motions(const EnsembleState& state, std::span<const CellShape> shapes,
                                     std::span<const double> velocity_x,
                                     std::span<const double> velocity_y);

/// Sums over the cells in each bin across a channel. Profiles are quotients of these: the area
/// fraction area/(L w), the cell velocity transport/area, the area flux density transport/(L w).
struct LateralSums {
  std::vector<double> area;       // [m^2]
  std::vector<double> transport;  // [m^3/s] int v_x dA
  std::vector<double> cosine;     // [m^2] area times cos 2a, a the inclination as in the lower half
  std::vector<double> sine;       // [m^2] area times sin 2a
};
LateralSums lateral_sums(const EnsembleState& state, std::span<const CellShape> shapes,
                         std::span<const CellMotion> motions, const LateralBins& bins);

/// Flow rate through the section at x, from wall to wall, int u_x dy [m^2/s]; by three Gauss points
/// in each of `intervals`, exact for parabolas.
double flow_rate(const GivenFlow& flow, double x, double height, double time,
                 std::size_t intervals = 64);

/// Hematocrits of a channel as area fractions.
struct Hematocrits {
  double tube = 0;       // [-] H_T: area of the cells over that of the channel
  double discharge = 0;  // [-] H_D: flux of cell area over the flow rate, int phi u_c dy / int u dy
  double mean_velocity = 0;  // [m/s] of the cells, by area

  double fahraeus() const { return tube / discharge; }  // [-] H_T/H_D, below 1 in vessels
};

/// @param flow_rate  of the given flow [m^2/s]
/// @pre at least one cell
Hematocrits hematocrits(std::span<const CellShape> shapes, std::span<const CellMotion> motions,
                        const Box& box, double flow_rate);

}  // namespace hemoscale::micro
