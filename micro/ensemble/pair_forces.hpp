#pragma once

#include <cstddef>

#include "micro/ensemble/box.hpp"
#include "micro/ensemble/neighbour_list.hpp"
#include "micro/ensemble/pair_potential.hpp"
#include "micro/ensemble/state.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// Adds the contact forces on the nodes [first, last) to force_x and force_y [N/m].
void add_pair_forces(const EnsembleState& state, const NeighbourList& list,
                     const ImageTable& images, const PairPotential& potential, std::size_t first,
                     std::size_t last, double* force_x, double* force_y);

/// Share of the nodes [first, last) in the contacts: every pair counts half with either node.
struct PairSums {
  double energy = 0;                     // [N]
  Tensor<2> virial = Tensor<2>::Zero();  // [N] sum of F_ab (x) r_ab
};

PairSums sum_pairs(const EnsembleState& state, const NeighbourList& list, const ImageTable& images,
                   const PairPotential& potential, std::size_t first, std::size_t last);

}  // namespace hemoscale::micro
