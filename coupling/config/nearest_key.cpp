#include "coupling/config/nearest_key.hpp"

#include <algorithm>
#include <set>

namespace hemoscale::coupling {

namespace {

/// Longer words are nobody's misspelling of a key; bounding them bounds the cost of hostile input.
constexpr std::size_t longest_compared = 100;  // [-] characters

bool ends_with_words(const std::string& key, const std::string& words) {
  return key.size() > words.size() &&
         key.compare(key.size() - words.size(), words.size(), words) == 0 &&
         key[key.size() - words.size() - 1] == '.';
}

std::string last_word(const std::string& key) {
  const std::size_t dot = key.rfind('.');
  return dot == std::string::npos ? key : key.substr(dot + 1);
}

/// Every key and every section, e.g. "micro.membrane".
std::vector<std::string> keys_and_sections(const std::vector<Parameter>& table) {
  std::vector<std::string> names;
  std::set<std::string> seen;
  for (const Parameter& parameter : table) {
    for (std::size_t dot = parameter.key.find('.'); dot != std::string::npos;
         dot = parameter.key.find('.', dot + 1)) {
      const std::string section = parameter.key.substr(0, dot);
      if (seen.insert(section).second) names.push_back(section);
    }
    names.push_back(parameter.key);
  }
  return names;
}

}  // namespace

std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before_last(b.size() + 1);
  std::vector<std::size_t> last(b.size() + 1);
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last.swap(last);
    last.swap(row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, replaced});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row[b.size()];
}

std::string nearest_word(const std::string& word, const std::vector<std::string>& words) {
  const std::string compared = word.substr(0, longest_compared);
  std::string nearest;
  std::size_t smallest = 0;
  for (const std::string& candidate : words) {
    const std::size_t distance = edit_distance(compared, candidate);
    if (nearest.empty() || distance < smallest) {
      nearest = candidate;
      smallest = distance;
    }
  }
  return nearest;
}

Suggestion suggest(const std::string& key, const std::vector<Parameter>& table) {
  Suggestion suggestion;
  suggestion.key = nearest_word(key, keys_and_sections(table));
  suggestion.is_section = std::none_of(table.begin(), table.end(), [&](const Parameter& parameter) {
    return parameter.key == suggestion.key;
  });
  suggestion.close = edit_distance(key.substr(0, longest_compared), suggestion.key) <=
                     1 + suggestion.key.size() / 6;

  // A suffix of several words ("channel.height") says more than the last word alone.
  const std::size_t first_dot = key.find('.');
  const std::string after_first = first_dot == std::string::npos ? key : key.substr(first_dot + 1);
  for (const std::string& words : {key, after_first, last_word(key)}) {
    for (const Parameter& parameter : table) {
      if (ends_with_words(parameter.key, words)) suggestion.elsewhere.push_back(parameter.key);
    }
    if (!suggestion.elsewhere.empty()) break;
  }
  return suggestion;
}

std::string suggestion_text(const Suggestion& suggestion) {
  const std::vector<std::string>& elsewhere = suggestion.elsewhere;
  const bool told_already =
      std::find(elsewhere.begin(), elsewhere.end(), suggestion.key) != elsewhere.end();
  const std::string nearest = std::string(suggestion.is_section ? "section" : "key") + " is ";
  if (elsewhere.empty() || (told_already && elsewhere.size() == 1)) {
    return "the nearest known " + nearest + suggestion.key;
  }
  std::string text = "a key of that name exists as ";
  const std::size_t shown = std::min<std::size_t>(elsewhere.size(), 3);
  for (std::size_t i = 0; i < shown; ++i) {
    if (i > 0) text += i + 1 == shown ? " and " : ", ";
    text += elsewhere[i];
  }
  if (elsewhere.size() > shown) text += " (and others)";
  return told_already ? text : text + "; the nearest in spelling is " + suggestion.key;
}

}  // namespace hemoscale::coupling
