#include "micro/ensemble/regions/cell_bytes.hpp"

#include <fmt/core.h>

#include <cstdint>
#include <cstring>

#include "micro/error.hpp"

namespace hemoscale::micro::regions {

void ByteReader::read(void* values, std::size_t bytes) {
  if (bytes > bytes_.size() - at_) {
    throw EnvironmentError(fmt::format(
        "a message between ranks ends after {} bytes; {} more are expected; run the same "
        "program on all ranks",
        bytes_.size(), bytes - (bytes_.size() - at_)));
  }
  std::memcpy(values, bytes_.data() + at_, bytes);
  at_ += bytes;
}

void append_cell(std::string& bytes, const blocks::CellRecord& cell) {
  append(bytes, cell.id);
  append(bytes, cell.kind);
  append(bytes, static_cast<std::int32_t>(cell.x.size()));
  append(bytes, static_cast<std::int32_t>(cell.memory_x.size()));
  append(bytes, static_cast<std::int32_t>(cell.area.has_value()));
  append(bytes, cell.frame.x());
  append(bytes, cell.frame.y());
  append(bytes, cell.area.value_or(0));
  for (const std::vector<double>* values : {&cell.x, &cell.y, &cell.memory_x, &cell.memory_y}) {
    append(bytes, values->data(), values->size());
  }
}

void read_cells(const std::string& bytes, std::vector<blocks::CellRecord>& cells) {
  ByteReader reader(bytes);
  while (!reader.at_end()) {
    blocks::CellRecord cell;
    cell.id = reader.read<blocks::CellId>();
    cell.kind = reader.read<std::int32_t>();
    const auto nodes = static_cast<std::size_t>(reader.read<std::int32_t>());
    const auto memory = static_cast<std::size_t>(reader.read<std::int32_t>());
    const bool has_area = reader.read<std::int32_t>() != 0;
    cell.frame.x() = reader.read<double>();
    cell.frame.y() = reader.read<double>();
    const auto area = reader.read<double>();
    if (has_area) cell.area = area;
    cell.x = reader.read_array<double>(nodes);
    cell.y = reader.read_array<double>(nodes);
    cell.memory_x = reader.read_array<double>(memory);
    cell.memory_y = reader.read_array<double>(memory);
    cells.push_back(std::move(cell));
  }
}

}  // namespace hemoscale::micro::regions
