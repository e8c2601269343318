#pragma once

#include <mpi.h>

#include <cstdint>
#include <string>
#include <vector>

#include "micro/parallel/communicator.hpp"

namespace hemoscale::micro::regions {

/// Bytes for a rank, or from one.
struct Message {
  int rank = 0;
  std::string bytes;
};

/// Messages between the ranks of a group that never hold a core while they wait: a rank that has
/// nothing to do tests, gives way, and after a few times sleeps, because a blocking call of MPI
/// would take the core from the rank that it waits for. All methods are collective.
class RankMessages {
 public:
  explicit RankMessages(const Communicator& communicator);

  int rank() const { return own_.rank(); }
  int size() const { return own_.size(); }
  MPI_Comm native() const { return own_.native(); }

  /// Waits for all requests. Returns the seconds that this took.
  double wait(std::vector<MPI_Request>& requests) const;

  /// Sends the messages, of any length, and returns those for this rank in the order of their
  /// senders; nobody needs to know who sends. A message to oneself is allowed.
  std::vector<Message> exchange(std::vector<Message> outgoing) const;

  /// The same between ranks that know each other: one message to, and one from, each of `others`.
  std::vector<Message> exchange_with(const std::vector<Message>& outgoing) const;

  std::vector<std::int64_t> sum(std::vector<std::int64_t> values) const;
  double smallest(double value) const;
  double largest(double value) const;

  /// The same number of values from every rank, in the order of the ranks.
  std::vector<double> gather(const std::vector<double>& values) const;

  /// Joins small arrays by an operation of MPI, in place.
  void reduce(void* values, int count, MPI_Datatype type, MPI_Op operation) const;

 private:
  std::vector<Message> pass(const std::vector<Message>& outgoing,
                            const std::vector<std::pair<int, std::int64_t>>& incoming) const;

  Communicator own_;  // duplicate: its messages meet no others
};

/// @throws EnvironmentError if an MPI call failed
void require_mpi(int code, const char* call);

}  // namespace hemoscale::micro::regions
