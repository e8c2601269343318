#include "coupling/study/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <set>
#include <tuple>
#include <utility>

#include "coupling/config/overrides.hpp"
#include "coupling/config/parameter_table.hpp"
#include "coupling/error.hpp"
#include "coupling/report/identity.hpp"
#include "coupling/report/summary.hpp"
#include "coupling/scene/run_case.hpp"

namespace hemoscale::coupling {

namespace {

namespace fs = std::filesystem;

/// "time_step" of "micro.time_step".
std::string last_word(const std::string& key) {
  return key.substr(key.rfind('.') + 1);
}

/// A value as the user thinks of it: without quotes.
std::string value_text(const ParameterTree& value) {
  const auto* text =
      value.kind == ParameterTree::Kind::scalar ? std::get_if<std::string>(&value.scalar) : nullptr;
  return text != nullptr ? *text : toml_text(value);
}

/// Later settings replace earlier ones of the same key.
void set(std::vector<Override>& overrides, const std::vector<Override>& more) {
  for (const Override& setting : more) {
    const auto same = std::find_if(overrides.begin(), overrides.end(),
                                   [&](const Override& o) { return o.key == setting.key; });
    if (same != overrides.end()) {
      *same = setting;
    } else {
      overrides.push_back(setting);
    }
  }
}

void append_label(std::string& label, const std::string& part) {
  label += (label.empty() || part.empty() ? "" : ", ") + part;
}

std::string step_label(const std::string& key, const Step& step) {
  return last_word(key) + " " + value_text(step.front().value);
}

bool matches(const Skip& skip, const PlannedRun& run) {
  return std::all_of(skip.matches.begin(), skip.matches.end(), [&](const Override& wanted) {
    return std::any_of(run.overrides.begin(), run.overrides.end(), [&](const Override& setting) {
      return setting.key == wanted.key && toml_text(setting.value) == toml_text(wanted.value);
    });
  });
}

/// Faults of many runs of one study, each told once.
class FaultCollector {
 public:
  template <class Action>
  void attempt(const Action& action) {
    try {
      action();
    } catch (const CaseError& error) {
      for (const Fault& fault : error.faults()) add(fault);
    }
  }
  void add(const Fault& fault) {
    if (seen_.insert({fault.file, fault.line, fault.column, fault.key, fault.message}).second) {
      faults_.push_back(fault);
    }
  }
  void throw_if_any() const {
    if (!faults_.empty()) throw CaseError(faults_);
  }

 private:
  std::set<std::tuple<std::string, int, int, std::string, std::string>> seen_;
  std::vector<Fault> faults_;
};

/// Checks a run and gives it its identity. Units are read by one thread at a time.
Settings settle(const Study& study, PlannedRun& run) {
  static std::mutex one_at_a_time;
  const std::lock_guard<std::mutex> lock(one_at_a_time);
  Settings settings = load_case(run.case_folder, run.variant, run.force, run.overrides);
  auto identity = settings.as_text();
  identity["program version"] = program_version();
  identity["threads of a run"] = fmt::format("{}", study.threads);
  run.identity = identity_hash(identity);
  return settings;
}

/// The number behind a key of a checked case [SI]; nan if it is none.
double number_of(const Settings& settings, const std::string& key) {
  const Parameter* parameter = find_parameter(key);
  if (parameter != nullptr && settings.has(key)) {
    if (parameter->kind == ParameterKind::integer) {
      return static_cast<double>(settings.integer(key));
    }
    if (parameter->kind == ParameterKind::quantity || parameter->kind == ParameterKind::number) {
      return settings.quantity(key);
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

std::string unit_of(const std::string& key) {
  const Parameter* parameter = find_parameter(key);
  return parameter == nullptr || parameter->unit.empty() ? "-" : parameter->unit;
}

/// A series with one combination of swept values, and no values of further axes.
struct Base {
  std::string name;
  const Series* series;
  std::vector<std::string> swept;
  PlannedRun run;
};

std::vector<std::string> swept_keys(const Study& study) {
  std::vector<std::string> keys;
  if (study.cases.size() > 1) keys.emplace_back("case");
  for (const Axis& axis : study.sweeps) keys.push_back(axis.key);
  return keys;
}

std::vector<Base> bases(const Study& study) {
  std::vector<Base> all;
  for (const Series& series : study.series) {
    std::vector<Base> of_series;
    for (const fs::path& folder : study.cases) {
      Base base{series.name, &series, {}, {}};
      base.run.case_folder = folder;
      base.run.variant = study.variant;
      base.run.force = study.force;
      set(base.run.overrides, study.set);
      set(base.run.overrides, series.set);
      if (study.cases.size() > 1) {
        const fs::path named = folder.has_filename() ? folder : folder.parent_path();
        base.swept.push_back(named.filename().string());
        append_label(base.name, base.swept.back());
      }
      of_series.push_back(std::move(base));
    }
    for (const Axis& axis : study.sweeps) {
      std::vector<Base> finer;
      for (const Base& base : of_series) {
        for (const Step& step : axis.steps) {
          finer.push_back(base);
          set(finer.back().run.overrides, step);
          finer.back().swept.push_back(value_text(step.front().value));
          append_label(finer.back().name, step_label(axis.key, step));
        }
      }
      of_series = std::move(finer);
    }
    all.insert(all.end(), of_series.begin(), of_series.end());
  }
  return all;
}

/// Skips that match nothing are mistakes: a misspelled key or value.
class SkipWatch {
 public:
  bool skips(const std::vector<Skip>& skips, const PlannedRun& run) {
    bool skipped = false;
    for (const Skip& skip : skips) {
      known_.insert(&skip);
      if (!matches(skip, run)) continue;
      used_.insert(&skip);
      skipped = true;
    }
    return skipped;
  }
  void report(FaultCollector& faults) const {
    for (const Skip* skip : known_) {
      if (used_.count(skip) > 0) continue;
      std::vector<std::string> texts;
      for (const Override& wanted : skip->matches) texts.push_back(override_text(wanted));
      faults.add({skip->location.file, skip->location.line, skip->location.column, "skip",
                  fmt::format("{} is no combination of this study: leave it out, or write key and "
                              "value as they stand in set, refine or sweep",
                              fmt::join(texts, " with "))});
    }
  }

 private:
  std::set<const Skip*> known_;
  std::set<const Skip*> used_;
};

void require_number(double value, const std::string& key, const Axis& axis,
                    FaultCollector& faults) {
  if (value > 0) return;
  faults.add({axis.location.file, axis.location.line, axis.location.column, "refine.values",
              fmt::format("{} = {:g} is no positive number, so that there is no order of "
                          "convergence along it; use [[sweep]]",
                          key, value)});
}

}  // namespace

Plan plan_chart(const Study& study) {
  Plan plan;
  plan.swept_keys = swept_keys(study);
  if (study.refine) {
    plan.refinement_key = study.refine->key;
    plan.refinement_unit = unit_of(study.refine->key);
  }
  FaultCollector faults;
  SkipWatch watch;
  for (const Base& base : bases(study)) {
    Curve curve{base.name, base.series->name, base.swept, {}};
    const std::optional<Axis>& axis = base.series->refine ? base.series->refine : study.refine;
    const std::vector<Step> none(1);
    for (const Step& step : axis ? axis->steps : none) {
      PlannedPoint point{base.run};
      set(point.run.overrides, step);
      point.run.label = base.name;
      if (!step.empty()) append_label(point.run.label, step_label(axis->key, step));
      if (point.run.label.empty()) point.run.label = study.name;
      const bool skipped = watch.skips(study.skip, point.run);
      if (watch.skips(base.series->skip, point.run) || skipped) continue;
      faults.attempt([&] {
        const Settings settings = settle(study, point.run);
        if (!axis) return;
        point.refinement = number_of(settings, axis->key);
        require_number(point.refinement, axis->key, *axis, faults);
      });
      curve.points.push_back(std::move(point));
    }
    if (!curve.points.empty()) plan.curves.push_back(std::move(curve));
  }
  watch.report(faults);
  faults.throw_if_any();
  return plan;
}

MapPlan plan_map(const Study& study) {
  MapPlan plan;
  plan.swept_keys = swept_keys(study);
  const MapQuestion& map = *study.map;
  if (map.along) {
    plan.along_key = map.along->key;
    plan.along_unit = unit_of(map.along->key);
  }
  FaultCollector faults;
  SkipWatch watch;  // those of the refinement axis match nothing here, and are not reported
  for (const Base& base : bases(study)) {
    MapCurve curve{base.name, base.series->name, base.swept, {}, {}, {}, base.run};
    for (const Step& step : map.along ? map.along->steps : std::vector<Step>(1)) {
      PlannedRun bare = base.run;
      set(bare.overrides, step);
      const bool skipped = watch.skips(study.skip, bare);
      if (watch.skips(base.series->skip, bare) || skipped) continue;
      curve.along.push_back(step);
      curve.along_texts.push_back(step.empty() ? "" : value_text(step.front().value));
      curve.abscissas.push_back(std::numeric_limits<double>::quiet_NaN());
      faults.attempt([&] {
        for (const double end : {map.stable, map.unstable}) {
          const PlannedRun run = probe(study, curve, curve.along.size() - 1, end);
          if (!map.along) continue;
          const Settings settings = load_case(run.case_folder, run.variant, true, run.overrides);
          curve.abscissas.back() = number_of(settings, map.along->key);
        }
      });
    }
    if (curve.along.empty()) continue;
    plan.curves.push_back(std::move(curve));
  }
  faults.throw_if_any();
  return plan;
}

PlannedRun probe(const Study& study, const MapCurve& curve, std::size_t along, double value) {
  const MapQuestion& map = *study.map;
  PlannedRun run = curve.base;
  run.force = true;
  run.label = curve.name;
  if (map.along) {
    set(run.overrides, curve.along[along]);
    append_label(run.label, step_label(map.along->key, curve.along[along]));
  }
  ParameterTree number;
  number.kind = ParameterTree::Kind::scalar;
  number.location = map.location;
  number.scalar = value;
  set(run.overrides, {{map.key, number}});
  append_label(run.label, fmt::format("{} {:.5g} {}", last_word(map.key), value, map.unit));
  settle(study, run);
  return run;
}

}  // namespace hemoscale::coupling
