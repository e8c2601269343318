#include "coupling/study/read_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "coupling/config/parameter_table.hpp"
#include "coupling/error.hpp"
#include "coupling/study/section_reader.hpp"

namespace hemoscale::coupling {

namespace {

namespace fs = std::filesystem;
using Tree = ParameterTree;

fs::path find_study(const fs::path& named) {
  std::error_code ignored;
  if (fs::is_regular_file(named, ignored)) return named;
  if (fs::is_directory(named, ignored)) {
    if (fs::is_regular_file(named / "study.toml", ignored)) return named / "study.toml";
    throw CaseError(
        {{named.string(), 0, 0, "",
          "holds no study.toml; give a study file, or a folder that holds study.toml"}});
  }
  throw CaseError({{named.string(), 0, 0, "",
                    "there is no such folder or file; give a study file, or a folder that holds "
                    "study.toml"}});
}

class StudyReader {
 public:
  explicit StudyReader(const fs::path& file) : tree_(read_toml(file)), reader_(faults_) {
    study_.file = file;
    study_.folder = file.has_parent_path() ? file.parent_path() : fs::path(".");
  }

  Study read() {
    SectionReader top(&tree_, "", {"study", "error", "series", "refine", "sweep", "map"}, reader_,
                      faults_);
    read_heading();
    read_error();
    if (const Tree* refine = tree_.find("refine")) {
      study_.refine = read_axis(*refine, "refine", {"key", "values", "together"});
    }
    read_series();
    for (const Tree* sweep : sections("sweep")) {
      if (auto axis = read_axis(*sweep, "sweep", {"key", "values", "together"})) {
        study_.sweeps.push_back(*std::move(axis));
      }
    }
    read_map();
    check_error();
    check_axes();
    if (!faults_.empty()) {
      std::stable_sort(faults_.begin(), faults_.end(), [](const Fault& a, const Fault& b) {
        return std::pair(a.line, a.column) < std::pair(b.line, b.column);
      });
      throw CaseError(std::move(faults_));
    }
    return std::move(study_);
  }

 private:
  SectionReader section(const Tree* node, const std::string& name,
                        const std::vector<std::string>& known) {
    return SectionReader(node, name, known, reader_, faults_);
  }

  /// The tables of [[name]]; a single [name] is one of them.
  std::vector<const Tree*> sections(const std::string& name) {
    const Tree* node = tree_.find(name);
    if (node == nullptr) return {};
    if (node->kind != Tree::Kind::list) return {node};
    std::vector<const Tree*> tables;
    for (const Tree& element : node->elements) tables.push_back(&element);
    return tables;
  }

  void read_heading() {
    static const Tree empty;
    const Tree* node = tree_.find("study");
    SectionReader heading = section(node != nullptr ? node : &empty, "study",
                                    {"name", "case", "cases", "variant", "set", "repeats",
                                     "threads", "timeout", "force", "skip"});
    if (node == nullptr) {
      faults_.push_back({study_.file.string(), 0, 0, "study",
                         "is missing; a study begins with [study] and name = \"...\""});
    } else {
      heading.require("name", "\"time-steps\"");
    }
    study_.name = heading.word("name").value_or("");
    study_.variant = heading.text("variant").value_or("");
    study_.set = heading.overrides("set");
    study_.repeats = heading.count("repeats", 1000).value_or(1);
    study_.threads = heading.count("threads", 1024).value_or(1);
    study_.longest = heading.duration("timeout").value_or(study_.longest);
    study_.force = heading.flag("force").value_or(false);
    study_.skip = read_skips(heading);
    if (heading.find("case") != nullptr && heading.find("cases") != nullptr) {
      heading.refuse("cases", "stands beside 'case'; keep one of them");
    }
    if (const auto path = heading.text("case")) study_.cases.push_back(study_.folder / *path);
    for (const Tree& element : heading.list("cases")) {
      const auto* text = std::get_if<std::string>(&element.scalar);
      if (element.kind != Tree::Kind::scalar || text == nullptr) {
        heading.refuse("cases", "must be a list of paths such as [\"../a\", \"../b\"]");
      } else {
        study_.cases.push_back(study_.folder / *text);
      }
    }
    if (study_.cases.empty()) study_.cases.push_back(study_.folder);
  }

  std::vector<Skip> read_skips(SectionReader& owner) {
    std::vector<Skip> skips;
    for (const Tree& element : owner.list("skip")) {
      if (element.kind != Tree::Kind::table || element.children.empty()) {
        owner.refuse("skip", "must be a list of combinations such as [{ \"micro.cells\" = 40 }]");
        continue;
      }
      skips.push_back({owner.place("skip"), flattened(element)});
    }
    return skips;
  }

  void read_error() {
    SectionReader error = section(tree_.find("error"), "error", {"figure", "against", "series"});
    if (!error.exists()) return;
    error.require("figure", "\"relative error of the velocity\"");
    ErrorMeasure measure;
    measure.figure = error.text("figure").value_or("");
    measure.location = error.place("figure");
    measure.series = error.text("series").value_or("");
    const Tree* against = error.find("against");
    if (against != nullptr && against->kind == Tree::Kind::scalar &&
        against->scalar == Tree::Scalar(std::string("finest"))) {
      measure.against = ErrorMeasure::Against::finest;
    } else if (against != nullptr) {
      measure.against = ErrorMeasure::Against::number;
      if (const auto value = error.number("against", {})) {
        measure.reference = *value;
        if (*value == 0) {
          error.refuse("against",
                       "is 0, of which there is no relative difference; chart a figure "
                       "that is itself an error, and leave 'against' out");
        }
      }
    }
    if (!measure.series.empty() && measure.against != ErrorMeasure::Against::finest) {
      error.refuse("series", "names whose finest run is the reference; add against = \"finest\"");
    }
    study_.error = measure;
  }

  /// @param known  keys that the section may hold
  std::optional<Axis> read_axis(const Tree& node, const std::string& name,
                                const std::vector<std::string>& known) {
    SectionReader section = this->section(&node, name, known);
    if (!section.exists()) return std::nullopt;
    section.require("key", "\"micro.time_step\"");
    section.require("values", "[1, 2, 4]");
    return make_axis(section, section.text("key").value_or(""), "values");
  }

  Axis make_axis(SectionReader& section, const std::string& key, const std::string& values) {
    Axis axis;
    axis.key = key;
    axis.location = section.place(values);
    for (const Tree& value : section.list(values)) axis.steps.push_back({{key, value}});
    for (const Override& along : section.overrides("together")) {
      if (along.value.kind != Tree::Kind::list ||
          along.value.elements.size() != axis.steps.size()) {
        section.refuse("together", fmt::format("{} needs as many values as {} has, {}", along.key,
                                               key, axis.steps.size()));
        continue;
      }
      for (std::size_t i = 0; i < axis.steps.size(); ++i) {
        axis.steps[i].push_back({along.key, along.value.elements[i]});
      }
    }
    return axis;
  }

  void read_series() {
    std::set<std::string> names;
    for (const Tree* node : sections("series")) {
      SectionReader section =
          this->section(node, "series", {"name", "set", "values", "together", "skip"});
      if (!section.exists()) continue;
      section.require("name", "\"explicit\"");
      Series series;
      series.name = section.text("name").value_or("");
      series.location = section.place("name");
      series.set = section.overrides("set");
      series.skip = read_skips(section);
      if (section.find("values") != nullptr) {
        if (study_.refine) {
          series.refine = make_axis(section, study_.refine->key, "values");
        } else {
          section.refuse("values", "replaces the values of [refine], which is not there; add it");
        }
      } else if (section.find("together") != nullptr) {
        section.refuse("together", "belongs to 'values', which is not there; add it");
      }
      if (!series.name.empty() && !names.insert(series.name).second) {
        section.refuse("name", "is the name of an earlier series too; names tell curves apart");
      }
      study_.series.push_back(std::move(series));
    }
    if (study_.series.empty()) study_.series.emplace_back();
  }

  void read_map() {
    SectionReader section = this->section(
        tree_.find("map"), "map", {"key", "stable", "unstable", "tolerance", "predicted", "along"});
    if (!section.exists()) return;
    section.require("key", "\"micro.time_step\"");
    section.require("stable", "\"1 ns\"");
    section.require("unstable", "\"1 ms\"");
    MapQuestion map;
    map.key = section.text("key").value_or("");
    map.location = section.place("key");
    map.tolerance =
        section.number("tolerance", {.lowest = 1e-9, .highest = 1}).value_or(map.tolerance);
    map.predicted = section.text("predicted").value_or("");
    if (const Tree* along = section.find("along")) {
      map.along = read_axis(*along, "map.along", {"key", "values", "together"});
    }
    const Parameter* parameter = find_parameter(map.key);
    if (parameter == nullptr) {
      if (!map.key.empty()) {
        section.refuse("key",
                       shown(map.key) + " is not a key of a case; `hemoscale reference` lists all");
      }
      return;
    }
    if (parameter->kind != ParameterKind::quantity && parameter->kind != ParameterKind::number) {
      section.refuse("key", map.key + " is not a quantity that can be divided; choose one that is");
      return;
    }
    map.unit = parameter->unit.empty() ? "-" : parameter->unit;
    map.stable = read_end(section, "stable", *parameter);
    map.unstable = read_end(section, "unstable", *parameter);
    if (map.stable > 0 && map.stable == map.unstable) {
      section.refuse("unstable", "equals 'stable'; the boundary is sought between the two");
    }
    study_.map = std::move(map);
  }

  double read_end(SectionReader& section, const std::string& name, Parameter parameter) {
    const Tree* node = section.find(name);
    if (node == nullptr) return 0;
    // Halved geometrically, so that both ends must be positive.
    if (parameter.range.lowest <= 0) {
      parameter.range.lowest = 0;
      parameter.range.lowest_allowed = false;
    }
    const auto value = reader_.read(parameter, "map." + name, *node);
    return value ? std::get<double>(*value) : 0;
  }

  void check_error() {
    if (!study_.error) return;
    const ErrorMeasure& measure = *study_.error;
    if (measure.against == ErrorMeasure::Against::finest && !study_.refine) {
      add(measure.location, "error.against",
          "\"finest\" needs [refine], whose last value is the finest");
    }
    const bool known = std::any_of(study_.series.begin(), study_.series.end(),
                                   [&](const Series& s) { return s.name == measure.series; });
    if (!measure.series.empty() && !known) {
      add(measure.location, "error.series",
          "there is no series of the name " + shown(measure.series));
    }
  }

  /// Two axes of one key would overwrite each other.
  void check_axes() {
    std::set<std::string> keys;
    if (study_.refine) keys.insert(study_.refine->key);
    for (const Axis& axis : study_.sweeps) {
      if (!keys.insert(axis.key).second) {
        add(axis.location, "sweep.key", axis.key + " is an axis already; keep one of them");
      }
    }
  }

  void add(const Location& at, const std::string& key, const std::string& message) {
    faults_.push_back({at.file, at.line, at.column, key, message});
  }

  ParameterTree tree_;
  std::vector<Fault> faults_;
  ValueReader reader_;
  Study study_;
};

}  // namespace

Study read_study(const fs::path& named) {
  return StudyReader(find_study(named)).read();
}

}  // namespace hemoscale::coupling
