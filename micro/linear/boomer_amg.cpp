#include "micro/linear/boomer_amg.hpp"

#include <HYPRE.h>
#include <HYPRE_IJ_mv.h>
#include <HYPRE_parcsr_ls.h>
#include <fmt/format.h>

#include <cstdint>
#include <mutex>
#include <numeric>
#include <vector>

#include "micro/error.hpp"
#include "micro/linear/one_blas_thread.hpp"

namespace hemoscale::micro {
namespace {

static_assert(sizeof(HYPRE_Int) == sizeof(std::int32_t) &&
                  sizeof(HYPRE_BigInt) == sizeof(std::int32_t),
              "hypre with 32-bit indices");

// hypre's numbers of its methods (reference manual, BoomerAMG).
constexpr HYPRE_Int coarsen_hmis = 10;
constexpr HYPRE_Int interpolate_extended = 6;
constexpr HYPRE_Int relax_l1_symmetric = 8;  // l1-scaled symmetric Gauss-Seidel within a rank
constexpr HYPRE_Int at_coarsest = 3;         // "cycle" number that stands for the coarsest level

constexpr HYPRE_Int entries_per_row = 4;   // of interpolation
constexpr double strong = 0.25;            // [-] couplings above this part of the largest
constexpr HYPRE_Int coarsest_sweeps = 20;  // on the few unknowns of a singular coarsest level

// hypre keeps one error flag for the process.
void require(HYPRE_Int code, const char* call) {
  if (code == 0) {
    return;
  }
  char reason[2048] = "";  // HYPRE_DescribeError writes without asking for the size
  HYPRE_DescribeError(code, reason);
  HYPRE_ClearAllErrors();
  throw NumericalError(
      fmt::format("hypre: {} failed with code {}: {}; look for a row without a diagonal or values "
                  "that are not finite, or choose another solver",
                  call, code, reason));
}

void initialise() {
  static std::once_flag once;
  std::call_once(once, [] {
    HYPRE_Init();
    use_one_blas_thread();
  });
}

}  // namespace

struct BoomerAmg::Handles {
  HYPRE_IJMatrix matrix = nullptr;
  HYPRE_IJVector right = nullptr;
  HYPRE_IJVector solution = nullptr;
  HYPRE_Solver solver = nullptr;
  std::vector<HYPRE_BigInt> numbers;  // global, of the local rows

  Handles() = default;
  Handles(const Handles&) = delete;
  Handles& operator=(const Handles&) = delete;
  ~Handles() {
    if (solver != nullptr) HYPRE_BoomerAMGDestroy(solver);
    if (solution != nullptr) HYPRE_IJVectorDestroy(solution);
    if (right != nullptr) HYPRE_IJVectorDestroy(right);
    if (matrix != nullptr) HYPRE_IJMatrixDestroy(matrix);
  }

  HYPRE_Int size() const { return static_cast<HYPRE_Int>(numbers.size()); }

  HYPRE_ParCSRMatrix parallel_matrix() const {
    void* object = nullptr;
    require(HYPRE_IJMatrixGetObject(matrix, &object), "IJMatrixGetObject");
    return static_cast<HYPRE_ParCSRMatrix>(object);
  }
  static HYPRE_ParVector parallel(HYPRE_IJVector vector) {
    void* object = nullptr;
    require(HYPRE_IJVectorGetObject(vector, &object), "IJVectorGetObject");
    return static_cast<HYPRE_ParVector>(object);
  }
};

BoomerAmg::BoomerAmg(MPI_Comm communicator, const SparseMatrix& matrix,
                     std::span<const double> rows, bool singular)
    : handles_(std::make_unique<Handles>()) {
  initialise();
  Handles& h = *handles_;
  const SparsePattern& pattern = *matrix.pattern;
  const auto begin = static_cast<HYPRE_BigInt>(pattern.row_begin);
  const auto end = begin + static_cast<HYPRE_BigInt>(pattern.rows()) - 1;
  h.numbers.resize(pattern.rows());
  std::iota(h.numbers.begin(), h.numbers.end(), begin);
  std::vector<HYPRE_Int> lengths(pattern.rows());
  std::vector<double> values(matrix.values.size());
  for (std::size_t i = 0; i < pattern.rows(); ++i) {
    lengths[i] = static_cast<HYPRE_Int>(pattern.first[i + 1] - pattern.first[i]);
    for (auto k = static_cast<std::size_t>(pattern.first[i]);
         k < static_cast<std::size_t>(pattern.first[i + 1]); ++k) {
      values[k] = rows[i] * matrix.values[k];
    }
  }
  require(HYPRE_IJMatrixCreate(communicator, begin, end, begin, end, &h.matrix), "IJMatrixCreate");
  require(HYPRE_IJMatrixSetObjectType(h.matrix, HYPRE_PARCSR), "IJMatrixSetObjectType");
  require(HYPRE_IJMatrixSetRowSizes(h.matrix, lengths.data()), "IJMatrixSetRowSizes");
  require(HYPRE_IJMatrixInitialize(h.matrix), "IJMatrixInitialize");
  require(HYPRE_IJMatrixSetValues(h.matrix, h.size(), lengths.data(), h.numbers.data(),
                                  pattern.columns.data(), values.data()),
          "IJMatrixSetValues");
  require(HYPRE_IJMatrixAssemble(h.matrix), "IJMatrixAssemble");
  for (HYPRE_IJVector* vector : {&h.right, &h.solution}) {
    require(HYPRE_IJVectorCreate(communicator, begin, end, vector), "IJVectorCreate");
    require(HYPRE_IJVectorSetObjectType(*vector, HYPRE_PARCSR), "IJVectorSetObjectType");
    require(HYPRE_IJVectorInitialize(*vector), "IJVectorInitialize");
    require(HYPRE_IJVectorAssemble(*vector), "IJVectorAssemble");
  }
  require(HYPRE_BoomerAMGCreate(&h.solver), "BoomerAMGCreate");
  HYPRE_BoomerAMGSetMaxIter(h.solver, 1);
  HYPRE_BoomerAMGSetTol(h.solver, 0);
  HYPRE_BoomerAMGSetPrintLevel(h.solver, 0);
  HYPRE_BoomerAMGSetCoarsenType(h.solver, coarsen_hmis);
  HYPRE_BoomerAMGSetInterpType(h.solver, interpolate_extended);
  HYPRE_BoomerAMGSetPMaxElmts(h.solver, entries_per_row);
  HYPRE_BoomerAMGSetStrongThreshold(h.solver, strong);
  HYPRE_BoomerAMGSetRelaxType(h.solver, relax_l1_symmetric);
  HYPRE_BoomerAMGSetRelaxOrder(h.solver, 0);
  if (singular) {
    HYPRE_BoomerAMGSetCycleRelaxType(h.solver, relax_l1_symmetric, at_coarsest);
    HYPRE_BoomerAMGSetCycleNumSweeps(h.solver, coarsest_sweeps, at_coarsest);
  }
  require(HYPRE_BoomerAMGSetup(h.solver, h.parallel_matrix(), Handles::parallel(h.right),
                               Handles::parallel(h.solution)),
          "BoomerAMGSetup");
}

BoomerAmg::~BoomerAmg() {
  int finalized = 0;
  MPI_Finalized(&finalized);
  if (finalized != 0) {
    // hypre would free its communicators, which MPI no longer knows.
    handles_.release();  // NOLINT(bugprone-unused-return-value)
  }
}

void BoomerAmg::apply(std::span<const double> r, std::span<double> z) const {
  const Handles& h = *handles_;
  require(HYPRE_IJVectorSetValues(h.right, h.size(), h.numbers.data(), r.data()),
          "IJVectorSetValues");
  require(HYPRE_ParVectorSetConstantValues(Handles::parallel(h.solution), 0),
          "ParVectorSetConstantValues");
  require(HYPRE_BoomerAMGSolve(h.solver, h.parallel_matrix(), Handles::parallel(h.right),
                               Handles::parallel(h.solution)),
          "BoomerAMGSolve");
  require(HYPRE_IJVectorGetValues(h.solution, h.size(), h.numbers.data(), z.data()),
          "IJVectorGetValues");
}

}  // namespace hemoscale::micro
