#include "micro/mps/lattice_domains.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "micro/error.hpp"
#include "micro/random/philox.hpp"

namespace hemoscale::micro {

namespace {

template <int dim>
using Index = std::array<int, static_cast<std::size_t>(dim)>;

/// All lattice points of the box and its margins.
template <int dim>
class Points {
 public:
  Points(const Lattice& lattice, const PeriodicBox<dim>& box) : box_(box) {
    spacing_ = lattice.spacing;
    for (int axis = 0; axis < dim; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      const double rows = box.extent()[axis] / lattice.spacing;
      if (!(rows >= 1) || std::abs(rows - std::round(rows)) > 1e-6 * rows) {
        throw ParameterError(
            fmt::format("the extent {:g} m along axis {} is {:g} spacings; it must be a whole "
                        "number of them, at "
                        "least one; change the spacing",
                        box.extent()[axis], axis, rows));
      }
      margin_[a] = box.periodic[a] ? 0 : lattice.wall_layers;
      counts_[a] = static_cast<int>(std::lround(rows)) + 2 * margin_[a];
    }
  }

  std::size_t size() const {
    std::size_t product = 1;
    for (const int count : counts_) product *= static_cast<std::size_t>(count);
    return product;
  }

  Index<dim> index(std::size_t number) const {
    Index<dim> index;
    for (std::size_t a = 0; a < index.size(); ++a) {
      const auto count = static_cast<std::size_t>(counts_[a]);
      index[a] = static_cast<int>(number % count);
      number /= count;
    }
    return index;
  }

  /// Number of a point given by its index, across periodic faces; size() outside.
  std::size_t number(const Index<dim>& index) const {
    std::size_t number = 0;
    for (std::size_t a = index.size(); a-- > 0;) {
      int place = index[a];
      if (box_.periodic[a]) place = (place % counts_[a] + counts_[a]) % counts_[a];
      if (place < 0 || place >= counts_[a]) return size();
      number = number * static_cast<std::size_t>(counts_[a]) + static_cast<std::size_t>(place);
    }
    return number;
  }

  Vector<dim> place(const Index<dim>& index) const {
    Vector<dim> x;
    for (int axis = 0; axis < dim; ++axis) {
      const auto a = static_cast<std::size_t>(axis);
      x[axis] = box_.lower[axis] + (index[a] - margin_[a] + 0.5) * spacing_;
    }
    return x;
  }

 private:
  PeriodicBox<dim> box_;
  double spacing_ = 0;
  Index<dim> margin_ = {};
  Index<dim> counts_ = {};
};

/// What lies around a point outside, seen within the layers.
template <int dim>
struct Surroundings {
  int layer = 0;  // 1 next to the inside, also across corners; 0 if out of reach
  Vector<dim> normal = Vector<dim>::Zero();  // from the nearest points inside
};

template <int dim>
Surroundings<dim> look_around(const Points<dim>& points, const std::vector<char>& is_inside,
                              int layers, const Index<dim>& centre) {
  Surroundings<dim> found;
  int nearest = 0;
  const int width = 2 * layers + 1;
  const int offsets = dim == 3 ? width * width * width : width * width;
  for (int code = 0; code < offsets; ++code) {
    Index<dim> index = centre;
    Vector<dim> outwards;
    int rest = code;
    int reach = 0;
    int squared = 0;
    for (int axis = 0; axis < dim; ++axis) {
      const int step = rest % width - layers;
      rest /= width;
      index[static_cast<std::size_t>(axis)] += step;
      outwards[axis] = -step;
      reach = std::max(reach, std::abs(step));
      squared += step * step;
    }
    const std::size_t number = points.number(index);
    if (number == points.size() || is_inside[number] == 0) continue;
    found.layer = found.layer == 0 ? reach : std::min(found.layer, reach);
    if (nearest == 0 || squared < nearest) {
      nearest = squared;
      found.normal.setZero();
    }
    if (squared == nearest) found.normal += outwards.normalized();
  }
  if (found.normal.norm() > 0) found.normal.normalize();
  return found;
}

void check(const Lattice& lattice) {
  if (!(lattice.spacing > 0)) {
    throw ParameterError(
        fmt::format("the spacing is {:g} m; it must be positive", lattice.spacing));
  }
  if (lattice.wall_layers < 1 || lattice.wall_layers > 8) {
    throw ParameterError(fmt::format(
        "there are {} wall layers; 1 to 8 are possible; take as many as the kernel radius has "
        "spacings, rounded up",
        lattice.wall_layers));
  }
  if (!(lattice.disorder >= 0) || lattice.disorder > 0.5) {
    throw ParameterError(
        fmt::format("the disorder is {:g} spacings; it must lie in [0, 0.5]", lattice.disorder));
  }
}

}  // namespace

template <int dim>
void disturb(const Lattice& lattice, ParticleSet<dim>& particles) {
  const double width = 2 * lattice.disorder * lattice.spacing;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (particles.kinds[i] != ParticleKind::fluid || width == 0) continue;
    for (int axis = 0; axis < dim; ++axis) {
      const Draw draw = {.seed = lattice.seed,
                         .stream = static_cast<std::uint64_t>(axis),
                         .counter = static_cast<std::uint64_t>(particles.identities[i])};
      particles.positions[i][axis] += width * (uniform(draw) - 0.5);
    }
  }
}

template <int dim>
FlowDomain<dim> lattice_around(const Lattice& lattice, const PeriodicBox<dim>& box,
                               const Region<dim>& inside, const Region<dim>& filled) {
  check(lattice);
  const Points<dim> points(lattice, box);
  std::vector<char> is_inside(points.size());
  for (std::size_t n = 0; n < points.size(); ++n) {
    is_inside[n] = static_cast<char>(inside(points.place(points.index(n))));
  }
  FlowDomain<dim> domain;
  domain.spacing = lattice.spacing;
  domain.box = box;
  domain.patches.push_back({.name = "wall", .kind = ParticleKind::wall});
  bool has_fluid = false;
  for (std::size_t n = 0; n < points.size(); ++n) {
    const Index<dim> index = points.index(n);
    const Vector<dim> x = points.place(index);
    const auto identity = static_cast<std::int64_t>(domain.particles.size());
    if (is_inside[n] != 0) {
      if (filled && !filled(x)) continue;
      domain.particles.append(x, identity);
      has_fluid = true;
      continue;
    }
    const Surroundings<dim> around = look_around(points, is_inside, lattice.wall_layers, index);
    if (around.layer == 0) continue;
    const ParticleKind kind = around.layer == 1 ? ParticleKind::wall : ParticleKind::dummy;
    domain.particles.append(x, identity, kind, 0, around.normal);
  }
  if (!has_fluid) {
    throw ParameterError(
        "no lattice point is inside and filled; enlarge the region or reduce the "
        "spacing");
  }
  disturb(lattice, domain.particles);
  return domain;
}

#define HEMOSCALE_INSTANTIATE(dim)                                                      \
  template void disturb<dim>(const Lattice&, ParticleSet<dim>&);                        \
  template FlowDomain<dim> lattice_around<dim>(const Lattice&, const PeriodicBox<dim>&, \
                                               const Region<dim>&, const Region<dim>&);
HEMOSCALE_INSTANTIATE(2)
HEMOSCALE_INSTANTIATE(3)
#undef HEMOSCALE_INSTANTIATE

}  // namespace hemoscale::micro
