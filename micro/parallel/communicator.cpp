#include "micro/parallel/communicator.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <climits>
#include <cstddef>
#include <numeric>
#include <utility>

#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

void require_success(int code, const char* call) {
  if (code == MPI_SUCCESS) {
    return;
  }
  char text[MPI_MAX_ERROR_STRING + 1] = "no reason given";
  int length = 0;
  MPI_Error_string(code, text, &length);
  throw EnvironmentError(
      fmt::format("{} failed: {}; check that all ranks are alive and call the same operations in "
                  "the same order",
                  call, text));
}

int message_length(std::size_t size, int rank) {
  if (size > static_cast<std::size_t>(INT_MAX)) {
    throw EnvironmentError(fmt::format(
        "rank {}: a message of {} bytes exceeds the {} bytes that MPI passes at once; send less",
        rank, size, INT_MAX));
  }
  return static_cast<int>(size);
}

}  // namespace

Communicator::Communicator(MPI_Comm communicator) {
  require_success(MPI_Comm_dup(communicator, &communicator_), "MPI_Comm_dup");
  // MPI ends the program on errors unless told to return them; on our duplicate we turn them into
  // exceptions. The caller's communicator keeps its own handler.
  require_success(MPI_Comm_set_errhandler(communicator_, MPI_ERRORS_RETURN),
                  "MPI_Comm_set_errhandler");
  require_success(MPI_Comm_rank(communicator_, &rank_), "MPI_Comm_rank");
  require_success(MPI_Comm_size(communicator_, &size_), "MPI_Comm_size");
}

Communicator::Communicator(Communicator&& other) noexcept
    : communicator_(std::exchange(other.communicator_, MPI_COMM_NULL)),
      rank_(std::exchange(other.rank_, 0)),
      size_(std::exchange(other.size_, 1)) {}

Communicator& Communicator::operator=(Communicator&& other) noexcept {
  std::swap(communicator_, other.communicator_);
  std::swap(rank_, other.rank_);
  std::swap(size_, other.size_);
  return *this;
}

Communicator::~Communicator() {
  if (communicator_ == MPI_COMM_NULL) {
    return;
  }
  int finalized = 0;
  MPI_Finalized(&finalized);
  if (finalized == 0) {
    MPI_Comm_free(&communicator_);
  }
}

void Communicator::barrier() const {
  if (communicator_ != MPI_COMM_NULL) {
    require_success(MPI_Barrier(communicator_), "MPI_Barrier");
  }
}

std::vector<std::string> Communicator::all_gather(const std::string& bytes) const {
  if (communicator_ == MPI_COMM_NULL) {
    return {bytes};
  }
  const auto ranks = static_cast<std::size_t>(size_);
  // Lengths travel as 64 bits, so that a message that is too long is seen, and refused, by all.
  const auto own_length = static_cast<unsigned long long>(bytes.size());
  std::vector<unsigned long long> sizes(ranks);
  require_success(MPI_Allgather(&own_length, 1, MPI_UNSIGNED_LONG_LONG, sizes.data(), 1,
                                MPI_UNSIGNED_LONG_LONG, communicator_),
                  "MPI_Allgather");
  const auto total = std::accumulate(sizes.begin(), sizes.end(), 0ULL);
  message_length(total, rank_);
  std::vector<int> lengths(ranks);
  std::vector<int> offsets(ranks);
  int offset = 0;
  for (std::size_t i = 0; i < ranks; ++i) {
    lengths[i] = static_cast<int>(sizes[i]);
    offsets[i] = offset;
    offset += lengths[i];
  }
  std::string joined(static_cast<std::size_t>(offset), '\0');
  require_success(
      MPI_Allgatherv(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, joined.data(),
                     lengths.data(), offsets.data(), MPI_BYTE, communicator_),
      "MPI_Allgatherv");
  std::vector<std::string> all;
  all.reserve(ranks);
  for (std::size_t i = 0; i < ranks; ++i) {
    all.push_back(
        joined.substr(static_cast<std::size_t>(offsets[i]), static_cast<std::size_t>(lengths[i])));
  }
  return all;
}

void Communicator::all_gather_ranges(const double* own, std::size_t size, double* whole,
                                     std::size_t whole_size) const {
  std::vector<unsigned long long> sizes(static_cast<std::size_t>(size_));
  // Both lengths travel, so that a rank which expects another total is seen, and refused, by all.
  std::vector<unsigned long long> totals(sizes.size(), whole_size);
  sizes[0] = size;
  if (communicator_ != MPI_COMM_NULL) {
    const std::array<unsigned long long, 2> mine = {size, whole_size};
    std::vector<unsigned long long> pairs(2 * sizes.size());
    require_success(MPI_Allgather(mine.data(), 2, MPI_UNSIGNED_LONG_LONG, pairs.data(), 2,
                                  MPI_UNSIGNED_LONG_LONG, communicator_),
                    "MPI_Allgather");
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      sizes[i] = pairs[2 * i];
      totals[i] = pairs[2 * i + 1];
    }
  }
  const auto sum = std::accumulate(sizes.begin(), sizes.end(), 0ULL);
  for (std::size_t i = 0; i < totals.size(); ++i) {
    if (totals[i] != sum) {
      throw EnvironmentError(
          fmt::format("the ranks hold {} values together, but rank {} expects {}; give every row "
                      "of a system to one rank",
                      sum, i, totals[i]));
    }
  }
  if (communicator_ == MPI_COMM_NULL) {
    std::copy(own, own + size, whole);
    return;
  }
  message_length(sum * sizeof(double), rank_);
  std::vector<int> lengths(sizes.size());
  std::vector<int> offsets(sizes.size());
  int offset = 0;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    lengths[i] = static_cast<int>(sizes[i]);
    offsets[i] = offset;
    offset += lengths[i];
  }
  require_success(MPI_Allgatherv(own, static_cast<int>(size), MPI_DOUBLE, whole, lengths.data(),
                                 offsets.data(), MPI_DOUBLE, communicator_),
                  "MPI_Allgatherv");
}

std::string Communicator::broadcast(const std::string& bytes) const {
  if (communicator_ == MPI_COMM_NULL) {
    return bytes;
  }
  unsigned long long size = bytes.size();
  require_success(MPI_Bcast(&size, 1, MPI_UNSIGNED_LONG_LONG, 0, communicator_), "MPI_Bcast");
  const int length = message_length(size, 0);
  std::string received = is_root() ? bytes : std::string(size, '\0');
  require_success(MPI_Bcast(received.data(), length, MPI_BYTE, 0, communicator_), "MPI_Bcast");
  return received;
}

void Communicator::agree(const std::string& failure) const {
  const std::vector<std::string> failures = all_gather(failure);
  std::string joined;
  for (std::size_t i = 0; i < failures.size(); ++i) {
    if (!failures[i].empty()) {
      joined += fmt::format("{}rank {}: {}", joined.empty() ? "" : "\n", i, failures[i]);
    }
  }
  if (!joined.empty()) {
    throw EnvironmentError(joined);
  }
}

}  // namespace hemoscale::micro
