#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "micro/ensemble/blocks/block_store.hpp"

namespace hemoscale::micro::regions {

/// Appends the bytes of a number, or of an array without its length.
template <class T>
void append(std::string& bytes, const T* values, std::size_t count) {
  static_assert(std::is_trivially_copyable_v<T>);
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}
template <class T>
void append(std::string& bytes, const T& value) {
  append(bytes, &value, 1);
}

/// Reads what `append` wrote, in the same order.
class ByteReader {
 public:
  explicit ByteReader(const std::string& bytes) : bytes_(bytes) {}
  bool at_end() const { return at_ == bytes_.size(); }

  /// @throws EnvironmentError if the bytes end before
  void read(void* values, std::size_t bytes);
  template <class T>
  T read() {
    T value;
    read(&value, sizeof(T));
    return value;
  }
  template <class T>
  std::vector<T> read_array(std::size_t count) {
    std::vector<T> values(count);
    read(values.data(), count * sizeof(T));
    return values;
  }

 private:
  const std::string& bytes_;
  std::size_t at_ = 0;
};

/// A cell with everything that continues with the same bits, between ranks of one kind of machine.
void append_cell(std::string& bytes, const blocks::CellRecord& cell);

/// All cells of a message, appended to a list.
void read_cells(const std::string& bytes, std::vector<blocks::CellRecord>& cells);

}  // namespace hemoscale::micro::regions
