#include "coupling/scene/ensemble_kinds.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "coupling/scene/build_micro.hpp"
#include "micro/ensemble/check_parameters.hpp"

namespace hemoscale::coupling {

namespace {

using micro::blocks::Integrator;
using micro::blocks::KindSettings;

double node_share(const Settings& settings, int nodes) {
  return settings.text("micro.drag.convention") == "cell" ? 1.0 / nodes : 1.0;
}

micro::OutlineParameters platelet_outline(const Settings& settings) {
  micro::OutlineParameters outline;
  outline.outline = micro::Outline::ellipse;
  outline.length = settings.quantity("micro.platelets.length");
  outline.aspect = settings.quantity("micro.platelets.aspect");
  return outline;
}

KindSettings red_cells(const Settings& settings, const micro::EnsembleParameters& p,
                       const std::vector<micro::Vector<2>>& outline) {
  KindSettings kind;
  kind.mesh = micro::make_ring_mesh(outline, p.membrane.natural_shape);
  kind.laws = micro::make_membrane_laws(p.membrane);
  const double share = node_share(settings, p.nodes);
  kind.node_drag = share * p.drag.coefficient * p.plasma_viscosity;
  kind.normal_drag = settings.quantity("micro.drag.normal_ratio");
  if (block_integrator(settings) == Integrator::inertial) {
    const double mass = settings.has("micro.inertia.cell_mass")
                            ? settings.quantity("micro.inertia.cell_mass")
                            : settings.quantity("fluid.density") * kind.mesh.rest_area;
    kind.node_mass = mass / p.nodes;
    kind.momentum_drag = share * settings.quantity("micro.drag.momentum");
  }
  return kind;
}

KindSettings platelets(const Settings& settings, const micro::EnsembleParameters& p,
                       const std::vector<micro::Vector<2>>& outline, const KindSettings& red) {
  micro::MembraneParameters membrane = p.membrane;
  membrane.stretch_modulus = settings.quantity("micro.platelets.stretch_modulus");
  membrane.bending_modulus = settings.quantity("micro.platelets.bending_modulus");
  membrane.natural_shape = micro::NaturalShape::outline;
  KindSettings kind;
  kind.mesh = micro::make_ring_mesh(outline, membrane.natural_shape);
  kind.laws = micro::make_membrane_laws(membrane);
  const int nodes = kind.mesh.nodes;
  kind.node_drag =
      settings.quantity("micro.platelets.drag_coefficient") * p.plasma_viscosity / nodes;
  kind.normal_drag = red.normal_drag;
  kind.node_mass =
      red.node_mass * red.mesh.nodes / nodes * (kind.mesh.rest_area / red.mesh.rest_area);
  kind.momentum_drag = red.momentum_drag * (kind.node_drag / red.node_drag);
  return kind;
}

}  // namespace

std::string integrator_name(const Settings& settings) {
  if (settings.has("micro.integrator")) return settings.text("micro.integrator");
  return settings.text("micro.domain") == "shear-box" ? "explicit-reference"
                                                      : "constant-operator-2";
}

Integrator block_integrator(const Settings& settings) {
  const std::string name = integrator_name(settings);
  if (name == "explicit") return Integrator::explicit_euler;
  if (name == "linearly-implicit") return Integrator::linearly_implicit;
  if (name == "constant-operator") return Integrator::constant_operator;
  if (name == "inertial") return Integrator::inertial;
  if (name == "chebyshev") return Integrator::chebyshev;
  return Integrator::constant_operator_second_order;
}

micro::ContactLaw contact_law(const Settings& settings) {
  const std::string& law = settings.text("micro.contact.law");
  const double rest = settings.quantity("micro.contact.rest_distance");
  const double cutoff = settings.quantity("micro.contact.cutoff");
  if (law == "morse") {
    return micro::MorsePotential{
        .energy_scale = settings.quantity("micro.contact.morse.energy_scale"),
        .steepness = settings.quantity("micro.contact.morse.steepness"),
        .rest_distance = rest,
        .cutoff = cutoff};
  }
  if (law == "lennard-jones") {
    constexpr double default_core = 0.9;  // of the rest distance: some seven times as stiff there
    return micro::LennardJonesPotential{
        .energy_scale = settings.quantity("micro.contact.lennard_jones.energy_scale"),
        .rest_distance = rest,
        .core = settings.has("micro.contact.lennard_jones.core")
                    ? settings.quantity("micro.contact.lennard_jones.core")
                    : default_core * rest,
        .cutoff = cutoff};
  }
  return micro::make_pair_potential(settings.quantity("micro.contact.stiffness"), rest, cutoff,
                                    settings.quantity("micro.contact.attraction"));
}

std::size_t platelet_count(const Settings& settings) {
  return static_cast<std::size_t>(
      std::llround(settings.quantity("micro.platelets.per_cell") *
                   static_cast<double>(settings.integer("micro.cells"))));
}

EnsembleKinds build_kinds(const Settings& settings) {
  const micro::EnsembleParameters p = build_ensemble_parameters(settings, 1, true);
  micro::require_admissible(p);
  EnsembleKinds all;
  all.outlines.push_back(micro::outline_nodes(p.outline, p.nodes));
  all.kinds.push_back(red_cells(settings, p, all.outlines.front()));
  all.names.emplace_back("red cells");
  // Where cells come and go, platelets do so in proportion.
  const bool has_platelets = settings.has("micro.cells")
                                 ? platelet_count(settings) > 0
                                 : settings.quantity("micro.platelets.per_cell") > 0;
  if (has_platelets) {
    all.outlines.push_back(micro::outline_nodes(
        platelet_outline(settings), static_cast<int>(settings.integer("micro.platelets.nodes"))));
    all.kinds.push_back(platelets(settings, p, all.outlines.back(), all.kinds.front()));
    all.names.emplace_back("platelets");
  }
  return all;
}

micro::LateralMigration build_migration(const Settings& settings, const micro::RingMesh& red_cell,
                                        double shear_rate) {
  micro::LateralMigration migration;
  if (settings.text("micro.domain") != "channel") return migration;
  const double radius = red_cell.rest_perimeter / (2 * std::numbers::pi);
  if (const double u = settings.quantity("micro.migration.wall_lift"); u > 0) {
    migration.wall_lift = micro::WallLift{u * shear_rate * radius * radius * radius};
  }
  if (const double xi = settings.quantity("micro.migration.shear_lift"); xi > 0) {
    migration.shear_lift = micro::ShearLift{xi, radius};
  }
  if (const double k = settings.quantity("micro.migration.shear_diffusion"); k > 0) {
    migration.shear_diffusion =
        micro::ShearDiffusion{k, radius, static_cast<std::uint64_t>(settings.integer("case.seed"))};
  }
  return migration;
}

std::vector<std::string> optional_laws(const Settings& settings) {
  std::vector<std::string> laws;
  const auto add = [&](const std::string& key, const char* name) {
    if (settings.has(key) && settings.quantity(key) > 0) {
      laws.push_back(fmt::format("{}, coefficient {:g}", name, settings.quantity(key)));
    }
  };
  add("micro.migration.wall_lift", "wall lift (Olla 1997; Coupier et al. 2008)");
  add("micro.migration.shear_lift", "lift by the local shear rate (Coupier et al. 2008)");
  add("micro.migration.shear_diffusion", "shear-induced diffusion (Leighton and Acrivos 1987)");
  if (settings.quantity("micro.drag.normal_ratio") != 1) {
    laws.push_back(fmt::format(
        "anisotropic drag, {:g} times as large across the membrane as along it; rates of the mean "
        "square distance by cause are not meaningful with it",
        settings.quantity("micro.drag.normal_ratio")));
  }
  return laws;
}

micro::RegionOptions region_options(const Settings& settings) {
  micro::RegionOptions options;
  options.motion = settings.text("micro.regions.copies") == "frozen"
                       ? micro::regions::CopyMotion::frozen
                       : micro::regions::CopyMotion::flow;
  if (settings.has("micro.regions.exchange_interval")) {
    options.exchange_interval = settings.integer("micro.regions.exchange_interval");
  }
  options.copy_growth = settings.quantity("micro.regions.copy_growth");
  return options;
}

}  // namespace hemoscale::coupling
