#include "micro/linear/hypre_solver.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <algorithm>
#include <cmath>

#include "micro/error.hpp"
#include "micro/linear/boomer_amg.hpp"
#include "micro/linear/check_finite.hpp"
#include "micro/linear/outer_iteration.hpp"

namespace hemoscale::micro {
namespace {

// Turns the fault of any rank, an empty string for none, into the same NumericalError on all.
void require_no_fault(const Communicator& ranks, const std::string& fault) {
  const std::vector<std::string> faults = ranks.all_gather(fault);
  for (std::size_t rank = 0; rank < faults.size(); ++rank) {
    if (!faults[rank].empty()) {
      throw NumericalError(fmt::format("rank {}: {}", rank, faults[rank]));
    }
  }
}

}  // namespace

HypreSolver::HypreSolver(const Communicator& ranks, bool symmetric, const SolveTolerance& tolerance,
                         std::optional<ConstantNullSpace> null_space)
    : ranks_(ranks), symmetric_(symmetric), tolerance_(tolerance), null_space_(null_space) {
  if (!is_usable()) {
    throw EnvironmentError(
        "hypre needs MPI, which is not initialised or already finalised in this process; start the "
        "program with MPI, or choose another solver");
  }
}

HypreSolver::~HypreSolver() = default;

bool HypreSolver::is_usable() {
  int initialised = 0;
  int finalised = 0;
  MPI_Initialized(&initialised);
  MPI_Finalized(&finalised);
  return initialised != 0 && finalised == 0;
}

std::string HypreSolver::take_rows() {
  const SparsePattern& pattern = *matrix_.pattern;
  try {
    check_finite(matrix_);
    if (null_space_) {
      check_null_space(matrix_, *null_space_);
    }
  } catch (const NumericalError& error) {
    return error.what();
  }
  rows_.resize(pattern.rows());
  for (std::size_t i = 0; i < pattern.rows(); ++i) {
    const double diagonal =
        matrix_.values[pattern.entry(i, static_cast<std::int32_t>(pattern.row_begin + i))];
    rows_[i] = symmetric_ ? std::copysign(1.0, diagonal) : 1 / diagonal;
    if (diagonal == 0 || (symmetric_ && rows_[i] != rows_[0])) {
      return fmt::format("diagonal entry {} is {:.3g}; hypre needs {}; choose a direct solver",
                         pattern.row_begin + i, diagonal,
                         symmetric_ ? "a definite matrix" : "diagonals that are not zero");
    }
  }
  return "";
}

void HypreSolver::prepare(const SparseMatrix& matrix) {
  multigrid_.reset();
  matrix_ = matrix;
  require_no_fault(ranks_, take_rows());
  // A rank without rows has no sign of its own.
  std::string signs;
  for (const std::string& each : ranks_.all_gather(
           symmetric_ && !rows_.empty() ? std::string(rows_[0] < 0 ? "-" : "+") : std::string())) {
    signs += each;
  }
  negative_ = signs.find('-') != std::string::npos;
  if (negative_ && signs.find('+') != std::string::npos) {
    throw NumericalError(
        "diagonal entries are positive on some ranks and negative on others; hypre needs a "
        "definite "
        "matrix; choose a direct solver");
  }
  const MPI_Comm native = ranks_.native() == MPI_COMM_NULL ? MPI_COMM_SELF : ranks_.native();
  std::string fault;
  try {
    multigrid_ = std::make_unique<BoomerAmg>(native, matrix_, rows_, null_space_.has_value());
  } catch (const NumericalError& error) {
    fault = error.what();
  }
  try {
    require_no_fault(ranks_, fault);
  } catch (...) {
    multigrid_.reset();
    throw;
  }
}

SolveReport HypreSolver::solve(std::span<const double> b, std::span<double> x) {
  if (!multigrid_ || b.size() != matrix_.pattern->global_rows || x.size() != b.size()) {
    throw ParameterError(fmt::format(
        "vectors of {} and {} values do not fit the {} rows that were prepared on all ranks",
        b.size(), x.size(), multigrid_ ? matrix_.pattern->global_rows : 0));
  }
  const OuterIteration iteration{symmetric_, negative_, tolerance_, null_space_};
  const std::size_t begin = matrix_.pattern->row_begin;
  std::vector<double> own(matrix_.rows());
  std::vector<double> corrected(matrix_.rows());
  return iteration.solve(
      [&](std::span<const double> v, std::span<double> y) {
        multiply(matrix_, v, own);
        ranks_.all_gather_ranges(own.data(), own.size(), y.data(), y.size());
      },
      [&](std::span<double> r, std::span<double> z) {
        for (std::size_t i = 0; i < own.size(); ++i) {
          own[i] = rows_[i] * r[begin + i];
        }
        multigrid_->apply(own, corrected);
        ranks_.all_gather_ranges(corrected.data(), corrected.size(), z.data(), z.size());
      },
      b, x);
}

std::string HypreSolver::describe() const {
  return fmt::format("{} with hypre's algebraic multigrid on {} rank{}",
                     symmetric_ ? "conjugate gradients" : "GMRES", ranks_.size(),
                     ranks_.size() == 1 ? "" : "s");
}

}  // namespace hemoscale::micro
