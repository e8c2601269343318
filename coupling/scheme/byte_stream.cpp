#include "coupling/scheme/byte_stream.hpp"

#include <cstring>
#include <stdexcept>

namespace hemoscale::coupling {

namespace {

template <class Value>
void append(std::string& bytes, const Value* values, std::size_t count) {
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof(Value));
}

}  // namespace

void ByteWriter::real(double value) {
  append(bytes_, &value, 1);
}
void ByteWriter::integer(std::int64_t value) {
  append(bytes_, &value, 1);
}

void ByteWriter::text(const std::string& value) {
  integer(static_cast<std::int64_t>(value.size()));
  bytes_ += value;
}

void ByteWriter::reals(const std::vector<double>& values) {
  integer(static_cast<std::int64_t>(values.size()));
  append(bytes_, values.data(), values.size());
}

void ByteWriter::integers(const std::vector<std::int64_t>& values) {
  integer(static_cast<std::int64_t>(values.size()));
  append(bytes_, values.data(), values.size());
}

void ByteWriter::snapshot(const micro::Snapshot& value) {
  integer(static_cast<std::int64_t>(value.reals.size()));
  for (const auto& [name, values] : value.reals) {
    text(name);
    reals(values);
  }
  integer(static_cast<std::int64_t>(value.integers.size()));
  for (const auto& [name, values] : value.integers) {
    text(name);
    integers(values);
  }
}

void ByteWriter::estimate(const micro::Estimate& value) {
  real(value.mean);
  real(value.standard_error);
  real(value.correlation_time);
  real(value.effective_samples);
}

void ByteWriter::observation(const micro::Observation<2>& value) {
  real(value.shear_rate);
  real(value.hematocrit);
  estimate(value.shear_stress);
  estimate(value.first_normal_difference);
  append(bytes_, value.particle_stress.data(), 4);
  real(value.averaging_time);
  real(value.warm_up_time);
  integer(value.steps);
  integer(value.termination == micro::Termination::precision_reached);
  integer(static_cast<std::int64_t>(value.ledger.size()));
  for (const micro::LedgerEntry& entry : value.ledger) {
    text(entry.name);
    real(entry.deviation);
    real(entry.warn_above);
    real(entry.stop_above);
  }
}

void ByteReader::copy(void* to, std::size_t size) {
  if (bytes_.size() - position_ < size) {
    throw std::logic_error("message between ranks is shorter than what it should hold");
  }
  if (size > 0) std::memcpy(to, bytes_.data() + position_, size);
  position_ += size;
}

double ByteReader::real() {
  double value = 0;
  copy(&value, sizeof value);
  return value;
}

std::int64_t ByteReader::integer() {
  std::int64_t value = 0;
  copy(&value, sizeof value);
  return value;
}

std::string ByteReader::text() {
  std::string value(static_cast<std::size_t>(integer()), '\0');
  copy(value.data(), value.size());
  return value;
}

std::vector<double> ByteReader::reals() {
  std::vector<double> values(static_cast<std::size_t>(integer()));
  copy(values.data(), values.size() * sizeof(double));
  return values;
}

std::vector<std::int64_t> ByteReader::integers() {
  std::vector<std::int64_t> values(static_cast<std::size_t>(integer()));
  copy(values.data(), values.size() * sizeof(std::int64_t));
  return values;
}

micro::Snapshot ByteReader::snapshot() {
  micro::Snapshot value;
  for (std::int64_t n = integer(); n > 0; --n) {
    const std::string name = text();
    value.reals[name] = reals();
  }
  for (std::int64_t n = integer(); n > 0; --n) {
    const std::string name = text();
    value.integers[name] = integers();
  }
  return value;
}

micro::Estimate ByteReader::estimate() {
  micro::Estimate value;
  value.mean = real();
  value.standard_error = real();
  value.correlation_time = real();
  value.effective_samples = real();
  return value;
}

micro::Observation<2> ByteReader::observation() {
  micro::Observation<2> value;
  value.shear_rate = real();
  value.hematocrit = real();
  value.shear_stress = estimate();
  value.first_normal_difference = estimate();
  copy(value.particle_stress.data(), 4 * sizeof(double));
  value.averaging_time = real();
  value.warm_up_time = real();
  value.steps = integer();
  value.termination =
      integer() != 0 ? micro::Termination::precision_reached : micro::Termination::allowance_spent;
  value.ledger.resize(static_cast<std::size_t>(integer()));
  for (micro::LedgerEntry& entry : value.ledger) {
    entry.name = text();
    entry.deviation = real();
    entry.warn_above = real();
    entry.stop_above = real();
  }
  return value;
}

}  // namespace hemoscale::coupling
