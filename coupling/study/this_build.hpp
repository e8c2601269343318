#pragma once

#include <string>

namespace hemoscale::coupling {

/// Sixteen digits that stand for the code of this process: the program and those of its libraries
/// that are part of HemoScale, byte by byte. A program that was built again from other sources, or
/// otherwise, has other digits, though its version may be the same.
/// @throws EnvironmentError if a file cannot be read
const std::string& this_build();

}  // namespace hemoscale::coupling
