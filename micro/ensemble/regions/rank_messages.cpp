#include "micro/ensemble/regions/rank_messages.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <thread>
#include <utility>

#include "micro/error.hpp"

namespace hemoscale::micro::regions {
namespace {

constexpr int tag_of_sparse = 1;
constexpr std::int64_t largest_piece = 1 << 30;  // [bytes] MPI counts in int

// Tests before the first sleep, and sleeps that grow: a message that is nearly there is not missed
// by much, and a long wait costs the others nothing.
constexpr int patience = 20;
constexpr std::chrono::microseconds shortest_sleep{20};
constexpr std::chrono::microseconds longest_sleep{200};

Communicator duplicate(const Communicator& communicator) {
  return communicator.native() == MPI_COMM_NULL ? Communicator()
                                                : Communicator(communicator.native());
}

}  // namespace

void require_mpi(int code, const char* call) {
  if (code == MPI_SUCCESS) return;
  char text[MPI_MAX_ERROR_STRING + 1] = "no reason given";
  int length = 0;
  MPI_Error_string(code, text, &length);
  throw EnvironmentError(fmt::format("{} failed: {}; check that all ranks are alive", call, text));
}

RankMessages::RankMessages(const Communicator& communicator) : own_(duplicate(communicator)) {}

double RankMessages::wait(std::vector<MPI_Request>& requests) const {
  const auto begin = std::chrono::steady_clock::now();
  std::chrono::microseconds sleep = shortest_sleep;
  for (int tests = 0;; ++tests) {
    int done = 0;
    require_mpi(
        MPI_Testall(static_cast<int>(requests.size()), requests.data(), &done, MPI_STATUSES_IGNORE),
        "MPI_Testall");
    if (done != 0) break;
    if (tests < patience) {
      std::this_thread::yield();
    } else {
      std::this_thread::sleep_for(sleep);
      sleep = std::min(2 * sleep, longest_sleep);
    }
  }
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

std::vector<Message> RankMessages::pass(
    const std::vector<Message>& outgoing,
    const std::vector<std::pair<int, std::int64_t>>& incoming) const {
  std::vector<Message> received;
  std::vector<MPI_Request> requests;
  for (const auto& [from, bytes] : incoming) {
    received.push_back({from, std::string(static_cast<std::size_t>(bytes), '\0')});
  }
  for (Message& message : received) {
    const auto size = static_cast<std::int64_t>(message.bytes.size());
    for (std::int64_t at = 0; at < size; at += largest_piece) {
      requests.push_back(MPI_REQUEST_NULL);
      require_mpi(
          MPI_Irecv(message.bytes.data() + at, static_cast<int>(std::min(largest_piece, size - at)),
                    MPI_BYTE, message.rank, tag_of_sparse, own_.native(), &requests.back()),
          "MPI_Irecv");
    }
  }
  for (const Message& message : outgoing) {
    const auto size = static_cast<std::int64_t>(message.bytes.size());
    for (std::int64_t at = 0; at < size; at += largest_piece) {
      requests.push_back(MPI_REQUEST_NULL);
      require_mpi(
          MPI_Isend(message.bytes.data() + at, static_cast<int>(std::min(largest_piece, size - at)),
                    MPI_BYTE, message.rank, tag_of_sparse, own_.native(), &requests.back()),
          "MPI_Isend");
    }
  }
  wait(requests);
  return received;
}

std::vector<Message> RankMessages::exchange(std::vector<Message> outgoing) const {
  if (size() == 1) return outgoing;
  std::vector<std::int64_t> sent(static_cast<std::size_t>(size()), 0);
  std::vector<std::int64_t> arriving(sent.size(), 0);
  for (const Message& message : outgoing) {
    sent[static_cast<std::size_t>(message.rank)] = static_cast<std::int64_t>(message.bytes.size());
  }
  std::vector<MPI_Request> request(1, MPI_REQUEST_NULL);
  require_mpi(MPI_Ialltoall(sent.data(), 1, MPI_INT64_T, arriving.data(), 1, MPI_INT64_T,
                            own_.native(), request.data()),
              "MPI_Ialltoall");
  wait(request);
  std::vector<std::pair<int, std::int64_t>> incoming;
  for (int from = 0; from < size(); ++from) {
    const std::int64_t bytes = arriving[static_cast<std::size_t>(from)];
    if (bytes > 0) incoming.emplace_back(from, bytes);
  }
  return pass(outgoing, incoming);
}

std::vector<Message> RankMessages::exchange_with(const std::vector<Message>& outgoing) const {
  std::vector<std::int64_t> sent;
  std::vector<std::int64_t> arriving(outgoing.size(), 0);
  for (const Message& message : outgoing) {
    sent.push_back(static_cast<std::int64_t>(message.bytes.size()));
  }
  std::vector<MPI_Request> requests(2 * outgoing.size(), MPI_REQUEST_NULL);
  for (std::size_t k = 0; k < outgoing.size(); ++k) {
    require_mpi(MPI_Irecv(&arriving[k], 1, MPI_INT64_T, outgoing[k].rank, tag_of_sparse,
                          own_.native(), &requests[2 * k]),
                "MPI_Irecv");
    require_mpi(MPI_Isend(&sent[k], 1, MPI_INT64_T, outgoing[k].rank, tag_of_sparse, own_.native(),
                          &requests[2 * k + 1]),
                "MPI_Isend");
  }
  wait(requests);
  std::vector<std::pair<int, std::int64_t>> incoming;
  for (std::size_t k = 0; k < outgoing.size(); ++k) {
    incoming.emplace_back(outgoing[k].rank, arriving[k]);
  }
  return pass(outgoing, incoming);
}

void RankMessages::reduce(void* values, int count, MPI_Datatype type, MPI_Op operation) const {
  if (size() == 1) return;
  std::vector<MPI_Request> request(1, MPI_REQUEST_NULL);
  require_mpi(
      MPI_Iallreduce(MPI_IN_PLACE, values, count, type, operation, own_.native(), request.data()),
      "MPI_Iallreduce");
  wait(request);
}

std::vector<std::int64_t> RankMessages::sum(std::vector<std::int64_t> values) const {
  reduce(values.data(), static_cast<int>(values.size()), MPI_INT64_T, MPI_SUM);
  return values;
}
double RankMessages::smallest(double value) const {
  reduce(&value, 1, MPI_DOUBLE, MPI_MIN);
  return value;
}
double RankMessages::largest(double value) const {
  reduce(&value, 1, MPI_DOUBLE, MPI_MAX);
  return value;
}

std::vector<double> RankMessages::gather(const std::vector<double>& values) const {
  if (size() == 1) return values;
  const int count = static_cast<int>(values.size());
  std::vector<double> all(values.size() * static_cast<std::size_t>(size()));
  std::vector<MPI_Request> request(1, MPI_REQUEST_NULL);
  require_mpi(MPI_Iallgather(values.data(), count, MPI_DOUBLE, all.data(), count, MPI_DOUBLE,
                             own_.native(), request.data()),
              "MPI_Iallgather");
  wait(request);
  return all;
}

}  // namespace hemoscale::micro::regions
