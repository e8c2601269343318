#include "coupling/study/chart_study.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <mutex>
#include <ostream>

#include "coupling/error.hpp"
#include "coupling/study/measure.hpp"
#include "coupling/study/order_fit.hpp"
#include "coupling/study/pareto.hpp"
#include "coupling/study/picture.hpp"
#include "coupling/study/text_table.hpp"

namespace hemoscale::coupling {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// A point of the chart with all that became of it.
struct Result {
  const Curve* curve;
  const PlannedPoint* point;
  RunRecord record = {};
  double value = none;  // of the figure
  double steps = none;
  double error = none;
  bool on_front = false;
};

std::string family_of(const Curve& curve) {
  std::string family;
  for (const std::string& value : curve.swept) family += value + "\n";
  return family;
}

class ChartRun {
 public:
  ChartRun(const Study& study, const StudyOptions& options, std::ostream& out)
      : study_(study),
        measure_(*study.error),
        options_(options),
        out_(out),
        plan_(plan_chart(study)) {
    for (const Curve& curve : plan_.curves) {
      for (const PlannedPoint& point : curve.points) results_.push_back({&curve, &point});
    }
  }

  void list(Runner& runner) {
    for (const Result& result : results_) {
      const auto record = runner.finished(result.point->run);
      out_ << fmt::format("{}: {}\n", result.point->run.label,
                          record ? status_text(record->status) : "to be run");
    }
    out_ << fmt::format("{} runs, results in {}\n", results_.size(), runner.results().string());
  }

  void run(Runner& runner) {
    std::mutex mutex;
    std::size_t done = 0;
    for_each_at_once(results_.size(), options_.runner.jobs, [&](std::size_t i) {
      Result& result = results_[i];
      const PlannedRun& planned = result.point->run;
      const bool kept = runner.finished(planned).has_value();
      result.record = runner.run(planned);
      const std::lock_guard<std::mutex> lock(mutex);
      if (result.record.status == RunRecord::Status::finished) read_figures(runner, result);
      std::string line =
          fmt::format("[{}/{}] {}: {}, {:.4g} s CPU", ++done, results_.size(), planned.label,
                      status_text(result.record.status), result.record.cpu);
      if (!std::isnan(result.value))
        line += fmt::format(", {} {:.4g}", measure_.figure, result.value);
      if (!result.record.message.empty()) line += ": " + result.record.message;
      out_ << line << (kept ? " (earlier run)" : "") << std::endl;
    });
  }

  void evaluate() {
    std::vector<Measured> measured;
    for (const Result& result : results_) {
      const bool is_finest = result.point == &result.curve->points.back();
      measured.push_back({result.curve->series, family_of(*result.curve), is_finest, result.value});
    }
    const std::vector<double> errors = errors_of(measure_, measured);
    std::vector<double> costs;
    for (const Result& result : results_) costs.push_back(result.record.cpu);
    const std::vector<bool> front = pareto_front(costs, errors);
    for (std::size_t i = 0; i < results_.size(); ++i) {
      results_[i].error = errors[i];
      results_[i].on_front = front[i];
    }
  }

  void report(Runner& runner) {
    const TextTable chart = chart_table(runner);
    const TextTable orders = orders_table();
    write_csv(runner.results() / "chart.csv", chart);
    write_csv(runner.results() / "orders.csv", orders);
    out_ << "\n" << aligned(short_table()) << "\n";
    if (!plan_.refinement_key.empty()) out_ << aligned(orders) << "\n";
    out_ << runner.notes(true) << notes();
    out_ << (runner.results() / "chart.csv").string() << "\n";
    std::vector<std::string> arguments = {
        "chart", runner.results().string(), "--title", study_.name, "--error", error_header()};
    if (!plan_.refinement_key.empty()) {
      arguments.insert(arguments.end(), {"--refinement", refinement_header()});
    }
    draw(options_.script, arguments, out_);
  }

 private:
  void read_figures(Runner& runner, Result& result) {
    const PlannedRun& planned = result.point->run;
    const Summary summary = runner.summary_of(planned);
    const Figure& figure =
        figure_of(summary, measure_.figure, measure_.location, "error.figure", planned.label);
    result.value = figure.value;
    figure_unit_ = figure.unit;
    for (const Figure& other : summary.figures) {
      if (other.name == "steps" || other.name == "micro steps") result.steps = other.value;
    }
  }

  std::string refinement_header() const {
    return fmt::format("{} [{}]", plan_.refinement_key, plan_.refinement_unit);
  }

  std::string error_header() const {
    const bool relative = measure_.against != ErrorMeasure::Against::itself;
    return fmt::format("error of {} [{}]", measure_.figure, relative ? "-" : figure_unit_);
  }

  TextTable chart_table(Runner& runner) const {
    TextTable table;
    table.header = {"curve", "series"};
    table.header.insert(table.header.end(), plan_.swept_keys.begin(), plan_.swept_keys.end());
    if (!plan_.refinement_key.empty()) table.header.push_back(refinement_header());
    for (const std::string& name :
         {fmt::format("{} [{}]", measure_.figure, figure_unit_), error_header(),
          std::string("cpu time [s]"), std::string("wall time [s]"), std::string("steps [-]"),
          std::string("status"), std::string("on front"), std::string("message"),
          std::string("folder")}) {
      table.header.push_back(name);
    }
    for (const Result& result : results_) {
      table.begin_row();
      table.add(result.curve->name);
      table.add(result.curve->series);
      for (const std::string& value : result.curve->swept) table.add(value);
      if (!plan_.refinement_key.empty()) table.add(result.point->refinement);
      table.add(result.value);
      table.add(result.error);
      table.add(result.record.cpu);
      table.add(result.record.wall);
      table.add(result.steps);
      table.add(status_text(result.record.status));
      table.add(std::string(result.on_front ? "yes" : "no"));
      table.add(result.record.message);
      table.add("runs/" + runner.folder_of(result.point->run).filename().string());
    }
    return table;
  }

  /// For the terminal.
  TextTable short_table() const {
    TextTable table;
    table.header = {"run", error_header(), "cpu time [s]", "steps [-]", "status", "front"};
    for (const Result& result : results_) {
      table.begin_row();
      table.add(result.point->run.label);
      table.add(result.error);
      table.add(result.record.cpu);
      table.add(result.steps);
      table.add(status_text(result.record.status));
      table.add(std::string(result.on_front ? "*" : ""));
    }
    return table;
  }

  TextTable orders_table() const {
    TextTable table;
    table.header = {"curve", "series"};
    table.header.insert(table.header.end(), plan_.swept_keys.begin(), plan_.swept_keys.end());
    for (const char* name : {"order [-]", "standard error [-]", "points [-]", "pairwise [-]"}) {
      table.header.emplace_back(name);
    }
    for (const Curve& curve : plan_.curves) {
      std::vector<double> refinements;
      std::vector<double> errors;
      for (const Result& result : results_) {
        if (result.curve != &curve) continue;
        refinements.push_back(result.point->refinement);
        errors.push_back(result.error);
      }
      const OrderFit fit = fit_order(refinements, errors);
      table.begin_row();
      table.add(curve.name);
      table.add(curve.series);
      for (const std::string& value : curve.swept) table.add(value);
      table.add(fit.order);
      table.add(fit.standard_error);
      table.add(static_cast<double>(fit.points));
      std::string pairwise;
      for (const double order : fit.pairwise) {
        pairwise += fmt::format("{}{:.3f}", pairwise.empty() ? "" : " ", order);
      }
      table.add(pairwise);
    }
    return table;
  }

  std::string notes() const {
    int without_reference = 0;
    for (const Result& result : results_) {
      const bool is_reference = measure_.against == ErrorMeasure::Against::finest &&
                                result.point == &result.curve->points.back();
      const bool finished = result.record.status == RunRecord::Status::finished;
      without_reference += finished && !is_reference && std::isnan(result.error) ? 1 : 0;
    }
    if (without_reference == 0) return "";
    return fmt::format(
        "note: {} finished runs have no error: their figure, or that of the finest run, is "
        "missing\n",
        without_reference);
  }

  const Study& study_;
  const ErrorMeasure& measure_;
  const StudyOptions& options_;
  std::ostream& out_;
  Plan plan_;
  std::vector<Result> results_;
  std::string figure_unit_ = "-";
};

}  // namespace

void chart_study(const Study& study, const StudyOptions& options, std::ostream& out) {
  if (!study.error) {
    throw CaseError({{study.file.string(), 0, 0, "error",
                      std::string("is missing; a chart needs [error] with figure = \"...\", the "
                                  "name of a figure in summary.json") +
                          (study.map ? "; --map draws the map of this study" : "")}});
  }
  ChartRun chart(study, options, out);
  Runner runner(study, options.runner);
  if (options.list) {
    chart.list(runner);
    return;
  }
  chart.run(runner);
  chart.evaluate();
  chart.report(runner);
}

}  // namespace hemoscale::coupling
