#pragma once

#include <string>

namespace hemoscale::macro {

/// A number that a user gave, with what an error message needs to name it.
struct CheckedParameter {
  std::string owner;  // the law or the flow, e.g. "Casson law"
  std::string name;   // as in the parameter struct, e.g. "yield_stress"
  double value = 0;   // in `unit`
  std::string unit;   // SI, "-" for none
};

/// @throws ParameterError "<owner>: <name> = <value> <unit> is not admissible; allowed: <allowed>;
///         <remedy>", always
[[noreturn]] void refuse(const CheckedParameter& parameter, const std::string& allowed,
                         const std::string& remedy);

/// refuse() unless `admissible`. Builds its texts on every call: not for inner loops.
void require(bool admissible, const CheckedParameter& parameter, const std::string& allowed,
             const std::string& remedy);

/// require() finite and > 0.
void require_positive(const CheckedParameter& parameter, const std::string& remedy);

/// require() finite and >= 0.
void require_not_negative(const CheckedParameter& parameter, const std::string& remedy);

/// require() neither infinite nor NaN.
void require_finite(const CheckedParameter& parameter, const std::string& remedy);

/// Shortest text of a number that an error message needs: 6 significant digits.
std::string as_text(double value);

}  // namespace hemoscale::macro
