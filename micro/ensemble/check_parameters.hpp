#pragma once

#include "micro/ensemble/parameters.hpp"

namespace hemoscale::micro {

/// @throws ParameterError naming all faults at once: value, range, remedy
void require_admissible(const EnsembleParameters& parameters);

}  // namespace hemoscale::micro
