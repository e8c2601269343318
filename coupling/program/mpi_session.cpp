#include "coupling/program/mpi_session.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

#include "coupling/error.hpp"

namespace hemoscale::coupling {

bool is_launched_by_mpi() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMIX_RANK", "PMI_RANK", "PMI_SIZE"}) {
    if (std::getenv(name) != nullptr) return true;
  }
  return false;
}

MpiSession::MpiSession(int* count, char*** arguments) {
  int provided = MPI_THREAD_SINGLE;
  MPI_Init_thread(count, arguments, MPI_THREAD_FUNNELED, &provided);
  if (provided < MPI_THREAD_FUNNELED) {
    MPI_Finalize();
    throw EnvironmentError(
        "this MPI was built without support of threads (MPI_THREAD_FUNNELED), which the micro "
        "models "
        "need; use Debian's openmpi-bin");
  }
  MPI_Comm_dup(MPI_COMM_WORLD, &ends_);
  MPI_Comm_rank(ends_, &rank_);
  MPI_Comm_size(ends_, &size_);
}

MpiSession::~MpiSession() {
  MPI_Comm_free(&ends_);
  MPI_Finalize();
}

micro::Communicator MpiSession::communicator() const {
  return micro::Communicator(MPI_COMM_WORLD);
}

Outcome MpiSession::end_together(const Outcome& own, double patience) {
  using Clock = std::chrono::steady_clock;
  std::vector<int> codes(static_cast<std::size_t>(size_), exit_done);
  const int own_code = own.exit_code;
  MPI_Request request = MPI_REQUEST_NULL;
  MPI_Iallgather(&own_code, 1, MPI_INT, codes.data(), 1, MPI_INT, ends_, &request);

  // Higher ranks wait a little longer, so that of several only one speaks.
  const auto deadline =
      Clock::now() + std::chrono::duration_cast<Clock::duration>(
                         std::chrono::duration<double>(patience * (1 + 0.1 * rank_)));
  int all_arrived = 0;
  for (MPI_Test(&request, &all_arrived, MPI_STATUS_IGNORE); all_arrived == 0;
       MPI_Test(&request, &all_arrived, MPI_STATUS_IGNORE)) {
    if (own_code != exit_done && Clock::now() > deadline) {
      const std::string text =
          fmt::format("{}  on rank {} of {}; the others are ended\n", own.message, rank_, size_);
      std::fputs(text.c_str(), stderr);
      std::fflush(stderr);
      MPI_Abort(MPI_COMM_WORLD, own_code);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  MPI_Wait(&request, MPI_STATUS_IGNORE);  // complete: returns at once

  Outcome shared;
  int failed = 0;
  int first_failed = -1;
  for (int rank = 0; rank < size_; ++rank) {
    const int code = codes[static_cast<std::size_t>(rank)];
    if (code == exit_done) continue;
    ++failed;
    if (first_failed >= 0) continue;
    first_failed = rank;
    shared.exit_code = code;
  }
  if (rank_ == first_failed) {
    shared.message = own.message;
    if (failed < size_) {
      shared.message += fmt::format("  on rank {}, the first of {} of {} ranks that failed\n",
                                    rank_, failed, size_);
    }
  }
  return shared;
}

}  // namespace hemoscale::coupling
