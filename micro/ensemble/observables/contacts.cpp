#include "micro/ensemble/observables/contacts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace hemoscale::micro {
namespace {

/// Another cell as a cell sees it: its number and its image.
using Partner = std::pair<std::size_t, std::int32_t>;

/// Even-odd rule along the ray to the right.
bool is_inside(const EnsembleState& state, std::size_t cell, double x, double y) {
  const std::size_t end = (cell + 1) * state.nodes;
  bool inside = false;
  std::size_t a = end - 1;
  for (std::size_t b = cell * state.nodes; b < end; a = b++) {
    if ((state.y[a] > y) == (state.y[b] > y)) continue;
    const double share = (y - state.y[a]) / (state.y[b] - state.y[a]);
    inside = inside != (x < state.x[a] + share * (state.x[b] - state.x[a]));
  }
  return inside;
}

/// Nodes of a cell inside a partner.
std::size_t count_inside(const EnsembleState& state, std::size_t cell, const Partner& partner,
                         const ImageTable& images) {
  const auto [other, image] = partner;
  const auto number = static_cast<std::size_t>(image);
  const auto first = static_cast<std::ptrdiff_t>(other * state.nodes);
  const auto last = first + static_cast<std::ptrdiff_t>(state.nodes);
  const auto [left, right] = std::minmax_element(state.x.begin() + first, state.x.begin() + last);
  const auto [low, high] = std::minmax_element(state.y.begin() + first, state.y.begin() + last);
  std::size_t count = 0;
  for (std::size_t i = cell * state.nodes; i < (cell + 1) * state.nodes; ++i) {
    const double x = state.x[i] - images.x[number];
    const double y = state.y[i] - images.y[number];
    const bool is_near = x > *left && x < *right && y > *low && y < *high;
    if (is_near && is_inside(state, other, x, y)) ++count;
  }
  return count;
}

}  // namespace

double longest_segment(const EnsembleState& state) {
  double longest_squared = 0;
  for (std::size_t first = 0; first < state.x.size(); first += state.nodes) {
    std::size_t before = first + state.nodes - 1;
    for (std::size_t i = first; i < first + state.nodes; before = i++) {
      const double dx = state.x[i] - state.x[before];
      const double dy = state.y[i] - state.y[before];
      longest_squared = std::max(longest_squared, dx * dx + dy * dy);
    }
  }
  return std::sqrt(longest_squared);
}

Contacts count_contacts(const EnsembleState& state, const Box& box, const NeighbourList& list,
                        const PairLaw& law) {
  const ImageTable images(box, state.image_offset);
  const double cutoff_squared = law.cutoff * law.cutoff;
  const double rest_squared = law.rest_distance * law.rest_distance;
  Contacts contacts;
  double closest_squared = std::numeric_limits<double>::infinity();
  std::size_t coordination = 0;
  std::vector<Partner> partners;  // within the range of the list
  std::vector<Partner> close;     // within the cutoff
  for (std::size_t cell = 0; cell < state.cells; ++cell) {
    partners.clear();
    close.clear();
    bool in_contact = false;
    for (std::size_t i = cell * state.nodes; i < (cell + 1) * state.nodes; ++i) {
      for (const Neighbour& other : list.of(i)) {
        const auto image = static_cast<std::size_t>(other.image);
        const auto j = static_cast<std::size_t>(other.node);
        const double dx = state.x[i] - (state.x[j] + images.x[image]);
        const double dy = state.y[i] - (state.y[j] + images.y[image]);
        const double s = dx * dx + dy * dy;
        const Partner partner{j / state.nodes, other.image};
        if (partners.empty() || partners.back() != partner) partners.push_back(partner);
        closest_squared = std::min(closest_squared, s);
        if (s >= cutoff_squared) continue;
        if (close.empty() || close.back() != partner) close.push_back(partner);
        ++contacts.pairs_within_cutoff;
        if (s >= rest_squared) continue;
        ++contacts.pairs_within_rest;
        in_contact = true;
      }
    }
    for (std::vector<Partner>* set : {&partners, &close}) {
      std::sort(set->begin(), set->end());
      set->erase(std::unique(set->begin(), set->end()), set->end());
    }
    coordination += close.size();
    contacts.cells_in_contact += in_contact ? 1 : 0;
    for (const Partner& partner : partners) {
      contacts.nodes_inside += count_inside(state, cell, partner, images);
    }
  }
  // The list is full: every pair was met twice.
  contacts.pairs_within_cutoff /= 2;
  contacts.pairs_within_rest /= 2;
  contacts.coordination = static_cast<double>(coordination) / static_cast<double>(state.cells);
  contacts.closest = std::sqrt(closest_squared);
  return contacts;
}

}  // namespace hemoscale::micro
