#include "coupling/rheology/monotone_regression.hpp"

namespace hemoscale::coupling {

double weighted_mean(const std::vector<Uncertain>& values, std::size_t first, std::size_t last) {
  double sum = 0;
  double weights = 0;
  double exact_sum = 0;
  int exact_count = 0;
  for (std::size_t i = first; i <= last; ++i) {
    const Uncertain& x = values[i];
    if (x.error == 0) {
      exact_sum += x.value;
      ++exact_count;
    } else {
      const double weight = 1 / (x.error * x.error);
      sum += weight * x.value;
      weights += weight;
    }
  }
  return exact_count > 0 ? exact_sum / exact_count : sum / weights;
}

MonotoneFit fit_not_increasing(const std::vector<Uncertain>& values) {
  struct Block {
    std::size_t begin, end;
    double mean;
  };
  std::vector<Block> blocks;
  for (std::size_t i = 0; i < values.size(); ++i) {
    blocks.push_back({i, i + 1, values[i].value});
    while (blocks.size() > 1 && blocks[blocks.size() - 2].mean < blocks.back().mean) {
      const std::size_t end = blocks.back().end;
      blocks.pop_back();
      blocks.back().end = end;
      // From the values, not from the two means: the result then does not depend on the order of
      // pooling.
      blocks.back().mean = weighted_mean(values, blocks.back().begin, end - 1);
    }
  }
  MonotoneFit fit;
  for (const Block& block : blocks) {
    for (std::size_t i = block.begin; i < block.end; ++i) {
      fit.values.push_back(block.mean);
      fit.block_begin.push_back(block.begin);
      fit.block_end.push_back(block.end);
    }
  }
  return fit;
}

}  // namespace hemoscale::coupling
