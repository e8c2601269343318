#pragma once

#include <string>

namespace hemoscale::coupling {

/// The parameter table for a terminal of 80 columns: one key with all that is known of it, or the
/// keys of a section ("micro.membrane"), or with an empty argument all keys.
/// @throws CaseError for a key that is not known, naming the nearest
std::string reference_text(const std::string& key_or_section);

/// The same as Markdown, one table per section; without an argument it is
/// docs/reference/case-keys.md.
/// @throws CaseError for a key that is not known, naming the nearest
std::string reference_markdown(const std::string& key_or_section);

}  // namespace hemoscale::coupling
