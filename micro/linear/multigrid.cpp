#include "micro/linear/multigrid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "micro/linear/galerkin.hpp"
#include "micro/linear/sparse_direct_solver.hpp"

namespace hemoscale::micro {
namespace {

constexpr std::size_t worth_threads = 8192;  // rows

// The power method finds the largest eigenvalue from below.
constexpr int power_steps = 10;
constexpr float eigenvalue_margin = 1.1F;

// Added to the diagonal of the coarsest matrix, in parts of it: that matrix is singular where two
// hats look the same to the few nodes that they share.
constexpr double coarsest_shift = 1e-10;

std::size_t index(std::int32_t i) {
  return static_cast<std::size_t>(i);
}

// In [-1, 1], different for every node: excites all eigenvectors.
float scattered(std::size_t i) {
  auto h = static_cast<std::uint64_t>(i) * 0x9E3779B97F4A7C15ULL;
  h ^= h >> 32;
  h *= 0xD6E8FEB86659FD93ULL;
  return static_cast<float>(h >> 40) * 0x1p-23F - 1.0F;
}

float norm(const std::vector<float>& v) {
  double sum = 0;
  for (const float each : v) {
    sum += static_cast<double>(each) * static_cast<double>(each);
  }
  return static_cast<float>(std::sqrt(sum));
}

}  // namespace

struct Multigrid::Level {
  std::shared_ptr<const SparsePattern> pattern;
  std::vector<float> values;
  std::vector<float> inverse_diagonal;
  float largest = 0;  // bound of the eigenvalues of D^-1 A

  // Vectors of a cycle: solution, residual, the last step and the next.
  std::vector<float> x, r, d, next;

  std::size_t size() const { return pattern->rows(); }

  float row_times(std::size_t i, const std::vector<float>& v) const {
    const std::int32_t* columns = pattern->columns.data();
    float sum = 0;
    for (std::int64_t k = pattern->first[i]; k < pattern->first[i + 1]; ++k) {
      sum += values[static_cast<std::size_t>(k)] * v[index(columns[k])];
    }
    return sum;
  }

  void take(const SparseMatrix& matrix, std::span<const double> rows) {
    pattern = matrix.pattern;
    values.resize(matrix.values.size());
    inverse_diagonal.resize(size());
    for (auto* v : {&x, &r, &d, &next}) {
      v->resize(size());
    }
#pragma omp parallel for schedule(static) if (size() > worth_threads)
    for (std::size_t i = 0; i < size(); ++i) {
      const double factor = rows.empty() ? 1 : rows[i];  // lattices need none
      for (auto k = static_cast<std::size_t>(pattern->first[i]);
           k < static_cast<std::size_t>(pattern->first[i + 1]); ++k) {
        values[k] = static_cast<float>(factor * matrix.values[k]);
        if (index(pattern->columns[k]) == i) {
          inverse_diagonal[i] = static_cast<float>(1 / (factor * matrix.values[k]));
        }
      }
    }
    bound_eigenvalues();
  }

  void bound_eigenvalues() {
    for (std::size_t i = 0; i < size(); ++i) {
      d[i] = scattered(i);
    }
    for (int step = 0; step < power_steps; ++step) {
      const float scale = 1 / norm(d);
#pragma omp parallel for schedule(static) if (size() > worth_threads)
      for (std::size_t i = 0; i < size(); ++i) {
        next[i] = scale * inverse_diagonal[i] * row_times(i, d);
      }
      std::swap(d, next);
    }
    largest = eigenvalue_margin * norm(d);
  }

  // d <- old d + new D^-1 r;  x <- x + d
  void first_step(float fresh) {
#pragma omp parallel for schedule(static) if (size() > worth_threads)
    for (std::size_t i = 0; i < size(); ++i) {
      d[i] = fresh * inverse_diagonal[i] * r[i];
      x[i] = d[i];
    }
  }

  // r <- r - A d
  void update_residual() {
#pragma omp parallel for schedule(static) if (size() > worth_threads)
    for (std::size_t i = 0; i < size(); ++i) {
      r[i] -= row_times(i, d);
    }
  }

  // r <- r - A d, then d <- old d + fresh D^-1 r and x <- x + d in the same pass.
  void step(float old, float fresh) {
#pragma omp parallel for schedule(static) if (size() > worth_threads)
    for (std::size_t i = 0; i < size(); ++i) {
      const float residual = r[i] - row_times(i, d);
      r[i] = residual;
      next[i] = old * d[i] + fresh * inverse_diagonal[i] * residual;
      x[i] += next[i];
    }
    std::swap(d, next);
  }

  // Steps first, ..., degree of the Chebyshev iteration of the fourth kind.
  void smooth(int first, int degree) {
    for (int k = first; k <= degree; ++k) {
      const auto n = static_cast<float>(k);
      step(k == 1 ? 0.0F : (2 * n - 3) / (2 * n + 1), (8 * n - 4) / (2 * n + 1) / largest);
    }
  }
};

Multigrid::Multigrid(std::vector<Interpolation> interpolations, const Smoothing& smoothing)
    : interpolations_(std::move(interpolations)), smoothing_(smoothing) {}
Multigrid::~Multigrid() = default;
Multigrid::Multigrid(Multigrid&&) noexcept = default;
Multigrid& Multigrid::operator=(Multigrid&&) noexcept = default;

std::size_t Multigrid::levels() const {
  return levels_.size() + 1;
}
std::size_t Multigrid::coarsest_size() const {
  return coarsest_r_.size();
}

void Multigrid::prepare(const SparseMatrix& matrix, std::span<const double> rows, bool symmetric,
                        bool constant_null) {
  levels_.resize(interpolations_.size());
  SparseMatrix coarse;
  for (std::size_t number = 0; number < levels_.size(); ++number) {
    if (!levels_[number]) {
      levels_[number] = std::make_unique<Level>();
    }
    const SparseMatrix& fine = number == 0 ? matrix : coarse;
    const std::span<const double> factors = number == 0 ? rows : std::span<const double>();
    levels_[number]->take(fine, factors);
    coarse = galerkin_product(fine, factors, interpolations_[number]);
  }
  for (std::size_t i = 0; i < coarse.rows(); ++i) {
    coarse.values[coarse.pattern->entry(i, static_cast<std::int32_t>(i))] *= 1 + coarsest_shift;
  }
  coarsest_r_.resize(coarse.rows());
  coarsest_x_.resize(coarse.rows());
  coarsest_.reset();
  if (coarse.rows() > 0) {  // none if every row stands alone
    const auto null_space = constant_null ? std::make_optional(ConstantNullSpace())
                                          : std::optional<ConstantNullSpace>();
    coarsest_ =
        std::make_unique<SparseDirectSolver>(symmetric, SolveTolerance{1e-2, 1}, null_space);
    coarsest_->prepare(coarse);
  }
}

void Multigrid::cycle(std::size_t number) const {
  Level& level = *levels_[number];
  const Interpolation& p = interpolations_[number];
  const int degree = number == 0 ? smoothing_.fine : smoothing_.coarse;
  level.first_step(4.0F / 3.0F / level.largest);
  level.smooth(2, degree);
  level.update_residual();
  const bool last = number + 1 == levels_.size();
  const auto restricted = [&](std::size_t j) {
    float sum = 0;
    for (auto c = index(p.coarse_first[j]); c < index(p.coarse_first[j + 1]); ++c) {
      sum += p.coarse_weight[c] * level.r[index(p.fine[c])];
    }
    return sum;
  };
  const std::size_t coarse_size = p.coarse_size();
  if (last) {
    for (std::size_t j = 0; j < coarse_size; ++j) {
      coarsest_r_[j] = static_cast<double>(restricted(j));
    }
    if (coarsest_) {
      coarsest_->solve(coarsest_r_, coarsest_x_);
    }
  } else {
    std::vector<float>& r = levels_[number + 1]->r;
#pragma omp parallel for schedule(static) if (level.size() > worth_threads)
    for (std::size_t j = 0; j < coarse_size; ++j) {
      r[j] = restricted(j);
    }
    cycle(number + 1);
  }
#pragma omp parallel for schedule(static) if (level.size() > worth_threads)
  for (std::size_t i = 0; i < level.size(); ++i) {
    float sum = 0;
    for (auto c = index(p.first[i]); c < index(p.first[i + 1]); ++c) {
      const std::size_t j = index(p.coarse[c]);
      const float value = last ? static_cast<float>(coarsest_x_[j]) : levels_[number + 1]->x[j];
      sum += p.weight[c] * value;
    }
    level.d[i] = sum;
    level.x[i] += sum;
  }
  level.smooth(1, degree);
}

void Multigrid::apply(std::span<const double> r, std::span<double> z) const {
  Level& level = *levels_.front();
  double largest = 0;
  for (const double each : r) {
    largest = std::max(largest, std::abs(each));
  }
  // Single precision holds few powers of ten: work with values near one.
  int exponent = 0;
  std::frexp(largest, &exponent);
  const double scale = std::ldexp(1.0, -exponent);
  const double back = std::ldexp(1.0, exponent);
#pragma omp parallel for schedule(static) if (level.size() > worth_threads)
  for (std::size_t i = 0; i < level.size(); ++i) {
    level.r[i] = static_cast<float>(scale * r[i]);
  }
  cycle(0);
#pragma omp parallel for schedule(static) if (level.size() > worth_threads)
  for (std::size_t i = 0; i < level.size(); ++i) {
    z[i] = back * static_cast<double>(level.x[i]);
  }
}

}  // namespace hemoscale::micro
