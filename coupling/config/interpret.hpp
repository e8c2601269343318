#pragma once

#include <string>
#include <vector>

#include "coupling/config/parameter_table.hpp"
#include "coupling/config/read_case.hpp"

namespace hemoscale::coupling {

/// interpret() with another table than that of the project; its keys must exist in the project's
/// table as well if the values are to be asked for. For tests of the rules themselves.
Settings interpret(const ParameterTree& tree, const std::string& variant,
                   const std::vector<Parameter>& table,
                   const std::vector<Override>& overrides = {});

/// Names of the variants that a case holds, in file order.
std::vector<std::string> variant_names(const ParameterTree& tree);

}  // namespace hemoscale::coupling
