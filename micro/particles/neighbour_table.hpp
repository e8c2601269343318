#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "micro/particles/periodic_box.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// For every particle the others within a range, in ascending order; the particle itself is not in
/// its row. Built with a skin, it stays complete until a particle has moved half of the skin.
/// Found through a grid of cells, at a cost proportional to the number of particles.
class NeighbourTable {
 public:
  /// @param radius  every pair nearer than this is in the table [m]
  /// @param skin    added to the radius when building [m]
  /// @throws NumericalError naming the particle if a position is not finite
  /// @throws ParameterError if a periodic extent is less than twice radius + skin
  template <int dim>
  void build(const std::vector<Vector<dim>>& positions, const PeriodicBox<dim>& box, double radius,
             double skin = 0);

  /// Whether the table built for `then` still holds every pair of `now` within the radius.
  template <int dim>
  bool is_complete(const std::vector<Vector<dim>>& then, const std::vector<Vector<dim>>& now,
                   const PeriodicBox<dim>& box) const;

  std::size_t size() const { return first_.size() - 1; }
  std::size_t pairs() const { return neighbours_.size(); }
  std::size_t begin(std::size_t particle) const {
    return static_cast<std::size_t>(first_[particle]);
  }
  std::size_t end(std::size_t particle) const {
    return static_cast<std::size_t>(first_[particle + 1]);
  }
  std::size_t operator[](std::size_t entry) const {
    return static_cast<std::size_t>(neighbours_[entry]);
  }
  std::span<const std::int32_t> of(std::size_t particle) const {
    return {neighbours_.data() + begin(particle), neighbours_.data() + end(particle)};
  }
  const std::vector<std::int64_t>& first() const { return first_; }
  const std::vector<std::int32_t>& neighbours() const { return neighbours_; }

 private:
  std::vector<std::int64_t> first_ = {0};
  std::vector<std::int32_t> neighbours_;
  double skin_ = 0;  // [m]
};

}  // namespace hemoscale::micro
