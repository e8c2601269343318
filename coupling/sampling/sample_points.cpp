#include "coupling/sampling/sample_points.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "coupling/error.hpp"

namespace hemoscale::coupling {

namespace {

Fault fault(std::string key, std::string message) {
  Fault result;
  result.key = std::move(key);
  result.message = std::move(message);
  return result;
}

}  // namespace

template <int dim>
std::vector<macro::Vector<dim>> points_across(const macro::Vector<dim>& axis,
                                              const macro::Vector<dim>& wall, int count,
                                              double closest_to_axis) {
  std::vector<Fault> faults;
  if (count < 1) {
    faults.push_back(fault("sampling.across",
                           fmt::format("{} points are too few; at least 1 is needed", count)));
  }
  if (count > 1 && !(closest_to_axis > 0 && closest_to_axis < 1)) {
    faults.push_back(fault("sampling.closest_to_axis",
                           fmt::format("{} is not between 0 and 1 (both excluded); with several "
                                       "points choose for instance 0.1",
                                       closest_to_axis)));
  }
  if (!faults.empty()) throw CaseError(std::move(faults));

  std::vector<macro::Vector<dim>> points;
  for (int k = 0; k < count - 1; ++k) {
    const double s = std::pow(closest_to_axis, 1 - double(k) / (count - 1));
    points.push_back(axis + s * (wall - axis));
  }
  points.push_back(wall);  // not computed: rounding would put it outside the channel
  return points;
}

template <int dim>
std::vector<macro::Vector<dim>> explicit_points(const std::vector<Eigen::Vector3d>& points) {
  std::vector<Fault> faults;
  std::vector<macro::Vector<dim>> result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d& x = points[i];
    if (!x.allFinite()) {
      faults.push_back(fault("sampling.points",
                             fmt::format("point {} = ({}, {}, {}) m is not finite; give three "
                                         "lengths",
                                         i + 1, x[0], x[1], x[2])));
    } else if (dim == 2 && x[2] != 0) {
      faults.push_back(fault("sampling.points",
                             fmt::format("point {} = ({}, {}, {}) m lies outside the plane of the "
                                         "flow; its third coordinate must be 0",
                                         i + 1, x[0], x[1], x[2])));
    } else {
      result.push_back(x.head<dim>());
    }
  }
  if (!faults.empty()) throw CaseError(std::move(faults));
  return result;
}

template std::vector<macro::Vector<2>> points_across<2>(const macro::Vector<2>&,
                                                        const macro::Vector<2>&, int, double);
template std::vector<macro::Vector<3>> points_across<3>(const macro::Vector<3>&,
                                                        const macro::Vector<3>&, int, double);
template std::vector<macro::Vector<2>> explicit_points<2>(const std::vector<Eigen::Vector3d>&);
template std::vector<macro::Vector<3>> explicit_points<3>(const std::vector<Eigen::Vector3d>&);

}  // namespace hemoscale::coupling
