#include "coupling/report/series.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <cstddef>
#include <string_view>
#include <system_error>
#include <utility>

#include "coupling/error.hpp"
#include "coupling/report/report_file.hpp"

namespace hemoscale::coupling {
namespace {

std::string header_of(const std::vector<Column>& columns) {
  std::string line;
  for (const Column& column : columns) {
    line += fmt::format("{}{} [{}]", line.empty() ? "" : ",", column.name, column.unit);
  }
  return line + "\n";
}

std::string line_of(std::span<const double> row) {
  return fmt::format("{}\n", fmt::join(row.begin(), row.end(), ","));
}

void require_columns(const std::filesystem::path& path, const std::vector<Column>& columns) {
  const auto is_plain = [](const std::string& text) {
    return !text.empty() && text.find_first_of(",[]\n\r\"") == std::string::npos;
  };
  bool are_plain = !columns.empty();
  for (const Column& column : columns) {
    are_plain = are_plain && is_plain(column.name) && is_plain(column.unit);
  }
  if (!are_plain) {
    throw std::invalid_argument(path.string() +
                                ": a table needs columns whose names and units are not empty and "
                                "hold no comma, bracket, quote or line end");
  }
}

[[noreturn]] void fail_row(const std::filesystem::path& path, std::size_t line,
                           const std::string& what) {
  throw EnvironmentError(
      fmt::format("{}:{}: {}; correct or remove the file", path.string(), line, what));
}

/// Comma-separated pieces of a line.
std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> pieces;
  while (true) {
    const std::size_t comma = line.find(',');
    pieces.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return pieces;
    line.remove_prefix(comma + 1);
  }
}

Column parse_column(const std::filesystem::path& path, std::string_view text) {
  const std::size_t bracket = text.find(" [");
  if (bracket == std::string_view::npos || bracket == 0 || !text.ends_with(']')) {
    fail_row(path, 1, fmt::format("'{}' is not a column head of the form 'name [unit]'", text));
  }
  return {std::string(text.substr(0, bracket)),
          std::string(text.substr(bracket + 2, text.size() - bracket - 3))};
}

std::vector<double> parse_row(const std::filesystem::path& path, std::size_t line,
                              std::string_view text, std::size_t columns) {
  const std::vector<std::string_view> pieces = split(text);
  if (pieces.size() != columns) {
    fail_row(path, line,
             fmt::format("{} numbers where the header names {} columns", pieces.size(), columns));
  }
  std::vector<double> row;
  for (const std::string_view piece : pieces) {
    double value = 0;
    const auto result = std::from_chars(piece.data(), piece.data() + piece.size(), value);
    if (result.ec != std::errc{} || result.ptr != piece.data() + piece.size()) {
      fail_row(path, line, fmt::format("'{}' is not a number", piece));
    }
    row.push_back(value);
  }
  return row;
}

int open_to_append(const std::filesystem::path& path, int flags) {
  const int descriptor =
      ::open(path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | flags, 0666);
  if (descriptor < 0) fail_system(path, "open for writing", errno);
  return descriptor;
}

}  // namespace

SeriesWriter::SeriesWriter(std::filesystem::path path, std::size_t columns, int descriptor)
    : path_(std::move(path)), columns_(columns), descriptor_(descriptor) {}

SeriesWriter::SeriesWriter(SeriesWriter&& other) noexcept
    : path_(std::move(other.path_)),
      columns_(other.columns_),
      descriptor_(std::exchange(other.descriptor_, -1)) {}

SeriesWriter& SeriesWriter::operator=(SeriesWriter&& other) noexcept {
  std::swap(path_, other.path_);
  std::swap(columns_, other.columns_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

SeriesWriter::~SeriesWriter() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

SeriesWriter SeriesWriter::create(const std::filesystem::path& path,
                                  const std::vector<Column>& columns) {
  require_columns(path, columns);
  make_folder_of(path);
  SeriesWriter writer(path, columns.size(), open_to_append(path, O_TRUNC));
  writer.write_line(header_of(columns));
  return writer;
}

SeriesWriter SeriesWriter::resume(const std::filesystem::path& path,
                                  const std::vector<Column>& columns, double last) {
  require_columns(path, columns);
  if (!std::filesystem::exists(path)) return create(path, columns);
  const std::string text = read_file(path);
  const std::string header = header_of(columns);
  if (!std::string_view(text).starts_with(header)) {
    const std::string found = text.substr(0, text.find('\n'));
    fail_row(path, 1,
             fmt::format("the header is '{}' where this run writes '{}'", found,
                         header.substr(0, header.size() - 1)));
  }
  std::size_t kept = header.size();
  std::size_t line = 1;
  for (std::size_t end = text.find('\n', kept); end != std::string::npos;
       end = text.find('\n', kept)) {
    const std::string_view row = std::string_view(text).substr(kept, end - kept);
    if (!(parse_row(path, ++line, row, columns.size())[0] <= last)) break;
    kept = end + 1;
  }
  if (kept < text.size()) replace_file(path, text.substr(0, kept));
  return {path, columns.size(), open_to_append(path, 0)};
}

void SeriesWriter::append(std::span<const double> row) {
  if (row.size() != columns_) {
    throw std::invalid_argument(fmt::format("{}: a row of {} numbers; the header names {} columns",
                                            path_.string(), row.size(), columns_));
  }
  write_line(line_of(row));
}

void SeriesWriter::write_line(const std::string& line) {
  const off_t start = ::lseek(descriptor_, 0, SEEK_END);
  std::string_view rest = line;
  while (!rest.empty()) {
    const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
    if (written >= 0) {
      rest.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno != EINTR) {
      const int error = errno;
      // Half a line would spoil the next one; a device or a pipe cannot be shortened.
      if (start >= 0 && ::ftruncate(descriptor_, start) != 0) errno = error;
      fail_system(path_, "write", error);
    }
  }
}

void write_table(const std::filesystem::path& path, const std::vector<Column>& columns,
                 const std::vector<std::vector<double>>& rows) {
  require_columns(path, columns);
  std::string text = header_of(columns);
  for (const std::vector<double>& row : rows) {
    if (row.size() != columns.size()) {
      throw std::invalid_argument(
          fmt::format("{}: a row of {} numbers; the header names {} columns", path.string(),
                      row.size(), columns.size()));
    }
    text += line_of(row);
  }
  replace_file(path, text);
}

Table read_table(const std::filesystem::path& path) {
  const std::string text = read_file(path);
  Table table;
  std::size_t line = 0;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = text.find('\n', start);
    if (end == std::string::npos) fail_row(path, line + 1, "the last line is not complete");
    const std::string_view content = std::string_view(text).substr(start, end - start);
    start = end + 1;
    if (++line > 1) {
      table.rows.push_back(parse_row(path, line, content, table.columns.size()));
      continue;
    }
    for (const std::string_view head : split(content)) {
      table.columns.push_back(parse_column(path, head));
    }
  }
  if (table.columns.empty()) fail_row(path, 1, "there is no header");
  return table;
}

}  // namespace hemoscale::coupling
