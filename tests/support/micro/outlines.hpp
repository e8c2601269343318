#pragma once

#include <cmath>
#include <fstream>
#include <map>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "micro/vector.hpp"

// Outlines of cells for tests of what is seen of them.
namespace hemoscale::micro::test {

using Nodes = std::vector<Vector<2>>;

inline Vector<2> turned(const Vector<2>& v, double angle) {
  return {std::cos(angle) * v.x() - std::sin(angle) * v.y(),
          std::sin(angle) * v.x() + std::cos(angle) * v.y()};
}

struct Ellipse {
  double a = 3, b = 1;  // semi-axes
  double angle = 0;     // of the first one
  Vector<2> centre = Vector<2>::Zero();
  double start = 0.3;  // parameter of node 0: no node lies at an end of an axis
};

inline Nodes nodes_on(const Ellipse& ellipse, int n) {
  Nodes nodes;
  for (int i = 0; i < n; ++i) {
    const double phase = ellipse.start + 2 * std::numbers::pi * i / n;
    nodes.push_back(
        ellipse.centre +
        turned({ellipse.a * std::cos(phase), ellipse.b * std::sin(phase)}, ellipse.angle));
  }
  return nodes;
}

/// A crescent that is open to the left: a parachute. r = (cos + bend sin^2, sin) with bend < 0 has
/// its rims at the left.
inline Nodes crescent(double thickness, double bend, int n, double start = 0.3) {
  Nodes nodes;
  for (int i = 0; i < n; ++i) {
    const double phase = start + 2 * std::numbers::pi * i / n;
    nodes.emplace_back(thickness * std::cos(phase) + bend * std::pow(std::sin(phase), 2),
                       std::sin(phase));
  }
  return nodes;
}

/// Columns of a table of numbers, by the names in its first line; a text column has nan.
inline std::map<std::string, std::vector<double>> read_columns(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path + " cannot be read");
  std::string line;
  std::getline(file, line);
  std::vector<std::string> names;
  std::istringstream header(line);
  for (std::string name; std::getline(header, name, ',');) names.push_back(name);
  std::map<std::string, std::vector<double>> columns;
  while (std::getline(file, line)) {
    std::istringstream row(line);
    std::size_t k = 0;
    for (std::string cell; std::getline(row, cell, ','); ++k) {
      char* end = nullptr;
      const double value = std::strtod(cell.c_str(), &end);
      columns[names.at(k)].push_back(end == cell.c_str() ? std::nan("") : value);
    }
  }
  return columns;
}

inline Nodes nodes_of(const std::vector<double>& x, const std::vector<double>& y, double scale) {
  Nodes nodes;
  for (std::size_t i = 0; i < x.size(); ++i) nodes.emplace_back(scale * x[i], scale * y.at(i));
  return nodes;
}

/// Slope of log(error) over log(n) between two resolutions, positive for convergence.
inline double observed_order(double coarse, double fine, double refinement) {
  return std::log(std::abs(coarse / fine)) / std::log(refinement);
}

}  // namespace hemoscale::micro::test
