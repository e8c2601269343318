#pragma once

#include <memory>
#include <string>
#include <vector>

#include "micro/cells/outline.hpp"
#include "micro/ensemble/blocks/block_settings.hpp"
#include "micro/ensemble/packing/insertion.hpp"
#include "micro/ensemble/packing/random_packing.hpp"
#include "micro/error.hpp"

// Cells to pack, feed and check.
namespace hemoscale::test {

/// Fluid that moves as a whole.
class UniformFlow final : public micro::GivenFlow {
 public:
  explicit UniformFlow(const micro::Vector<2>& velocity) : velocity_(velocity) {}
  micro::LocalFlow at(const micro::Vector<2>&, double) const override {
    micro::LocalFlow flow;
    flow.velocity = velocity_;
    return flow;
  }
  bool is_steady() const override { return true; }
  double largest_shear_rate() const override { return 0; }
  double largest_speed() const override { return velocity_.norm(); }

 private:
  micro::Vector<2> velocity_;  // [m/s]
};

inline micro::blocks::KindSettings kind_of(const std::vector<micro::Vector<2>>& outline) {
  const micro::MembraneParameters membrane;
  const double cell_drag = 12 * 1.2e-3;  // [Pa s]
  return {.mesh = micro::make_ring_mesh(outline, membrane.natural_shape),
          .laws = micro::make_membrane_laws(membrane),
          .node_drag = cell_drag / static_cast<double>(outline.size())};
}

/// Red cells that fill a share of a channel or of a box.
inline micro::RandomPacking packing_of(std::size_t cells, int nodes, double fraction, double height,
                                       bool walls) {
  micro::RandomPacking p;
  p.outline = micro::outline_nodes({}, nodes);
  p.kind = kind_of(p.outline);
  const double spacing = p.kind.mesh.rest_perimeter / nodes;
  p.contact = micro::make_pair_potential(1, 1.1 * spacing, 1.8 * spacing, 0.05);
  p.wall = {.stiffness = 1, .range = spacing};
  p.cells = cells;
  const double area = static_cast<double>(cells) * p.kind.mesh.rest_area / fraction;
  p.box = {.length = area / height, .height = height, .walls = walls};
  return p;
}

/// What a call says when it refuses.
template <class Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const micro::ParameterError& error) {
    return error.what();
  }
  return "nothing was refused";
}

/// A state of cells of one outline at places and angles.
struct Placed {
  micro::Vector<2> place;
  double angle = 0;
};
inline micro::EnsembleState state_of(const std::vector<micro::Vector<2>>& outline,
                                     const std::vector<Placed>& cells) {
  micro::EnsembleState state;
  state.nodes = outline.size();
  for (const Placed& cell : cells) {
    micro::append_cell(micro::placed(outline, cell.place, cell.angle), state);
  }
  return state;
}

}  // namespace hemoscale::test
