#pragma once

#include <vector>

namespace hemoscale::coupling {

/// A value to be fitted with its standard error; 0 for an exact value.
struct Uncertain {
  double value = 0;
  double error = 0;
};

/// Weighted mean with weights 1 / error^2. Exact values, if there are any, have infinite weight:
/// the result is then their plain mean.
/// @param first, last  range of `values`, both included
double weighted_mean(const std::vector<Uncertain>& values, std::size_t first, std::size_t last);

struct MonotoneFit {
  std::vector<double> values;
  std::vector<std::size_t>
      block_begin;                     // of each entry: first entry of the block it was pooled into
  std::vector<std::size_t> block_end;  // one past the last entry of that block
};

/// Weighted least-squares fit under the constraint that the values do not increase, by pooling
/// adjacent violators (Ayer, Brunk, Ewing, Reid and Silverman 1955; Barlow, Bartholomew, Bremner
/// and Brunk 1972).
MonotoneFit fit_not_increasing(const std::vector<Uncertain>& values);

}  // namespace hemoscale::coupling
