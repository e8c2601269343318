#pragma once

#include <mpi.h>

#include <cstddef>
#include <string>
#include <vector>

namespace hemoscale::micro {

/// A group of ranks, or the single process when MPI is not in use. Libraries take one; only the
/// hosts (program, plug-in) make one, and the world communicator is named there alone.
///
/// C++17-clean: the OpenFOAM plug-in includes it.
class Communicator {
 public:
  /// The process alone; needs no MPI_Init.
  Communicator() = default;

  /// Duplicates `communicator`; the caller keeps MPI alive longer than this object.
  explicit Communicator(MPI_Comm communicator);

  Communicator(const Communicator&) = delete;
  Communicator& operator=(const Communicator&) = delete;
  Communicator(Communicator&& other) noexcept;
  Communicator& operator=(Communicator&& other) noexcept;
  ~Communicator();

  int rank() const { return rank_; }
  int size() const { return size_; }
  bool is_root() const { return rank_ == 0; }

  void barrier() const;

  /// Byte strings of all ranks, in the order of the ranks, on every rank.
  std::vector<std::string> all_gather(const std::string& bytes) const;

  /// Joins the ranges of all ranks, in the order of the ranks, on every rank.
  /// @param own    `size` values of this rank
  /// @param whole  room for `whole_size` values, the sum of all sizes
  /// @throws EnvironmentError on every rank if the sizes do not add up
  void all_gather_ranges(const double* own, std::size_t size, double* whole,
                         std::size_t whole_size) const;

  /// The root's byte string on every rank.
  std::string broadcast(const std::string& bytes) const;

  /// For libraries that take a communicator themselves; MPI_COMM_NULL of the process alone.
  MPI_Comm native() const { return communicator_; }

  /// Turns a failure on any rank into the same failure on all of them. Every rank calls it at the
  /// same place, with its own message or an empty string for success.
  /// @throws EnvironmentError on every rank, listing "rank i: reason", if any message is not empty
  void agree(const std::string& failure) const;

 private:
  MPI_Comm communicator_ = MPI_COMM_NULL;
  int rank_ = 0;
  int size_ = 1;
};

}  // namespace hemoscale::micro
