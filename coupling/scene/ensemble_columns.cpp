#include <limits>
#include <string>
#include <vector>

#include "coupling/scene/ensemble_results.hpp"

namespace hemoscale::coupling {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

template <class Sample>
struct Quantity {
  const char* name;
  const char* unit;
  double (*value)(const Sample&);
  bool is_sum = false;  // zero, not undefined, without cells
};

using micro::EnsembleSample;
using micro::LateralSample;

double per_cell(const EnsembleSample& s, std::size_t count) {
  return static_cast<double>(count) / static_cast<double>(s.cells);
}

const std::vector<Quantity<LateralSample>>& lateral_quantities() {
  using S = LateralSample;
  static const std::vector<Quantity<S>> list = {
      {"mean distance of the cells from the axis over half height", "-",
       [](const S& s) { return s.moments.mean_distance; }},
      {"mean square distance of the cells from the axis", "m^2",
       [](const S& s) { return s.balance.cell_moment; }},
      {"rate of the mean square distance by attraction", "m^2/s",
       [](const S& s) { return s.balance.cells.attraction; }},
      {"rate of the mean square distance by repulsion", "m^2/s",
       [](const S& s) { return s.balance.cells.repulsion; }},
      {"rate of the mean square distance by other kinds", "m^2/s",
       [](const S& s) { return s.balance.cells.other_kinds; }},
      {"rate of the mean square distance by walls", "m^2/s",
       [](const S& s) { return s.balance.cells.wall; }},
      {"rate of the mean square distance by lift laws", "m^2/s",
       [](const S& s) { return s.balance.cells.lift; }},
      {"rate of the mean square distance by the flow", "m^2/s",
       [](const S& s) { return s.balance.cells.flow; }},
      {"width of the concentration over that of a uniform one", "-",
       [](const S& s) { return s.moments.width; }},
      {"share of the cell area in the core", "-",
       [](const S& s) { return s.moments.core_fraction; }},
      {"cell-free layer by the envelope", "m",
       [](const S& s) { return s.envelope ? s.envelope->mean() : nan; }},
      {"cell-free layer by half the core fraction", "m",
       [](const S& s) { return s.half_core_distance.value_or(nan); }},
      {"tube hematocrit", "-", [](const S& s) { return s.hematocrits.tube; }},
      {"discharge hematocrit", "-", [](const S& s) { return s.hematocrits.discharge; }},
      {"mean cell velocity", "m/s", [](const S& s) { return s.hematocrits.mean_velocity; }},
      {"shear stress of the cells", "Pa", [](const S& s) { return s.shear_stress; }},
      {"normal stress of the cells", "Pa", [](const S& s) { return s.normal_stress; }}};
  return list;
}

const std::vector<Quantity<EnsembleSample>>& quantities() {
  using S = EnsembleSample;
  static const std::vector<Quantity<S>> list = {
      {"cells", "-", [](const S& s) { return static_cast<double>(s.cells); }, true},
      {"area fraction", "-", [](const S& s) { return s.area_fraction; }, true},
      {"mean speed of the cells", "m/s", [](const S& s) { return s.speed; }},
      {"orientational order", "-", [](const S& s) { return s.orientation.order; }},
      {"order along the flow", "-", [](const S& s) { return s.orientation.along_flow; }},
      {"mean inclination", "rad", [](const S& s) { return s.orientation.angle; }},
      {"mean deformation", "-", [](const S& s) { return s.deformation; }},
      {"mean area strain", "-", [](const S& s) { return s.mean_area_strain; }},
      {"largest area strain", "-", [](const S& s) { return s.largest_area_strain; }},
      {"mean perimeter strain", "-", [](const S& s) { return s.mean_perimeter_strain; }},
      {"largest perimeter strain", "-", [](const S& s) { return s.largest_perimeter_strain; }},
      {"node pairs within the cutoff per cell", "-",
       [](const S& s) { return per_cell(s, s.contacts.pairs_within_cutoff); }},
      {"node pairs within the rest distance per cell", "-",
       [](const S& s) { return per_cell(s, s.contacts.pairs_within_rest); }},
      {"share of cells in contact", "-",
       [](const S& s) { return per_cell(s, s.contacts.cells_in_contact); }},
      {"mean coordination", "-", [](const S& s) { return s.contacts.coordination; }},
      {"closest approach", "m", [](const S& s) { return s.contacts.closest; }},
      {"nodes inside another cell", "-",
       [](const S& s) { return static_cast<double>(s.contacts.nodes_inside); }}};
  return list;
}

}  // namespace

std::string kind_prefix(const ObservedKinds& kinds, std::size_t kind) {
  return kind == 0 ? std::string() : kinds[kind]->kind().name + ": ";
}

std::vector<Column> ensemble_columns(const ObservedKinds& kinds) {
  std::vector<Column> columns = {{"time", "s"}};
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    const std::string prefix = kind_prefix(kinds, k);
    if (kinds[k]->options().is_straight) {
      for (const auto& q : lateral_quantities()) columns.push_back({prefix + q.name, q.unit});
    }
    for (const auto& q : quantities()) columns.push_back({prefix + q.name, q.unit});
    for (const micro::CountedSection& section : kinds[k]->options().sections) {
      columns.push_back({prefix + "cells through " + section.name, "-"});
      columns.push_back({prefix + "cell area through " + section.name, "m^2"});
    }
  }
  return columns;
}

std::vector<double> ensemble_row(const ObservedKinds& kinds) {
  std::vector<double> row = {kinds.front()->last().time};
  for (const micro::EnsembleObserver* kind : kinds) {
    const EnsembleSample& sample = kind->last();
    if (kind->options().is_straight) {
      for (const auto& q : lateral_quantities()) {
        row.push_back(sample.lateral ? q.value(*sample.lateral) : nan);
      }
    }
    for (const auto& q : quantities()) {
      row.push_back(sample.cells > 0 || q.is_sum ? q.value(sample) : nan);
    }
    for (const micro::Passages& passed : sample.passages) {
      row.push_back(static_cast<double>(passed.cells));
      row.push_back(passed.area);
    }
  }
  return row;
}

}  // namespace hemoscale::coupling
