#include "micro/ensemble/blocks/settings_faults.hpp"

#include <fmt/core.h>

#include <cmath>
#include <cstddef>
#include <functional>

#include "micro/ensemble/blocks/block_limits.hpp"

namespace hemoscale::micro::blocks {

bool exceed_cache(const BlockSettings& settings, std::size_t cells) {
  constexpr std::size_t bytes_per_node = 40;
  return cells * static_cast<std::size_t>(settings.kinds.front().mesh.nodes) * bytes_per_node >
         settings.cache;
}
namespace {

using Fault = std::function<void(const std::string&)>;

constexpr int most_stages = 50;  // more lose the precision of a single number

void check_kind(const BlockSettings& settings, std::size_t k, const Fault& fault) {
  const KindSettings& kind = settings.kinds[k];
  const bool has_mass = settings.integrator == Integrator::inertial;
  if (!(kind.node_drag > 0)) {
    fault(fmt::format("block ensemble: kind {} has a node drag of {} Pa s; it must be positive", k,
                      kind.node_drag));
  }
  if (!(kind.normal_drag > 0) || !std::isfinite(kind.normal_drag)) {
    fault(
        fmt::format("block ensemble: kind {} has a drag across the membrane of {} times that along "
                    "it; it must be finite and positive",
                    k, kind.normal_drag));
  }
  if (kind.normal_drag != 1 && settings.integrator != Integrator::explicit_euler &&
      settings.integrator != Integrator::chebyshev) {
    fault(fmt::format(
        "block ensemble: kind {} has a drag across the membrane of {} times that along "
        "it; only explicit_euler and chebyshev can take other than 1; choose one of them",
        k, kind.normal_drag));
  }
  if (has_mass && !(kind.node_mass > 0)) {
    fault(
        fmt::format("block ensemble: kind {} has a node mass of {} kg/m; the inertial integrator "
                    "needs a positive one; without mass choose explicit_euler",
                    k, kind.node_mass));
  }
  if (!(kind.momentum_drag >= 0) || (!has_mass && kind.momentum_drag != 0)) {
    fault(
        fmt::format("block ensemble: kind {} has a momentum drag of {} kg/m^2; it must not be "
                    "negative, and other than 0 only with the inertial integrator",
                    k, kind.momentum_drag));
  }
  if (kind.laws.bending.index() != settings.kinds.front().laws.bending.index()) {
    fault(fmt::format(
        "block ensemble: kind {} has another law of bending than kind 0; all kinds must "
        "share it",
        k));
  }
}

}  // namespace

std::string settings_faults(const BlockSettings& settings,
                            const std::vector<EnsembleState>& initial) {
  std::string faults;
  const auto fault = [&](const std::string& text) {
    faults += (faults.empty() ? "" : "\n") + text;
  };
  if (settings.kinds.size() != initial.size() || initial.empty()) {
    fault(
        fmt::format("block ensemble: {} kinds of cells and {} initial states; there must be one "
                    "for each; give both",
                    settings.kinds.size(), initial.size()));
  } else {
    for (std::size_t k = 0; k < initial.size(); ++k) {
      const auto nodes = static_cast<std::size_t>(settings.kinds[k].mesh.nodes);
      if (initial[k].nodes != nodes || initial[k].x.size() != initial[k].cells * nodes ||
          initial[k].y.size() != initial[k].x.size()) {
        fault(
            fmt::format("block ensemble: kind {} has {} nodes per cell in its mesh, its state {} "
                        "cells of {} with {} and {} coordinates; they must agree",
                        k, nodes, initial[k].cells, initial[k].nodes, initial[k].x.size(),
                        initial[k].y.size()));
      }
      if (nodes < 8 || nodes > 4000) {
        fault(fmt::format("block ensemble: kind {} has {} nodes per cell; 8 to 4000 are possible",
                          k, nodes));
      }
      check_kind(settings, k, fault);
    }
  }
  if (!(settings.time_step > 0) || !std::isfinite(settings.time_step)) {
    fault(fmt::format("block ensemble: time step {} s; it must be finite and positive",
                      settings.time_step));
  }
  if (!settings.flow) fault("block ensemble: no flow is given; give one, such as a parallel flow");
  if (settings.threads < 1) {
    fault(fmt::format("block ensemble: {} threads; at least one is needed", settings.threads));
  }
  if (!(settings.skin > 0)) {
    fault(fmt::format("block ensemble: skin {} m; it must be positive", settings.skin));
  }
  if (settings.integrator == Integrator::chebyshev &&
      !(settings.stages >= 2 && settings.stages <= most_stages)) {
    fault(fmt::format("block ensemble: {} stages; 2 to {} are possible", settings.stages,
                      most_stages));
  }
  if (settings.migration.is_any() && !(settings.plane_walls && settings.parallel_flow)) {
    fault(
        "block ensemble: laws of lateral migration are for plane channels with walls and a flow "
        "along x; choose such a channel or switch them off");
  }
  const std::string law = contact_law_faults(settings.contact);
  if (!law.empty()) fault("block ensemble: " + law);
  if (faults.empty() && !settings.force) faults = step_fault(settings);
  return faults;
}

}  // namespace hemoscale::micro::blocks
