#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace hemoscale::coupling {

/// A table of texts and numbers, for chart.csv, orders.csv, map.csv and the terminal.
struct TextTable {
  struct Cell {
    std::string exact;  // as in the file
    std::string shown;  // to people: numbers with four digits
  };
  std::vector<std::string> header;  // with the unit of a number: "cpu time [s]"
  std::vector<std::vector<Cell>> rows;

  /// A row is begun, then filled from left to right; cells that are left out stay empty.
  void begin_row() { rows.emplace_back(); }
  void add(const std::string& text);
  /// A number that is not one (nan) is not there: the cell is empty.
  void add(double number);
};

/// Comma-separated; texts with commas, quotes or line ends are quoted (RFC 4180); numbers carry the
/// fewest digits that read back to the same bits. Written aside, then renamed.
/// @throws EnvironmentError
void write_csv(const std::filesystem::path& file, const TextTable& table);

/// Aligned columns for people; columns without content are left out.
std::string aligned(const TextTable& table);

}  // namespace hemoscale::coupling
