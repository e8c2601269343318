#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "coupling/config/parameter_table.hpp"

namespace hemoscale::coupling {

/// Fewest insertions, deletions, replacements and swaps of neighbours that turn one word into the
/// other, no letter being touched twice (optimal string alignment) [-].
std::size_t edit_distance(const std::string& a, const std::string& b);

/// The word with the smallest distance; the first of several. Empty if there are no words.
std::string nearest_word(const std::string& word, const std::vector<std::string>& words);

/// The key or section that someone who wrote an unknown `key` most likely meant.
struct Suggestion {
  std::string key;  // nearest in spelling
  bool is_section = false;
  bool close = false;                  // so near that it is most likely meant
  std::vector<std::string> elsewhere;  // keys of other sections that end in the same words
};
Suggestion suggest(const std::string& key, const std::vector<Parameter>& table);

/// The suggestion as a clause, e.g. 'the nearest known key is micro.cells'.
std::string suggestion_text(const Suggestion& suggestion);

}  // namespace hemoscale::coupling
