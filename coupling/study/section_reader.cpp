#include "coupling/study/section_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "coupling/config/nearest_key.hpp"

namespace hemoscale::coupling {

namespace {

using Tree = ParameterTree;

void flatten(const Tree& table, const std::string& prefix, std::vector<Override>& flat) {
  for (const auto& [name, child] : table.children) {
    const std::string key = prefix.empty() ? name : prefix + "." + name;
    if (child.kind == Tree::Kind::table) {
      flatten(child, key, flat);
    } else {
      flat.push_back({key, child});
    }
  }
}

}  // namespace

std::vector<Override> flattened(const ParameterTree& table) {
  std::vector<Override> flat;
  flatten(table, "", flat);
  return flat;
}

SectionReader::SectionReader(const ParameterTree* node, std::string name,
                             const std::vector<std::string>& known, ValueReader& reader,
                             std::vector<Fault>& faults)
    : node_(node), name_(std::move(name)), reader_(reader), faults_(faults) {
  if (node_ == nullptr) return;
  if (node_->kind != Tree::Kind::table) {
    faults_.push_back({node_->location.file, node_->location.line, node_->location.column, name_,
                       fmt::format("is a section, not a value, got {}; its keys are {}",
                                   shown(*node_), fmt::join(known, ", "))});
    node_ = nullptr;
    return;
  }
  for (const auto& [key, child] : node_->children) {
    if (std::count(known.begin(), known.end(), key) > 0) continue;
    refuse(key, fmt::format("is not a known key of a study; the nearest is {}; known here are {}",
                            nearest_word(key, known), fmt::join(known, ", ")));
  }
}

const ParameterTree* SectionReader::find(const std::string& key) const {
  return node_ != nullptr ? node_->find(key) : nullptr;
}

Location SectionReader::place(const std::string& key) const {
  const Tree* found = find(key);
  return found != nullptr ? found->location : place();
}

std::string SectionReader::full(const std::string& key) const {
  return name_.empty() ? key : name_ + "." + key;
}

void SectionReader::refuse(const std::string& key, const std::string& message) {
  const Location at = place(key);
  faults_.push_back({at.file, at.line, at.column, full(key), message});
}

void SectionReader::require(const std::string& key, const std::string& example) {
  if (node_ == nullptr || find(key) != nullptr) return;
  refuse(key, "is missing; write for example " + key + " = " + example);
}

template <class Value>
std::optional<Value> SectionReader::read(const std::string& key, Parameter parameter) {
  const Tree* node = find(key);
  if (node == nullptr) return std::nullopt;
  parameter.key = full(key);
  const std::optional<Settings::Value> value = reader_.read(parameter, parameter.key, *node);
  if (!value) return std::nullopt;
  return std::get<Value>(*value);
}

std::optional<std::string> SectionReader::text(const std::string& key) {
  return read<std::string>(key, {.kind = ParameterKind::text});
}

std::optional<std::string> SectionReader::word(const std::string& key) {
  return read<std::string>(key, {.kind = ParameterKind::name});
}

std::optional<bool> SectionReader::flag(const std::string& key) {
  return read<bool>(key, {.kind = ParameterKind::boolean});
}

std::optional<int> SectionReader::count(const std::string& key, int highest) {
  const auto value =
      read<std::int64_t>(key, {.kind = ParameterKind::integer,
                               .range = {.lowest = 1, .highest = static_cast<double>(highest)}});
  if (!value) return std::nullopt;
  return static_cast<int>(*value);
}

std::optional<double> SectionReader::duration(const std::string& key) {
  return read<double>(key, {.kind = ParameterKind::quantity,
                            .unit = "s",
                            .range = {.lowest = 0, .lowest_allowed = false}});
}

std::optional<double> SectionReader::number(const std::string& key, const Range& range) {
  return read<double>(key, {.kind = ParameterKind::number, .range = range});
}

std::vector<ParameterTree> SectionReader::list(const std::string& key) {
  const Tree* node = find(key);
  if (node == nullptr) return {};
  if (node->kind != Tree::Kind::list || node->elements.empty()) {
    refuse(key, "must be a list with at least one value, such as [1, 2, 4]");
    return {};
  }
  return node->elements;
}

std::vector<Override> SectionReader::overrides(const std::string& key) {
  const Tree* node = find(key);
  if (node == nullptr) return {};
  if (node->kind != Tree::Kind::table) {
    refuse(key, fmt::format("got {}; expected keys of the case with their values, such as "
                            "{{ \"micro.cells\" = 40 }}",
                            shown(*node)));
    return {};
  }
  std::vector<Override> flat = flattened(*node);
  std::set<std::string> seen;
  for (const Override& setting : flat) {
    if (!seen.insert(setting.key).second) refuse(key, setting.key + " is given twice in it");
  }
  return flat;
}

}  // namespace hemoscale::coupling
