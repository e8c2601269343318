#pragma once

#include <cstddef>
#include <vector>

#include "micro/parallel/communicator.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// Nodes whose rows one rank computes: consecutive ones. Every rank holds all nodes and all values;
/// what costs time (neighbours, operators, matrices) is shared.
struct NodeRange {
  std::size_t begin = 0;
  std::size_t end = 0;

  std::size_t size() const { return end - begin; }
};

/// The share of this rank.
inline NodeRange own_nodes(std::size_t count, const Communicator& ranks) {
  const auto rank = static_cast<std::size_t>(ranks.rank());
  const auto size = static_cast<std::size_t>(ranks.size());
  return {count * rank / size, count * (rank + 1) / size};
}

}  // namespace hemoscale::micro
