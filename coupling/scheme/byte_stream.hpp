#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "micro/model.hpp"

namespace hemoscale::coupling {

/// Values as bytes, for messages between ranks of one run: every bit is kept. Not a file format.
class ByteWriter {
 public:
  void real(double value);
  void integer(std::int64_t value);
  void text(const std::string& value);
  void reals(const std::vector<double>& values);
  void integers(const std::vector<std::int64_t>& values);
  void snapshot(const micro::Snapshot& value);
  void estimate(const micro::Estimate& value);
  void observation(const micro::Observation<2>& value);

  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Reads what a ByteWriter wrote, in the same order.
class ByteReader {
 public:
  explicit ByteReader(const std::string& bytes) : bytes_(bytes) {}

  double real();
  std::int64_t integer();
  std::string text();
  std::vector<double> reals();
  std::vector<std::int64_t> integers();
  micro::Snapshot snapshot();
  micro::Estimate estimate();
  micro::Observation<2> observation();

  bool at_end() const { return position_ == bytes_.size(); }

 private:
  void copy(void* to, std::size_t size);

  const std::string& bytes_;
  std::size_t position_ = 0;
};

}  // namespace hemoscale::coupling
