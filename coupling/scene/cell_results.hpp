#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "coupling/report/series.hpp"
#include "coupling/report/summary.hpp"
#include "coupling/scene/cell_scene.hpp"

namespace hemoscale::coupling {

/// Columns of series.csv: what is seen of every cell, and of the flow.
std::vector<Column> cell_columns(const CellScene& scene);
std::vector<double> cell_row(const CellScene& scene, const micro::CellsInPlasma& model);

/// Rows of series.csv so far, column by column, from which steady states and periods are read.
class CellHistory {
 public:
  explicit CellHistory(std::vector<Column> columns);
  void append(const std::vector<double>& row);

  /// Adds half turns to the inclinations of a row so that they follow those of the last row without
  /// jumps: the long axis has no direction.
  void unwrap(std::vector<double>& row) const;

  const std::vector<double>& operator[](const std::string& column) const;
  bool empty() const { return values_.front().empty(); }

 private:
  std::map<std::string, std::size_t> index_;
  std::vector<std::vector<double>> values_;
};

/// Figures of summary.json: the last row, dimensionless numbers, steady states with their times,
/// periods.
std::vector<Figure> cell_figures(const Settings& settings, const CellScene& scene,
                                 const micro::CellsInPlasma& model, const CellHistory& history);

/// Columns and rows of cells.csv: places, velocities and tensions of all nodes at one time.
std::vector<Column> node_columns();
std::vector<std::vector<double>> node_rows(const micro::CellsInPlasma& model);

/// modes.csv: Fourier coefficients of the outlines; walls.csv: the walls; flow.csv: velocity and
/// pressure on a grid around the first cell, nan outside the fluid.
void write_modes(const std::filesystem::path& path, const micro::CellsInPlasma& model);
void write_walls(const std::filesystem::path& path, const CellScene& scene);
void write_flow(const std::filesystem::path& path, const CellScene& scene,
                const micro::CellsInPlasma& model);

/// What the results are not; written into every summary.
std::vector<std::string> cell_statements(const Settings& settings);

/// Smallest distance of a cell to walls and other cells [m]; infinite without either.
double smallest_gap(const CellScene& scene, const micro::CellsInPlasma& model, std::size_t cell);

}  // namespace hemoscale::coupling
