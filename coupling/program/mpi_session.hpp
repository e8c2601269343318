#pragma once

#include <mpi.h>

#include "coupling/program/failure.hpp"
#include "micro/parallel/communicator.hpp"

namespace hemoscale::coupling {

/// Whether a launcher (mpirun, srun) started this process as one of several; from the environment,
/// as MPI itself finds out.
bool is_launched_by_mpi();

/// MPI from construction to destruction, and the end of a run that all ranks share.
///
/// A program that runs alone does without: starting MPI costs time, and leaves variables in the
/// environment that keep a child from starting MPI of its own.
class MpiSession {
 public:
  /// @throws EnvironmentError if MPI lacks the level of thread support that is needed (funneled)
  MpiSession(int* count, char*** arguments);
  ~MpiSession();
  MpiSession(const MpiSession&) = delete;
  MpiSession& operator=(const MpiSession&) = delete;

  int rank() const { return rank_; }
  int size() const { return size_; }

  /// All ranks of the run. Must be gone before the session.
  micro::Communicator communicator() const;

  /// Brings all ranks to one end. Every rank calls it once, with its own outcome.
  ///
  /// If all ranks arrive, each gets the exit code of the lowest rank that failed, and the message
  /// goes to that rank alone. If some never arrive, because they wait for a rank that failed, the
  /// failed rank prints its message after `patience` and ends the others (MPI_Abort).
  ///
  /// @param patience  how long a rank that failed waits for the others [s]
  Outcome end_together(const Outcome& own, double patience = 10);

 private:
  MPI_Comm ends_ = MPI_COMM_NULL;  // apart from the communication of the run
  int rank_ = 0;
  int size_ = 1;
};

}  // namespace hemoscale::coupling
