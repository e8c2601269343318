#include "coupling/scene/ensemble_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <utility>

#include "coupling/error.hpp"

namespace hemoscale::coupling {

namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// The name of a kind as part of a file name.
std::string file_part(const micro::EnsembleObserver& observer) {
  std::string name = observer.kind().name;
  std::replace(name.begin(), name.end(), ' ', '-');
  return name;
}

std::vector<Column> concentration_columns(const micro::ObserverOptions& options, double height) {
  std::vector<Column> columns = {{"time", "s"}};
  const micro::LateralBins bins{.height = height, .count = options.bins};
  for (std::size_t b = 0; b < bins.count; ++b) {
    columns.push_back({fmt::format("area fraction at y = {:.6g} um", 1e6 * bins.middle(b)), "-"});
  }
  for (std::size_t b = 0; b < options.distance_bins; ++b) {
    const double middle =
        (static_cast<double>(b) + 0.5) / static_cast<double>(options.distance_bins);
    columns.push_back({fmt::format("share of the cells at distance {:.6g}", middle), "-"});
  }
  return columns;
}

std::vector<double> concentration_row(const micro::EnsembleObserver& observer) {
  const micro::EnsembleSample& sample = observer.last();
  std::vector<double> row = {sample.time};
  if (sample.lateral) {
    row.insert(row.end(), sample.lateral->area_fractions.begin(),
               sample.lateral->area_fractions.end());
    row.insert(row.end(), sample.lateral->distance_shares.begin(),
               sample.lateral->distance_shares.end());
  } else {
    // No cells: nothing anywhere, and no shares of it.
    row.resize(1 + observer.options().bins, 0.0);
    row.resize(row.size() + observer.options().distance_bins, nan);
  }
  return row;
}

SeriesWriter open(const std::filesystem::path& path, const std::vector<Column>& columns,
                  std::optional<double> restarted_at) {
  return restarted_at ? SeriesWriter::resume(path, columns, *restarted_at)
                      : SeriesWriter::create(path, columns);
}

void write_profiles(const std::filesystem::path& path, const ObservedKinds& kinds) {
  std::vector<Column> columns = {{"y", "m"}};
  std::vector<std::vector<double>> values;
  for (std::size_t k = 0; k < kinds.size(); ++k) {
    if (kinds[k]->average().samples() == 0) continue;
    const micro::LateralProfiles p = kinds[k]->average().profiles();
    if (values.empty()) values.push_back(p.y);
    const std::string prefix = kind_prefix(kinds, k);
    const auto add = [&](const char* name, const char* unit, const std::vector<double>& column) {
      columns.push_back({prefix + name, unit});
      values.push_back(column);
    };
    add("area fraction", "-", p.area_fraction);
    add("cell velocity", "m/s", p.cell_velocity);
    add("flow velocity", "m/s", p.flow_velocity);
    add("flux of cell area", "m/s", p.area_flux);
    add("order along the flow", "-", p.along_flow);
    add("inclination", "rad", p.inclination);
    add("shear stress of the cells", "Pa", p.shear_stress);
    add("normal stress of the cells", "Pa", p.normal_stress);
  }
  if (values.empty()) return;
  std::vector<std::vector<double>> rows(values.front().size());
  for (std::size_t b = 0; b < rows.size(); ++b) {
    for (const std::vector<double>& column : values) rows[b].push_back(column[b]);
  }
  write_table(path, columns, rows);
}

void write_cells(const std::filesystem::path& path, const micro::EnsembleObserver& observer) {
  std::vector<std::vector<double>> rows;
  for (std::size_t cell = 0; cell < observer.cells().size(); ++cell) {
    const micro::CellRecord& c = observer.cells()[cell];
    rows.push_back({static_cast<double>(cell), c.shape.centre.x(), c.shape.centre.y(),
                    c.motion.velocity.x(), c.motion.velocity.y(), c.shape.inclination,
                    c.shape.deformation, c.shape.area, c.shape.perimeter, c.area_strain,
                    c.perimeter_strain, c.stresslet(0, 0) / c.shape.area,
                    0.5 * (c.stresslet(0, 1) + c.stresslet(1, 0)) / c.shape.area,
                    c.stresslet(1, 1) / c.shape.area});
  }
  write_table(path,
              {{"cell", "-"},
               {"x", "m"},
               {"y", "m"},
               {"u", "m/s"},
               {"v", "m/s"},
               {"inclination", "rad"},
               {"deformation", "-"},
               {"area", "m^2"},
               {"perimeter", "m"},
               {"area strain", "-"},
               {"perimeter strain", "-"},
               {"membrane stress xx", "Pa"},
               {"membrane stress xy", "Pa"},
               {"membrane stress yy", "Pa"}},
              rows);
}

void write_notes(const std::filesystem::path& path, const ObservedKinds& kinds,
                 const std::vector<std::string>& statements) {
  std::ofstream file(path);
  file << "What the tables of this folder are not:\n";
  for (const std::string& statement : statements) file << "  " << statement << "\n";
  const micro::ObserverOptions& options = kinds.front()->options();
  file << fmt::format(
      "\nQuantities of {} have plain names; those of other kinds begin with the kind.\n"
      "Distance from the axis: |2y/H - 1| of the centroid. Core: the middle half of the height.\n"
      "Cell-free layer by the envelope: mean of the smallest distance of a membrane from the wall\n"
      "over columns of {:.3g} m; by half the core fraction: where the area fraction reaches half\n"
      "of its mean over the core.\n"
      "Discharge hematocrit: flux of cell area over that of the flow; all are area fractions.\n"
      "Order along the flow: mean of cos 2a, a the inclination of the long axis; inclinations are\n"
      "mirrored above the axis. Deformation: (L - B)/(L + B) of the ellipse of inertia.\n"
      "Stress of the cells through planes y = const, walls excluded; in the series its shear is\n"
      "the mean over both halves, the sign turned above the axis.\n"
      "profile.csv averages the samples from {:.6g} s on.\n",
      kinds.front()->kind().name, options.column_width, options.average_from);
  file.close();
  if (!file) {
    throw EnvironmentError(fmt::format(
        "{}: not written; the disk may be full or the folder closed to writing; make room",
        path.string()));
  }
}

}  // namespace

EnsembleResults::EnsembleResults(std::filesystem::path results, ObservedKinds kinds, double height,
                                 const std::vector<std::string>& statements,
                                 std::optional<double> restarted_at)
    : results_(std::move(results)),
      kinds_(std::move(kinds)),
      series_(open(results_ / "series.csv", ensemble_columns(kinds_), restarted_at)) {
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    concentrations_.emplace_back();
    if (!kinds_[k]->options().is_straight) continue;
    const std::string name = k == 0 ? std::string() : "-" + file_part(*kinds_[k]);
    concentrations_.back() =
        open(results_ / ("concentration" + name + ".csv"),
             concentration_columns(kinds_[k]->options(), height), restarted_at);
  }
  write_notes(results_ / "tables.txt", kinds_, statements);
}

void EnsembleResults::append() {
  last_row_ = ensemble_row(kinds_);
  if (first_row_.empty()) first_row_ = last_row_;
  series_.append(last_row_);
  for (std::size_t k = 0; k < kinds_.size(); ++k) {
    if (concentrations_[k]) concentrations_[k]->append(concentration_row(*kinds_[k]));
  }
}

void EnsembleResults::finish() const {
  write_profiles(results_ / "profile.csv", kinds_);
  for (const micro::EnsembleObserver* kind : kinds_) {
    write_cells(results_ / (file_part(*kind) + ".csv"), *kind);
  }
}

std::vector<Figure> EnsembleResults::figures() const {
  std::vector<Figure> figures;
  const std::vector<Column> columns = ensemble_columns(kinds_);
  for (std::size_t k = 1; k < columns.size(); ++k) {
    figures.push_back({columns[k].name, last_row_[k], columns[k].unit});
  }
  for (std::size_t k = 1; k < columns.size(); ++k) {
    figures.push_back({columns[k].name + " at the first output", first_row_[k], columns[k].unit});
  }
  return figures;
}

std::vector<std::string> ensemble_statements(const std::vector<std::string>& optional_laws) {
  std::vector<std::string> statements = {
      "two-dimensional cells: stresses and fluxes are per unit depth, and a hematocrit is an area "
      "fraction; not to be read as three-dimensional values",
      "prescribed flow: no hydrodynamic interaction, no lift"};
  if (!optional_laws.empty()) {
    statements.push_back(
        fmt::format("optional laws that are on: {}", fmt::join(optional_laws, "; ")));
  }
  return statements;
}

}  // namespace hemoscale::coupling
