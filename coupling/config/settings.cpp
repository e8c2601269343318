#include "coupling/config/settings.hpp"

#include <fmt/format.h>

#include <cassert>
#include <stdexcept>
#include <utility>

#include "coupling/config/parameter_table.hpp"

namespace hemoscale::coupling {

namespace {

struct ToText {
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
  // The shortest digits that read back as the same number.
  std::string operator()(double value) const { return fmt::format("{}", value); }
  std::string operator()(const std::string& value) const { return value; }
  std::string operator()(const std::vector<double>& values) const {
    std::string text;
    for (const double value : values) text += (text.empty() ? "" : ", ") + (*this)(value);
    return "[" + text + "]";
  }
  std::string operator()(const Settings::Points& points) const {
    std::string text;
    for (const Eigen::Vector3d& point : points) {
      if (!text.empty()) text += ", ";
      text += fmt::format("[{}, {}, {}]", point.x(), point.y(), point.z());
    }
    return "[" + text + "]";
  }
};

/// The caller asked for something that the table does not promise: a bug, never the user's fault.
[[noreturn]] void bug(const std::string& key, const char* what) {
  const std::string message = "Settings: " + key + " " + what;
  assert(message.empty());  // always false here: stops with a stack trace where assertions are on
  throw std::logic_error(message);
}

/// A key without a value must at least be one that could have had a value.
void require_known(const std::string& key) {
  if (find_parameter(key) == nullptr) bug(key, "is not a key of the parameter table");
}

/// One accessor per type; the table fixes the type of a key, so a mismatch is a bug of the caller.
template <class T, class Entries>
const T& value_of(const Entries& entries, const std::string& key) {
  const auto entry = entries.find(key);
  if (entry == entries.end()) require_known(key);
  if (entry == entries.end()) bug(key, "has no value in this case; ask has() first");
  const T* value = std::get_if<T>(&entry->second.value);
  if (value == nullptr) bug(key, "was asked for as another type than the table gives it");
  return *value;
}

}  // namespace

bool Settings::boolean(const std::string& key) const {
  return value_of<bool>(entries_, key);
}

std::int64_t Settings::integer(const std::string& key) const {
  return value_of<std::int64_t>(entries_, key);
}

double Settings::quantity(const std::string& key) const {
  return value_of<double>(entries_, key);
}

const std::string& Settings::text(const std::string& key) const {
  return value_of<std::string>(entries_, key);
}

const std::vector<double>& Settings::quantities(const std::string& key) const {
  return value_of<std::vector<double>>(entries_, key);
}

const Settings::Points& Settings::points(const std::string& key) const {
  return value_of<Points>(entries_, key);
}

bool Settings::has(const std::string& key) const {
  if (entries_.count(key) > 0) return true;
  require_known(key);
  return false;
}

bool Settings::was_given(const std::string& key) const {
  return has(key) && entries_.at(key).given;
}

Location Settings::location(const std::string& key) const {
  return has(key) ? entries_.at(key).location : Location{};
}

std::map<std::string, std::string> Settings::as_text() const {
  std::map<std::string, std::string> texts;
  for (const auto& [key, entry] : entries_) texts[key] = std::visit(ToText{}, entry.value);
  return texts;
}

void Settings::assign(const std::string& key, Value value, Location location, bool given) {
  entries_[key] = Entry{std::move(value), std::move(location), given};
}

}  // namespace hemoscale::coupling
