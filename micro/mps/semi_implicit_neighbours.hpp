#pragma once

#include "micro/mps/semi_implicit_parts.hpp"

namespace hemoscale::micro {

/// Share of the spacing by which the neighbour table reaches further than the kernels.
inline constexpr double neighbour_skin = 0.3;  // [l0] a compromise between long rows and rebuilds

/// Particles are put in spatial order after so many searches.
inline constexpr std::int64_t searches_between_orders = 20;

/// Makes the neighbour table hold all pairs in reach of the kernels at the present positions, and
/// with it the pattern of the systems. Searches only when particles have moved half of the skin.
template <int dim>
void refresh_neighbours(const SemiImplicitSetting<dim>& setting, SemiImplicitState<dim>& state,
                        SemiImplicitWork<dim>& work);

/// Puts the particles in spatial order when that is due; the neighbours are then searched anew.
template <int dim>
void keep_order(const SemiImplicitSetting<dim>& setting, SemiImplicitState<dim>& state);

/// Scratch memory as it was after the last search of the state: what a restart needs.
template <int dim>
void rebuild_neighbours(const SemiImplicitSetting<dim>& setting,
                        const SemiImplicitState<dim>& state, SemiImplicitWork<dim>& work);

}  // namespace hemoscale::micro
