#include "macro/parameter_check.hpp"

#include <cmath>
#include <locale>
#include <sstream>

#include "macro/error.hpp"

namespace hemoscale::macro {

std::string as_text(double value) {
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(6);
  text << value;
  return text.str();
}

void refuse(const CheckedParameter& parameter, const std::string& allowed,
            const std::string& remedy) {
  const std::string unit = parameter.unit == "-" ? "" : " " + parameter.unit;
  throw ParameterError(parameter.owner + ": " + parameter.name + " = " + as_text(parameter.value) +
                       unit + " is not admissible; allowed: " + allowed + "; " + remedy);
}

void require(bool admissible, const CheckedParameter& parameter, const std::string& allowed,
             const std::string& remedy) {
  if (!admissible) refuse(parameter, allowed, remedy);
}

void require_positive(const CheckedParameter& parameter, const std::string& remedy) {
  require(std::isfinite(parameter.value) && parameter.value > 0, parameter, "finite and positive",
          remedy);
}

void require_not_negative(const CheckedParameter& parameter, const std::string& remedy) {
  require(std::isfinite(parameter.value) && parameter.value >= 0, parameter,
          "finite and not negative", remedy);
}

void require_finite(const CheckedParameter& parameter, const std::string& remedy) {
  require(std::isfinite(parameter.value), parameter, "a finite number", remedy);
}

}  // namespace hemoscale::macro
