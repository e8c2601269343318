#include "micro/mps/node_domains.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "micro/error.hpp"
#include "micro/mps/node_lattice.hpp"

namespace hemoscale::micro {

namespace {

void require_spacings(const char* what, double length, double spacing) {
  if (length >= 3.999 * spacing) return;
  throw ParameterError(
      fmt::format("the {} {:.4g} m holds fewer than four spacings of {:.4g} m; reduce the spacing",
                  what, length, spacing));
}

}  // namespace

FlowDomain<2> channel_nodes(double length, double height, bool is_periodic,
                            const NodeSpacing& spacing) {
  check(spacing);
  require_spacings("length", length, spacing.spacing);
  require_spacings("height", height, spacing.spacing);
  const auto columns = std::lround(length / spacing.spacing);
  const auto rows = std::lround(height / spacing.spacing);
  const double step_x = length / static_cast<double>(columns);
  const double step_y = height / static_cast<double>(rows);

  FlowDomain<2> domain;
  domain.spacing = spacing.spacing;
  domain.box.lower = Vector<2>::Zero();
  domain.box.upper = Vector<2>(length, height);
  domain.box.periodic = {is_periodic, false};
  domain.patches = {{.name = "lower wall"},
                    {.name = "upper wall"},
                    {.name = "inlet", .kind = ParticleKind::inlet},
                    {.name = "outlet", .kind = ParticleKind::outlet}};
  NodeWriter<2> write(domain, spacing);
  for (long i = 0; i < columns + (is_periodic ? 0 : 1); ++i) {
    const bool is_first = i == 0 && !is_periodic;
    const bool is_last = i == columns && !is_periodic;
    for (long j = 0; j <= rows; ++j) {
      const Vector<2> x(step_x * static_cast<double>(i), step_y * static_cast<double>(j));
      // Corners are wall nodes and bound half a step.
      const double share = is_first || is_last ? step_x / 2 : step_x;
      if (j == 0) {
        write.boundary(x, lower_wall, Vector<2>(0, -1), share);
      } else if (j == rows) {
        write.boundary(x, upper_wall, Vector<2>(0, 1), share);
      } else if (is_first) {
        write.boundary(x, inlet_patch, Vector<2>(-1, 0), step_y);
      } else if (is_last) {
        write.boundary(x, outlet_patch, Vector<2>(1, 0), step_y);
      } else {
        write.inner(x);
      }
    }
  }
  return domain;
}

template <int dim>
FlowDomain<dim> periodic_nodes(const Vector<dim>& extent, const NodeSpacing& spacing) {
  check(spacing);
  FlowDomain<dim> domain;
  domain.spacing = spacing.spacing;
  domain.box.upper = extent;
  domain.box.periodic.fill(true);
  Eigen::Matrix<long, dim, 1> counts;
  for (int axis = 0; axis < dim; ++axis) {
    require_spacings("extent", extent[axis], spacing.spacing);
    counts[axis] = std::lround(extent[axis] / spacing.spacing);
  }
  NodeWriter<dim> write(domain, spacing);
  const long layers = dim == 3 ? counts[dim - 1] : 1;
  for (long k = 0; k < layers; ++k) {
    for (long j = 0; j < counts[1]; ++j) {
      for (long i = 0; i < counts[0]; ++i) {
        Vector<dim> x;
        x[0] = extent[0] * (static_cast<double>(i) + 0.5) / static_cast<double>(counts[0]);
        x[1] = extent[1] * (static_cast<double>(j) + 0.5) / static_cast<double>(counts[1]);
        if constexpr (dim == 3) {
          x[2] = extent[2] * (static_cast<double>(k) + 0.5) / static_cast<double>(counts[2]);
        }
        write.inner(x);
      }
    }
  }
  return domain;
}

template FlowDomain<2> periodic_nodes<2>(const Vector<2>&, const NodeSpacing&);
template FlowDomain<3> periodic_nodes<3>(const Vector<3>&, const NodeSpacing&);

FlowDomain<2> column_nodes(double length, double height, const NodeSpacing& spacing) {
  std::vector<Patch<2>> patches = {{.name = "walls"},
                                   {.name = "surface", .kind = ParticleKind::surface}};
  const OutlineLoop loop = {{0, {{0, height}, {0, 0}}},
                            {0, {{0, 0}, {length, 0}}},
                            {0, {{length, 0}, {length, height}}},
                            {1, {{length, height}, {0, height}}}};
  return outline_nodes({loop}, std::move(patches), spacing);
}

FlowDomain<2> free_patch_nodes(double length, const NodeSpacing& spacing) {
  std::vector<Patch<2>> patches = {{.name = "surface", .kind = ParticleKind::surface}};
  const OutlineLoop loop = {{0, {{0, 0}, {length, 0}}},
                            {0, {{length, 0}, {length, length}}},
                            {0, {{length, length}, {0, length}}},
                            {0, {{0, length}, {0, 0}}}};
  return outline_nodes({loop}, std::move(patches), spacing);
}

FlowDomain<3> pipe_nodes(double length, double radius, bool is_periodic,
                         const NodeSpacing& spacing) {
  check(spacing);
  require_spacings("length", length, spacing.spacing);
  require_spacings("diameter", 2 * radius, spacing.spacing);
  const double l = spacing.spacing;
  const auto slices = std::lround(length / l);
  const double step = length / static_cast<double>(slices);
  const auto around = std::lround(2 * std::numbers::pi * radius / l);
  const double arc = 2 * std::numbers::pi * radius / static_cast<double>(around);
  const auto reach = static_cast<long>(std::floor(radius / l));

  FlowDomain<3> domain;
  domain.spacing = l;
  domain.box.lower = Vector<3>(0, -radius, -radius);
  domain.box.upper = Vector<3>(length, radius, radius);
  domain.box.periodic = {is_periodic, false, false};
  domain.patches = {{.name = "wall"},
                    {.name = "inlet", .kind = ParticleKind::inlet},
                    {.name = "outlet", .kind = ParticleKind::outlet}};
  NodeWriter<3> write(domain, spacing);
  for (long i = 0; i < slices + (is_periodic ? 0 : 1); ++i) {
    const bool is_first = i == 0 && !is_periodic;
    const bool is_last = i == slices && !is_periodic;
    const double x = step * static_cast<double>(i);
    const double share = is_first || is_last ? step / 2 : step;
    for (long k = 0; k < around; ++k) {
      const double angle =
          2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(around);
      const Vector<3> normal(0, std::cos(angle), std::sin(angle));
      write.boundary(Vector<3>(x, 0, 0) + radius * normal, 0, normal, share * arc);
    }
    for (long j = -reach; j <= reach; ++j) {
      for (long k = -reach; k <= reach; ++k) {
        const Vector<3> at(x, l * static_cast<double>(j), l * static_cast<double>(k));
        if (std::hypot(at[1], at[2]) > radius - clearance * l) continue;
        if (is_first) {
          write.boundary(at, 1, Vector<3>(-1, 0, 0), l * l);
        } else if (is_last) {
          write.boundary(at, 2, Vector<3>(1, 0, 0), l * l);
        } else {
          write.inner(at);
        }
      }
    }
  }
  return domain;
}

namespace {

std::vector<Patch<2>> channel_patches() {
  return {{.name = "lower wall"},
          {.name = "upper wall"},
          {.name = "inlet", .kind = ParticleKind::inlet},
          {.name = "outlet", .kind = ParticleKind::outlet}};
}

/// Points y(x) between two abscissae, in steps far below the spacing.
template <typename Height>
std::vector<Vector<2>> curve(double from, double to, double spacing, const Height& height) {
  const auto intervals = std::lround(std::ceil(20 * std::abs(to - from) / spacing));
  std::vector<Vector<2>> points;
  for (long k = 0; k <= intervals; ++k) {
    const double x = from + (to - from) * static_cast<double>(k) / static_cast<double>(intervals);
    points.emplace_back(x, height(x));
  }
  return points;
}

/// Arc around `centre` from one angle to another, in steps far below the spacing.
std::vector<Vector<2>> arc(const Vector<2>& centre, double radius, double from, double to,
                           double spacing) {
  const auto intervals = std::lround(std::ceil(20 * radius * std::abs(to - from) / spacing)) + 20;
  std::vector<Vector<2>> points;
  for (long k = 0; k <= intervals; ++k) {
    const double angle =
        from + (to - from) * static_cast<double>(k) / static_cast<double>(intervals);
    points.push_back(centre + radius * Vector<2>(std::cos(angle), std::sin(angle)));
  }
  return points;
}

}  // namespace

FlowDomain<2> cylinder_nodes(double length, double height, double radius, double centre_x,
                             bool is_periodic, const NodeSpacing& spacing) {
  check(spacing);
  require_spacings("gap beside the cylinder", height / 2 - radius, spacing.spacing);
  if (centre_x - radius < 2 * spacing.spacing || centre_x + radius > length - 2 * spacing.spacing) {
    throw ParameterError(fmt::format(
        "the cylinder of radius {:.4g} m at x = {:.4g} m is nearer than two spacings to an end of "
        "the channel of length {:.4g} m",
        radius, centre_x, length));
  }
  std::vector<Patch<2>> patches = channel_patches();
  patches.push_back({.name = "cylinder"});
  OutlineLoop circle = {
      {4, arc({centre_x, height / 2}, radius, 2 * std::numbers::pi, 0, spacing.spacing)}};
  circle.front().points.back() = circle.front().points.front();
  if (is_periodic) {
    // The joined ends carry no nodes: the channel as usual, less what the cylinder covers.
    return with_hole(channel_nodes(length, height, true, spacing), circle, std::move(patches),
                     spacing);
  }
  const OutlineLoop outer = {{lower_wall, {{0, 0}, {length, 0}}},
                             {outlet_patch, {{length, 0}, {length, height}}},
                             {upper_wall, {{length, height}, {0, height}}},
                             {inlet_patch, {{0, height}, {0, 0}}}};
  return outline_nodes({outer, circle}, std::move(patches), spacing);
}

FlowDomain<2> constriction_nodes(double length, double height, double throat,
                                 double constriction_length, const NodeSpacing& spacing) {
  check(spacing);
  require_spacings("throat", throat, spacing.spacing);
  if (!(throat <= height) || !(constriction_length <= length)) {
    throw ParameterError(
        fmt::format("the throat {:.4g} m must not exceed the height {:.4g} m, nor the constriction "
                    "{:.4g} m the "
                    "length {:.4g} m",
                    throat, height, constriction_length, length));
  }
  const double depth = (height - throat) / 2;
  const auto lower = [&](double x) {
    const double s = (x - length / 2) / constriction_length;
    return std::abs(s) < 0.5 ? depth * (1 + std::cos(2 * std::numbers::pi * s)) / 2 : 0.0;
  };
  const auto upper = [&](double x) { return height - lower(x); };
  const OutlineLoop loop = {{lower_wall, curve(0, length, spacing.spacing, lower)},
                            {outlet_patch, {{length, lower(length)}, {length, upper(length)}}},
                            {upper_wall, curve(length, 0, spacing.spacing, upper)},
                            {inlet_patch, {{0, upper(0)}, {0, lower(0)}}}};
  return outline_nodes({loop}, channel_patches(), spacing);
}

FlowDomain<2> bifurcation_nodes(double length, double height, double nose, double divider,
                                const NodeSpacing& spacing) {
  check(spacing);
  require_spacings("branch", (height - divider) / 2, spacing.spacing);
  // The least-squares fits reach across anything thinner.
  require_spacings("divider", divider, spacing.spacing);
  if (!(nose > 0) || !(nose + divider / 2 < length)) {
    throw ParameterError(
        fmt::format("the divider begins at x = {:.4g} m; with its round nose it must lie inside "
                    "the length {:.4g} "
                    "m",
                    nose, length));
  }
  std::vector<Patch<2>> patches = channel_patches();
  patches[outlet_patch].name = "lower outlet";
  patches.push_back({.name = "divider"});
  patches.push_back({.name = "upper outlet", .kind = ParticleKind::outlet});
  const double low = (height - divider) / 2;
  const double high = (height + divider) / 2;
  const Vector<2> centre(nose + divider / 2, height / 2);
  const OutlineLoop loop = {{lower_wall, {{0, 0}, {length, 0}}},
                            {outlet_patch, {{length, 0}, {length, low}}},
                            {4, {{length, low}, {centre[0], low}}},
                            {4, arc(centre, divider / 2, 1.5 * std::numbers::pi,
                                    0.5 * std::numbers::pi, spacing.spacing)},
                            {4, {{centre[0], high}, {length, high}}},
                            {5, {{length, high}, {length, height}}},
                            {upper_wall, {{length, height}, {0, height}}},
                            {inlet_patch, {{0, height}, {0, 0}}}};
  return outline_nodes({loop}, std::move(patches), spacing);
}

}  // namespace hemoscale::micro
