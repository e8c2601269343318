#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace hemoscale::coupling {

/// A column of a table of numbers.
struct Column {
  std::string name;  // e.g. "time"
  std::string unit;  // e.g. "s", "Pa s"; "-" for a pure number
};

/// Writes a table of numbers as comma-separated text: one header line "time [s],change [-]", then
/// one line per row, each in the file when append() returns. Numbers are written with the fewest
/// digits that read back to the same bits. Used for series.csv and for the profiles.
class SeriesWriter {
 public:
  /// Starts a new file; an older one of that name is emptied.
  /// @throws EnvironmentError with path and the system's reason
  static SeriesWriter create(const std::filesystem::path& path, const std::vector<Column>& columns);

  /// Continues after a restart: keeps the rows whose first column is at most `last`, drops later
  /// ones and a line that a killed process left unfinished. Starts a new file if there is none.
  /// @throws EnvironmentError also if the header differs or an earlier row is not one of numbers
  static SeriesWriter resume(const std::filesystem::path& path, const std::vector<Column>& columns,
                             double last);

  SeriesWriter(SeriesWriter&& other) noexcept;
  SeriesWriter& operator=(SeriesWriter&& other) noexcept;
  SeriesWriter(const SeriesWriter&) = delete;
  SeriesWriter& operator=(const SeriesWriter&) = delete;
  ~SeriesWriter();

  /// @param row  one number per column
  /// @throws EnvironmentError with path and the system's reason, rows before being intact;
  ///         std::invalid_argument if the row is of another length
  void append(std::span<const double> row);

 private:
  SeriesWriter(std::filesystem::path path, std::size_t columns, int descriptor);
  void write_line(const std::string& line);

  std::filesystem::path path_;
  std::size_t columns_ = 0;
  int descriptor_ = -1;
};

/// Writes a whole table at once, aside and then renamed: profile.csv, law.csv, samples.csv.
/// @throws EnvironmentError with path and the system's reason
void write_table(const std::filesystem::path& path, const std::vector<Column>& columns,
                 const std::vector<std::vector<double>>& rows);

/// A table as it was read.
struct Table {
  std::vector<Column> columns;
  std::vector<std::vector<double>> rows;
};

/// @throws EnvironmentError with path, line and what is wrong
Table read_table(const std::filesystem::path& path);

}  // namespace hemoscale::coupling
