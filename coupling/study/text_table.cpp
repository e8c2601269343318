#include "coupling/study/text_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "coupling/report/report_file.hpp"

namespace hemoscale::coupling {

namespace {

std::string csv_cell(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + "\"";
}

/// Characters on a terminal: bytes of UTF-8 that continue a character do not count.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;
  }));
}

}  // namespace

void TextTable::add(const std::string& text) {
  rows.back().push_back({text, text});
}

void TextTable::add(double number) {
  if (std::isnan(number)) {
    rows.back().emplace_back();
  } else {
    rows.back().push_back({fmt::format("{}", number), fmt::format("{:.4g}", number)});
  }
}

void write_csv(const std::filesystem::path& file, const TextTable& table) {
  std::string text;
  for (std::size_t k = 0; k < table.header.size(); ++k) {
    text += (k > 0 ? "," : "") + csv_cell(table.header[k]);
  }
  text += "\n";
  for (const std::vector<TextTable::Cell>& row : table.rows) {
    for (std::size_t k = 0; k < table.header.size(); ++k) {
      if (k > 0) text += ",";
      if (k < row.size()) text += csv_cell(row[k].exact);
    }
    text += "\n";
  }
  replace_file(file, text);
}

std::string aligned(const TextTable& table) {
  std::vector<std::vector<std::string>> lines = {table.header};
  for (const std::vector<TextTable::Cell>& row : table.rows) {
    lines.emplace_back(table.header.size());
    for (std::size_t k = 0; k < row.size(); ++k) lines.back()[k] = row[k].shown;
  }
  std::string text;
  std::vector<std::size_t> widths(table.header.size(), 0);
  for (std::size_t k = 0; k < widths.size(); ++k) {
    bool has_content = false;
    for (std::size_t i = 1; i < lines.size(); ++i) has_content |= !lines[i][k].empty();
    for (const auto& line : lines) widths[k] = std::max(widths[k], width_of(line[k]));
    if (!has_content) widths[k] = 0;
  }
  for (const auto& line : lines) {
    std::string shown;
    for (std::size_t k = 0; k < widths.size(); ++k) {
      if (widths[k] == 0) continue;
      shown += line[k] + std::string(widths[k] - width_of(line[k]) + 2, ' ');
    }
    text += shown.substr(0, shown.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

}  // namespace hemoscale::coupling
