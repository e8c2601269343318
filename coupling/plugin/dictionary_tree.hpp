#pragma once

#include <set>
#include <string>

#include "coupling/config/parameter_tree.hpp"
#include "dictionary.H"

namespace hemoscale::coupling {

/// The entries of an OpenFOAM dictionary as a tree, with file and line of every value, so that the
/// keys of a case mean the same in case.toml and in a dictionary. Sub-dictionaries become tables,
/// round brackets lists, numbers numbers; anything else becomes text, several words joined by
/// spaces, so that `height 10 um;` and `height "10 um";` are the same. OpenFOAM has expanded
/// $variables and #include by then.
///
/// @param left_out  keys of the outermost level that are not part of the case
ParameterTree read_dictionary(const Foam::dictionary& dictionary,
                              const std::set<std::string>& left_out);

}  // namespace hemoscale::coupling
