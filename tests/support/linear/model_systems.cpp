#include "tests/support/linear/model_systems.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <utility>

namespace hemoscale::micro {
namespace {

constexpr double range = 3.1;  // [-] spacings

struct Entry {
  std::int32_t column;
  double value;
};

SparseMatrix assemble(const std::vector<std::vector<Entry>>& rows) {
  auto pattern = std::make_shared<SparsePattern>();
  pattern->global_rows = rows.size();
  std::vector<double> values;
  for (const std::vector<Entry>& row : rows) {
    for (const Entry& entry : row) {
      pattern->columns.push_back(entry.column);
      values.push_back(entry.value);
    }
    pattern->first.push_back(static_cast<std::int64_t>(values.size()));
  }
  SparseMatrix matrix(pattern);
  matrix.values = std::move(values);
  return matrix;
}

SparseMatrix assemble(const std::vector<std::map<std::int32_t, double>>& rows) {
  std::vector<std::vector<Entry>> lists(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (const auto& [column, value] : rows[i]) {
      lists[i].push_back({column, value});
    }
  }
  return assemble(lists);
}

}  // namespace

template <int dim>
ModelSystem<dim> particle_laplacian(const std::vector<int>& nodes, ChannelEnds ends, double jitter,
                                    std::uint64_t seed, double uneven) {
  ModelSystem<dim> system;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> shake(-jitter, jitter);
  std::size_t total = 1;
  for (int a = 0; a < dim; ++a) {
    total *= static_cast<std::size_t>(nodes[static_cast<std::size_t>(a)]);
  }
  if (ends == ChannelEnds::periodic) {
    system.period[0] = nodes[0];
  }
  // Along the first axis slowest: columns lie together in memory.
  std::vector<std::vector<int>> steps(total, std::vector<int>(dim));
  std::vector<Vector<dim>> all(total);
  for (std::size_t i = 0; i < total; ++i) {
    std::size_t rest = i;
    for (int a = dim - 1; a >= 0; --a) {
      const auto n = static_cast<std::size_t>(nodes[static_cast<std::size_t>(a)]);
      steps[i][static_cast<std::size_t>(a)] = static_cast<int>(rest % n);
      all[i][a] = static_cast<double>(rest % n) + shake(random);
      rest /= n;
    }
  }
  const std::size_t column = total / static_cast<std::size_t>(nodes[0]);
  const std::size_t unknowns = ends == ChannelEnds::outlet ? total - column : total;
  const int reach = static_cast<int>(std::ceil(range + 2 * jitter));
  std::uniform_real_distribution<double> factor(1, 1 + uneven);
  std::vector<std::vector<Entry>> rows(unknowns);
  std::size_t offsets = 1;
  for (int a = 0; a < dim; ++a) {
    offsets *= static_cast<std::size_t>(2 * reach + 1);
  }
  for (std::size_t i = 0; i < unknowns; ++i) {
    const double scale = uneven > 0 ? factor(random) : 1;
    double diagonal = 0;
    for (std::size_t o = 0; o < offsets; ++o) {
      std::size_t rest = o;
      std::size_t j = 0;
      bool inside = true;
      Vector<dim> apart = Vector<dim>::Zero();
      for (int a = 0; a < dim; ++a) {
        const int width = 2 * reach + 1;
        const int n = nodes[static_cast<std::size_t>(a)];
        int at = steps[i][static_cast<std::size_t>(a)] - reach + static_cast<int>(rest) % width;
        rest /= static_cast<std::size_t>(width);
        if (a == 0 && system.period[0] > 0) {
          const int turn = at < 0 ? -1 : (at >= n ? 1 : 0);
          at -= turn * n;
          apart[0] = turn * system.period[0];
        }
        inside = inside && at >= 0 && at < n;
        j = j * static_cast<std::size_t>(n) + static_cast<std::size_t>(std::clamp(at, 0, n - 1));
      }
      if (!inside || j == i) continue;
      apart += all[j] - all[i];
      const double distance = apart.norm();
      if (distance >= range) continue;
      const double weight = scale * (range / distance - 1);
      diagonal += weight;
      if (j < unknowns) {
        rows[i].push_back({static_cast<std::int32_t>(j), -weight});
      }
    }
    rows[i].push_back({static_cast<std::int32_t>(i), diagonal});
    std::sort(rows[i].begin(), rows[i].end(),
              [](const Entry& a, const Entry& b) { return a.column < b.column; });
  }
  system.positions.assign(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(unknowns));
  system.matrix = assemble(rows);
  return system;
}

template ModelSystem<2> particle_laplacian<2>(const std::vector<int>&, ChannelEnds, double,
                                              std::uint64_t, double);
template ModelSystem<3> particle_laplacian<3>(const std::vector<int>&, ChannelEnds, double,
                                              std::uint64_t, double);

ModelSystem<2> least_squares_laplacian(int along, int across, double reach_in, double jitter,
                                       std::uint64_t seed, bool closed) {
  ModelSystem<2> system;
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> shake(-jitter, jitter);
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j < across; ++j) {
      // Boundary nodes move along their boundary only.
      const bool end = i == 0 || i == along - 1;
      const bool wall = j == 0 || j == across - 1;
      system.positions.push_back({i + (end ? 0 : shake(random)), j + (wall ? 0 : shake(random))});
    }
  }
  const int reach = static_cast<int>(std::ceil(reach_in + 2 * jitter));
  std::vector<std::vector<Entry>> rows(system.positions.size());
  for (int i = 0; i < along; ++i) {
    for (int j = 0; j < across; ++j) {
      const auto own = static_cast<std::size_t>(i * across + j);
      const bool end = i == 0 || i == along - 1;
      const bool wall = j == 0 || j == across - 1;
      if (end && !closed) {
        rows[own].push_back({static_cast<std::int32_t>(own), 1});
        continue;
      }
      Eigen::Matrix<double, 5, 5> moments = Eigen::Matrix<double, 5, 5>::Zero();
      std::vector<std::pair<std::int32_t, Eigen::Matrix<double, 5, 1>>> partners;
      for (int k = std::max(0, i - reach); k <= std::min(along - 1, i + reach); ++k) {
        for (int l = std::max(0, j - reach); l <= std::min(across - 1, j + reach); ++l) {
          const auto other = static_cast<std::size_t>(k * across + l);
          const Vector<2> apart = (system.positions[other] - system.positions[own]) / reach_in;
          const double distance = apart.norm();
          if (other == own || distance >= 1) continue;
          Eigen::Matrix<double, 5, 1> basis;
          basis << apart[0], apart[1], apart[0] * apart[0], apart[0] * apart[1],
              apart[1] * apart[1];
          const double weight = (1 - distance) * (1 - distance);
          moments += weight * basis * basis.transpose();
          partners.emplace_back(static_cast<std::int32_t>(other), weight * basis);
        }
      }
      Eigen::Matrix<double, 5, 1> wanted = Eigen::Matrix<double, 5, 1>::Zero();
      if (end) {
        wanted[0] = (i == 0 ? 1 : -1) / reach_in;
      } else if (wall) {
        wanted[1] = (j == 0 ? 1 : -1) / reach_in;
      } else {
        wanted[2] = wanted[4] = 2 / (reach_in * reach_in);
      }
      const Eigen::Matrix<double, 5, 1> solved = moments.ldlt().solve(wanted);
      double diagonal = 0;
      for (const auto& [other, basis] : partners) {
        const double coefficient = solved.dot(basis);
        rows[own].push_back({other, -coefficient});
        diagonal += coefficient;
      }
      rows[own].push_back({static_cast<std::int32_t>(own), diagonal});
      std::sort(rows[own].begin(), rows[own].end(),
                [](const Entry& a, const Entry& b) { return a.column < b.column; });
    }
  }
  system.matrix = assemble(rows);
  return system;
}

SparseMatrix random_matrix(std::size_t rows, std::size_t entries, bool symmetric, double dominance,
                           std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  std::uniform_int_distribution<std::size_t> place(0, rows - 1);
  std::vector<std::map<std::int32_t, double>> table(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    for (std::size_t k = 0; k < entries; ++k) {
      const std::size_t j = place(random);
      if (j == i) continue;
      const double a = value(random);
      table[i][static_cast<std::int32_t>(j)] = a;
      if (symmetric) {
        table[j][static_cast<std::int32_t>(i)] = a;
      }
    }
  }
  for (std::size_t i = 0; i < rows; ++i) {
    double sum = 0.1;
    for (const auto& [column, a] : table[i]) {
      sum += std::abs(a);
    }
    table[i][static_cast<std::int32_t>(i)] = dominance > 0 ? dominance * sum : value(random);
  }
  return assemble(table);
}

std::vector<double> random_vector(std::size_t size, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> value(-1, 1);
  std::vector<double> v(size);
  for (double& each : v) {
    each = value(random);
  }
  return v;
}

SparseMatrix sparse(const std::vector<std::vector<double>>& dense) {
  std::vector<std::vector<Entry>> rows(dense.size());
  for (std::size_t i = 0; i < dense.size(); ++i) {
    for (std::size_t j = 0; j < dense[i].size(); ++j) {
      if (dense[i][j] != 0 || i == j) {
        rows[i].push_back({static_cast<std::int32_t>(j), dense[i][j]});
      }
    }
  }
  return assemble(rows);
}

double relative_residual(const SparseMatrix& matrix, const std::vector<double>& x,
                         const std::vector<double>& b) {
  double residual = 0;
  double size = 0;
  for (std::size_t i = 0; i < matrix.rows(); ++i) {
    double sum = b[i];
    for (auto k = static_cast<std::size_t>(matrix.pattern->first[i]);
         k < static_cast<std::size_t>(matrix.pattern->first[i + 1]); ++k) {
      sum -= matrix.values[k] * x[static_cast<std::size_t>(matrix.pattern->columns[k])];
    }
    residual += sum * sum;
    size += b[i] * b[i];
  }
  return std::sqrt(residual / size);
}

}  // namespace hemoscale::micro
