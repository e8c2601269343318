#include "coupling/scene/ensemble_nodes.hpp"

#include <fmt/format.h>

#include <cmath>

#include "coupling/error.hpp"
#include "coupling/report/series.hpp"

namespace hemoscale::coupling {

namespace {

const char* const key = "output.reference_nodes";

std::vector<std::vector<double>> rows_of(const std::vector<micro::EnsembleState>& states) {
  std::vector<std::vector<double>> rows;
  double first = 0;
  for (const micro::EnsembleState& s : states) {
    for (std::size_t i = 0; i < s.x.size(); ++i) {
      rows.push_back({first + static_cast<double>(i / s.nodes), s.x[i], s.y[i]});
    }
    first += static_cast<double>(s.cells);
  }
  return rows;
}

}  // namespace

void write_nodes(const std::filesystem::path& path,
                 const std::vector<micro::EnsembleState>& states) {
  write_table(path, {{"cell", "-"}, {"x", "m"}, {"y", "m"}}, rows_of(states));
}

double distance_from_reference(const Settings& settings, const std::filesystem::path& case_folder,
                               const std::vector<micro::EnsembleState>& states) {
  const Location at = settings.location(key);
  std::filesystem::path path = settings.text(key);
  if (path.is_relative()) path = case_folder / path;
  const Table table = read_table(path);
  const auto rows = rows_of(states);
  if (table.columns.size() != 3 || table.rows.size() != rows.size()) {
    throw CaseError(
        {{at.file, at.line, at.column, key,
          fmt::format("{} has {} columns and {} rows; it must be the nodes.csv "
                      "(output.nodes = true) of a run with the same cells, 3 columns "
                      "and {} rows",
                      path.string(), table.columns.size(), table.rows.size(), rows.size())}});
  }
  double sum = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    sum += std::pow(rows[i][1] - table.rows[i][1], 2) + std::pow(rows[i][2] - table.rows[i][2], 2);
  }
  return std::sqrt(sum / static_cast<double>(rows.size()));
}

}  // namespace hemoscale::coupling
