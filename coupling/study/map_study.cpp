#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <mutex>
#include <ostream>

#include "coupling/error.hpp"
#include "coupling/study/bisection.hpp"
#include "coupling/study/chart_study.hpp"
#include "coupling/study/measure.hpp"
#include "coupling/study/picture.hpp"
#include "coupling/study/text_table.hpp"

namespace hemoscale::coupling {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// One search and what it found.
struct Found {
  const MapCurve* curve;
  std::size_t along = 0;  // number of the step
  BoundarySearch search = {};
  double predicted = none;
  double cpu = 0;            // [s] of all its runs
  std::string message = {};  // of the last run that failed
};

std::string outcome_text(BoundarySearch::Outcome outcome) {
  switch (outcome) {
    case BoundarySearch::Outcome::found:
      return "found";
    case BoundarySearch::Outcome::stable_everywhere:
      return "stable at the unstable end";
    case BoundarySearch::Outcome::stable_nowhere:
      return "unstable at the stable end";
  }
  return "";
}

class MapRun {
 public:
  MapRun(const Study& study, const StudyOptions& options, std::ostream& out)
      : study_(study), map_(*study.map), options_(options), out_(out), plan_(plan_map(study)) {
    for (const MapCurve& curve : plan_.curves) {
      for (std::size_t i = 0; i < curve.along.size(); ++i) found_.push_back({&curve, i});
    }
  }

  void list() const {
    const double ratio =
        std::max(map_.stable, map_.unstable) / std::min(map_.stable, map_.unstable);
    const double halvings =
        std::max(0.0, std::ceil(std::log2(std::log(ratio) / std::log1p(map_.tolerance))));
    for (const Found& each : found_) out_ << label(each) << "\n";
    out_ << fmt::format("{} searches of at most {:g} runs each\n", found_.size(), 2 + halvings);
  }

  void run(Runner& runner) {
    for_each_at_once(found_.size(), options_.runner.jobs,
                     [&](std::size_t i) { search(runner, found_[i]); });
  }

  void report(const Runner& runner) {
    TextTable table = map_table();
    write_csv(runner.results() / "map.csv", table);
    for (auto& row : table.rows) row.pop_back();  // the messages are too long for a terminal
    out_ << "\n" << aligned(table) << "\n" << runner.notes(false);
    out_ << (runner.results() / "map.csv").string() << "\n";
    std::vector<std::string> arguments = {
        "map",        runner.results().string(), "--title",      study_.name,
        "--boundary", boundary_name(),           "--prediction", map_.predicted};
    if (!plan_.along_key.empty()) {
      arguments.insert(arguments.end(), {"--along", along_header()});
    }
    draw(options_.script, arguments, out_);
  }

 private:
  std::string label(const Found& each) const {
    std::string text = each.curve->name;
    if (map_.along) {
      const Override& setting = each.curve->along[each.along].front();
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", setting.key,
                          each.curve->along_texts[each.along]);
    }
    return text.empty() ? study_.name : text;
  }

  void search(Runner& runner, Found& each) {
    each.search = find_boundary(map_.stable, map_.unstable, map_.tolerance, [&](double value) {
      const PlannedRun planned = probe(study_, *each.curve, each.along, value);
      const RunRecord record = runner.run(planned);
      if (record.status == RunRecord::Status::timed_out) {
        throw EnvironmentError("the run \"" + planned.label + "\" took " + record.message +
                               ", so that it is not known whether it is stable; raise the timeout");
      }
      const bool is_stable = record.status == RunRecord::Status::finished;
      {
        const std::lock_guard<std::mutex> lock(mutex_);
        out_ << fmt::format("{}: {}", planned.label, is_stable ? "stable" : "unstable")
             << std::endl;
      }
      each.cpu += record.cpu;
      if (!is_stable) each.message = record.message;
      if (is_stable && !map_.predicted.empty()) {
        each.predicted = prediction(runner.summary_of(planned), planned);
      }
      return is_stable;
    });
  }

  double prediction(const Summary& summary, const PlannedRun& planned) const {
    const Figure& figure =
        figure_of(summary, map_.predicted, map_.location, "map.predicted", planned.label);
    if (figure.unit == map_.unit) return figure.value;
    throw CaseError({{map_.location.file, map_.location.line, map_.location.column, "map.predicted",
                      fmt::format("is in {}, but {} in {}; name a figure in the unit of the key",
                                  figure.unit, map_.key, map_.unit)}});
  }

  std::string boundary_name() const { return fmt::format("{} [{}]", map_.key, map_.unit); }
  std::string along_header() const {
    return fmt::format("{} [{}]", plan_.along_key, plan_.along_unit);
  }

  TextTable map_table() const {
    TextTable table;
    table.header = {"curve", "series"};
    table.header.insert(table.header.end(), plan_.swept_keys.begin(), plan_.swept_keys.end());
    if (!plan_.along_key.empty()) table.header.push_back(along_header());
    for (const char* name : {"boundary", "stable", "unstable", "predicted"}) {
      table.header.push_back(fmt::format("{} [{}]", name, map_.unit));
    }
    for (const char* name :
         {"boundary / predicted [-]", "outcome", "runs [-]", "cpu time [s]", "message"}) {
      table.header.emplace_back(name);
    }
    for (const Found& each : found_) {
      const bool found = each.search.outcome == BoundarySearch::Outcome::found;
      const double boundary =
          found ? std::sqrt(each.search.stable) * std::sqrt(each.search.unstable) : none;
      table.begin_row();
      table.add(each.curve->name);
      table.add(each.curve->series);
      for (const std::string& value : each.curve->swept) table.add(value);
      if (!plan_.along_key.empty()) {
        const double abscissa = each.curve->abscissas[each.along];
        if (std::isnan(abscissa)) {
          table.add(each.curve->along_texts[each.along]);
        } else {
          table.add(abscissa);
        }
      }
      table.add(boundary);
      table.add(each.search.stable);
      table.add(each.search.unstable);
      table.add(each.predicted);
      table.add(boundary / each.predicted);
      table.add(outcome_text(each.search.outcome));
      table.add(static_cast<double>(each.search.asked));
      table.add(each.cpu);
      table.add(each.message);
    }
    return table;
  }

  const Study& study_;
  const MapQuestion& map_;
  const StudyOptions& options_;
  std::ostream& out_;
  MapPlan plan_;
  std::vector<Found> found_;
  std::mutex mutex_;  // of the output
};

}  // namespace

void map_study(const Study& study, const StudyOptions& options, std::ostream& out) {
  if (!study.map) {
    throw CaseError({{study.file.string(), 0, 0, "map",
                      "is missing; --map needs [map] with key, stable and unstable"}});
  }
  MapRun map(study, options, out);
  if (options.list) {
    map.list();
    return;
  }
  Runner runner(study, options.runner);
  map.run(runner);
  map.report(runner);
}

}  // namespace hemoscale::coupling
