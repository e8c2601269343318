#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "micro/ensemble/blocks/block_limits.hpp"
#include "tests/support/micro/block_runs.hpp"
#include "tests/support/micro/contact_laws.hpp"

// Single cells of the block ensemble for its integrators, laws and limits.
namespace hemoscale::test {

inline constexpr Integrator integrators_without_mass[] = {
    Integrator::explicit_euler, Integrator::linearly_implicit, Integrator::constant_operator,
    Integrator::constant_operator_second_order, Integrator::chebyshev};

/// Fluid at rest.
class NoFlow final : public micro::GivenFlow {
 public:
  micro::LocalFlow at(const micro::Vector<2>&, double) const override { return {}; }
  bool is_steady() const override { return true; }
  double largest_shear_rate() const override { return 0; }
  double largest_speed() const override { return 0; }
};

/// A uniform stream along x that sets in at once.
class Gust final : public micro::GivenFlow {
 public:
  Gust(double speed, double begin) : speed_(speed), begin_(begin) {}
  micro::LocalFlow at(const micro::Vector<2>&, double time) const override {
    micro::LocalFlow flow;
    // Steps do not fall on the beginning to the last bit.
    if (time > begin_ * (1 - 1e-9)) flow.velocity.x() = speed_;
    return flow;
  }
  bool is_steady() const override { return false; }
  double largest_shear_rate() const override { return 0; }
  double largest_speed() const override { return speed_; }

 private:
  double speed_, begin_;
};

/// One cell of 32 nodes, smoothly strained, in a strong shear without walls.
inline BlockCase relaxing_cell() {
  constexpr int nodes = 32;
  BlockCase c;
  c.settings.kinds = {red_cell(nodes)};
  c.settings.contact = vessel_contact();
  c.settings.height = 40e-6;
  c.settings.flow = std::make_shared<micro::SimpleShearFlow>(300, c.settings.height);
  c.settings.stages = 8;
  Lattice one;
  one.columns = one.rows = 1;
  one.disorder = 0;
  c.initial.push_back(on_lattice(micro::outline_nodes({}, nodes), one));
  for (double& x : c.initial.front().x) x *= 1.02;
  for (double& y : c.initial.front().y) y *= 0.95;
  return c;
}

/// A cell at rest whose nodes are displaced at random.
inline BlockCase disturbed_cell(int nodes, double size = 1e-10) {
  BlockCase c;
  c.settings.kinds = {red_cell(nodes)};
  c.settings.contact = vessel_contact();
  c.settings.height = 40e-6;
  c.settings.flow = std::make_shared<NoFlow>();
  Lattice one;
  one.columns = one.rows = 1;
  one.disorder = 0;
  c.initial.push_back(on_lattice(micro::outline_nodes({}, nodes), one));
  for (std::size_t i = 0; i < c.initial.front().x.size(); ++i) {
    c.initial.front().x[i] += size * micro::normal({3, 0, i});
    c.initial.front().y[i] += size * micro::normal({3, 1, i});
  }
  return c;
}

/// Root mean square displacement of the nodes in a step [m], after some.
inline double motion(BlockEnsemble& ensemble, std::int64_t steps) {
  ensemble.advance(steps);
  const auto before = ensemble.states();
  ensemble.advance(1);
  return node_difference(ensemble.states(), before);
}

}  // namespace hemoscale::test
