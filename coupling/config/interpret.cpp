#include "coupling/config/interpret.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <map>
#include <utility>

#include "coupling/config/collect_values.hpp"
#include "coupling/config/nearest_key.hpp"
#include "coupling/config/overrides.hpp"
#include "coupling/config/read_value.hpp"
#include "coupling/error.hpp"

namespace hemoscale::coupling {

namespace {

using Values = std::map<std::string, Given>;

/// unknown: it hangs on a value that is faulty itself; whatever follows is not reported.
enum class Answer { yes, no, unknown };

/// Whether keys apply, given what the user wrote and the defaults of the rest.
class Applicability {
 public:
  Applicability(const std::vector<Parameter>& table, const Values& values) : values_(values) {
    for (const Parameter& parameter : table) parameters_.emplace(parameter.key, &parameter);
  }

  Answer applies(const Parameter& parameter) const { return all_hold(parameter.applies_when); }

  Answer all_hold(const std::vector<Condition>& conditions) const {
    Answer answer = Answer::yes;
    for (const Condition& condition : conditions) {
      const Answer one = holds(condition);
      if (one == Answer::no) return Answer::no;
      if (one == Answer::unknown) answer = Answer::unknown;
    }
    return answer;
  }

  /// Why a key does not apply: the innermost condition that fails, as "key = value it has".
  std::string reason(const Parameter& parameter) const {
    for (const Condition& condition : parameter.applies_when) {
      if (holds(condition) != Answer::no) continue;
      const Parameter& chooser = *parameters_.at(condition.key);
      if (applies(chooser) == Answer::no && !condition.value.empty()) return reason(chooser);
      return condition.value.empty() ? condition.key + " is given"
                                     : condition.key + " = " + value_text(chooser);
    }
    return "";
  }

 private:
  Answer holds(const Condition& condition) const {
    const Parameter& chooser = *parameters_.at(condition.key);
    const auto given = values_.find(condition.key);
    if (condition.value.empty()) {
      return given == values_.end() && !chooser.default_value ? Answer::yes : Answer::no;
    }
    const Answer chooser_applies = applies(chooser);
    if (chooser_applies != Answer::yes) return chooser_applies;
    if (given != values_.end() && !given->second.value) return Answer::unknown;
    return (value_text(chooser) == condition.value) != condition.differs ? Answer::yes : Answer::no;
  }

  std::string value_text(const Parameter& chooser) const {
    const auto given = values_.find(chooser.key);
    if (given == values_.end()) return chooser.default_value.value_or("");
    if (!given->second.value) return "";
    if (const bool* boolean = std::get_if<bool>(&*given->second.value)) {
      return *boolean ? "true" : "false";
    }
    const auto* text = std::get_if<std::string>(&*given->second.value);
    return text != nullptr ? *text : "";
  }

  const Values& values_;
  std::map<std::string, const Parameter*> parameters_;
};

class Interpreter {
 public:
  Interpreter(const ParameterTree& tree, const std::vector<Parameter>& table,
              const std::vector<Override>& overrides)
      : tree_(tree),
        table_(table),
        reader_(faults_),
        layers_(collect_values(tree, table, reader_, faults_)),
        overrides_(
            collect_values(override_tree(overrides, faults_), table, reader_, faults_).base) {}

  Settings interpret(const std::string& asked_variant) {
    const Layer* variant = chosen_variant(asked_variant);
    std::vector<const Layer*> layers = {&layers_.base};
    if (variant != nullptr) layers.push_back(variant);
    if (!overrides_.values.empty()) layers.push_back(&overrides_);
    // What holds after each layer; the last is what counts.
    std::vector<Values> stack;
    for (const Layer* layer : layers) {
      stack.push_back(stack.empty() ? Values() : stack.back());
      for (const auto& [key, given] : layer->values) stack.back()[key] = given;
    }
    const Values& effective = stack.back();
    const Applicability applicable(table_, effective);
    refuse_inapplicable(layers, stack);
    for (const Parameter& parameter : table_) {
      if (applicable.applies(parameter) == Answer::yes) {
        assign(parameter, effective, applicable, variant);
      }
    }
    compare_keys(applicable, effective);
    throw_if_faulty();
    return std::move(settings_);
  }

 private:
  const Layer* chosen_variant(const std::string& asked) {
    std::string name = asked;
    Fault fault{tree_.location.file, 0, 0, "", ""};
    const auto given = layers_.base.values.find("case.variant");
    if (asked.empty() && given != layers_.base.values.end() && given->second.value) {
      name = std::get<std::string>(*given->second.value);
      fault = {given->second.location.file, given->second.location.line,
               given->second.location.column, "case.variant", ""};
    }
    if (name.empty()) return nullptr;
    std::vector<std::string> names;
    for (const auto& [variant_name, layer] : layers_.variants) {
      if (variant_name == name) return &layer;
      names.push_back(variant_name);
    }
    fault.message = "there is no variant " + shown(name) + "; ";
    fault.message +=
        names.empty() ? "the case has no variants: write [variant.NAME] with the keys that differ"
                      : fmt::format("the case has {}", fmt::join(names, ", "));
    faults_.push_back(std::move(fault));
    throw_if_faulty();  // which keys apply or are missing depends on the variant
    return nullptr;
  }

  /// A key that was given although it does not apply is a fault of the layer that holds it, unless
  /// a later layer has switched it off or was waited for:
  ///  - of the overrides always, because nobody else can have switched it off; of a variant
  ///    likewise, unless the overrides have;
  ///  - of the case itself only if it does not apply there either. A variant may switch to another
  ///    model, and the keys of the case for the first model then rest; and a key of the case may
  ///    wait for a variant that makes it apply.
  ///
  /// @param stack  what holds after each of the layers
  void refuse_inapplicable(const std::vector<const Layer*>& layers,
                           const std::vector<Values>& stack) {
    std::vector<Applicability> after;
    for (const Values& values : stack) after.emplace_back(table_, values);
    for (const Parameter& parameter : table_) {
      for (std::size_t i = layers.size(); i-- > 0;) {
        if (after[i].applies(parameter) != Answer::no) break;  // here or in what stands below
        const auto given = layers[i]->values.find(parameter.key);
        if (given != layers[i]->values.end()) add_inapplicable(parameter, given->second, after[i]);
      }
    }
  }

  void add_inapplicable(const Parameter& parameter, const Given& given,
                        const Applicability& applicable) {
    add(given.location, given.written_key,
        fmt::format("does not apply, because {}; it applies when {}: remove it, or put it into the "
                    "variant that needs it",
                    applicable.reason(parameter), conditions_text(parameter.applies_when)));
  }

  void assign(const Parameter& parameter, const Values& effective, const Applicability& applicable,
              const Layer* variant) {
    const auto given = effective.find(parameter.key);
    if (given != effective.end()) {
      if (given->second.value) {
        settings_.assign(parameter.key, *given->second.value, given->second.location, true);
      }
      return;
    }
    const Answer has_default = applicable.all_hold(parameter.default_when);
    if (has_default == Answer::unknown) return;
    if (parameter.default_value && has_default == Answer::yes) {
      ParameterTree written;
      written.kind = ParameterTree::Kind::scalar;
      written.scalar = *parameter.default_value;
      const auto value = reader_.read(parameter, parameter.key, written);
      assert(value && "a default must be a valid value");
      if (value) settings_.assign(parameter.key, *value, {}, false);
      return;
    }
    if (parameter.required || parameter.default_value) add_missing(parameter, variant);
  }

  void add_missing(const Parameter& parameter, const Layer* variant) {
    // One mistake, one fault: a misspelled key was reported with the name that it should have.
    for (const Layer* layer : {&std::as_const(layers_.base), variant, &std::as_const(overrides_)}) {
      if (layer != nullptr && layer->probably_misspelled.count(parameter.key) > 0) return;
    }
    std::string message = "is missing";
    if (!parameter.applies_when.empty()) {
      message += "; it is needed when " + conditions_text(parameter.applies_when);
    }
    if (!parameter.default_when.empty()) {
      message += "; it has a default only when " + conditions_text(parameter.default_when);
    }
    const std::size_t dot = parameter.key.rfind('.');
    message +=
        fmt::format(". {} Write {} = {} in [{}]", parameter.sentence, parameter.key.substr(dot + 1),
                    example_value(parameter), parameter.key.substr(0, dot));
    add(section_location(parameter.key, variant), parameter.key, message);
  }

  /// Where a missing key would stand: the innermost section that exists.
  Location section_location(const std::string& key, const Layer* variant) const {
    for (std::size_t dot = key.rfind('.'); dot != std::string::npos && dot > 0;
         dot = key.rfind('.', dot - 1)) {
      const std::string section = key.substr(0, dot);
      for (const Layer* layer : {&layers_.base, variant}) {
        if (layer == nullptr) continue;
        const auto place = layer->sections.find(section);
        if (place != layer->sections.end()) return place->second;
      }
    }
    return {tree_.location.file, 0, 0};
  }

  /// Pairs of keys of which one must exceed the other.
  void compare_keys(const Applicability& applicable, const Values& effective) {
    for (const Parameter& parameter : table_) {
      if (!parameter.exceeds || applicable.applies(parameter) != Answer::yes) continue;
      const auto value = assigned(parameter.key);
      const auto other = assigned(parameter.exceeds->than);
      if (!value || !other) continue;
      if (*value > *other || (parameter.exceeds->or_equal && *value == *other)) continue;
      const auto given = effective.find(parameter.key);
      const auto given_other = effective.find(parameter.exceeds->than);
      Location location{tree_.location.file, 0, 0};
      if (given_other != effective.end()) location = given_other->second.location;
      if (given != effective.end()) location = given->second.location;
      add(location, given != effective.end() ? given->second.written_key : parameter.key,
          fmt::format("{:.6g}{}{} must {} {} = {:.6g}; change one of them", *value,
                      parameter.unit.empty() ? "" : " ", parameter.unit,
                      parameter.exceeds->or_equal ? "be at least" : "exceed",
                      parameter.exceeds->than, *other));
    }
  }

  std::optional<double> assigned(const std::string& key) const {
    if (!settings_.has(key)) return std::nullopt;
    return settings_.quantity(key);
  }

  void throw_if_faulty() {
    if (faults_.empty()) return;
    // In file order; what has no place comes last.
    std::stable_sort(faults_.begin(), faults_.end(), [](const Fault& a, const Fault& b) {
      const bool a_placed = a.line > 0;
      const bool b_placed = b.line > 0;
      if (a_placed != b_placed) return a_placed;
      return std::pair(a.line, a.column) < std::pair(b.line, b.column);
    });
    throw CaseError(std::move(faults_));
  }

  void add(const Location& location, const std::string& key, const std::string& message) {
    faults_.push_back({location.file, location.line, location.column, key, message});
  }

  const ParameterTree& tree_;
  const std::vector<Parameter>& table_;
  std::vector<Fault> faults_;
  ValueReader reader_;  // one for the case, its variants and the defaults
  Layers layers_;
  Layer overrides_;
  Settings settings_;
};

}  // namespace

Settings interpret(const ParameterTree& tree, const std::string& variant,
                   const std::vector<Parameter>& table, const std::vector<Override>& overrides) {
  return Interpreter(tree, table, overrides).interpret(variant);
}

Settings interpret(const ParameterTree& tree, const std::string& variant,
                   const std::vector<Override>& overrides) {
  return interpret(tree, variant, parameter_table(), overrides);
}

std::vector<std::string> variant_names(const ParameterTree& tree) {
  std::vector<std::string> names;
  if (const ParameterTree* variants = tree.find("variant")) {
    for (const auto& [name, child] : variants->children) names.push_back(name);
  }
  return names;
}

}  // namespace hemoscale::coupling
