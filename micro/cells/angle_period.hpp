#pragma once

#include <optional>
#include <span>
#include <vector>

namespace hemoscale::micro {

struct Period {
  double mean = 0;     // [s]
  double scatter = 0;  // [s] standard deviation of the single periods; zero for one
  int count = 0;       // of whole periods
};

/// The angles without jumps: each is replaced by the one nearest to the angle before it.
///
/// @param angles  [rad]
/// @param symmetry  [rad] angle after which the same is seen: pi for the long axis of a cell, 2 pi
///                  for the place of a node
/// @throws ParameterError if an angle changes by more than a third of the symmetry between samples:
///         the direction of the motion is then not known
std::vector<double> unwrapped(std::span<const double> angles, double symmetry);

/// Period of a full turn, 2 pi, of something that rotates: a cell that tumbles, a node of a
/// membrane that tank-treads.
///
/// A period lies between passages, by straight lines between samples, of a level and of the same
/// level a turn later. Where noise makes the angle pass a level several times, the passage is the
/// middle between the first and the last of them. The level is best where the angle changes fast:
/// pi/2 for a cell in shear.
///
/// @param angles  [rad] unwrapped
/// @returns nothing before one whole turn is seen
/// @throws ParameterError for series of different length
std::optional<Period> turning_period(std::span<const double> time, std::span<const double> angles,
                                     double level);

/// Period of an oscillation about the mean, such as the swinging of an inclination: times between
/// upward passages of the middle between the extremes, each after the series has been below that by
/// a quarter of the amplitude, so that noise is not counted.
/// @returns nothing before one whole period is seen
/// @throws ParameterError for series of different length
std::optional<Period> oscillation_period(std::span<const double> time,
                                         std::span<const double> values);

}  // namespace hemoscale::micro
