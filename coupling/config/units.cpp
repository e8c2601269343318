#include "coupling/config/units.hpp"

#include <udunits2.h>

#include <cmath>
#include <string_view>

#include "coupling/error.hpp"

namespace hemoscale::coupling {

namespace {

struct FreeUnit {
  void operator()(ut_unit* unit) const { ut_free(unit); }
};
struct FreeConverter {
  void operator()(cv_converter* converter) const { cv_free(converter); }
};
using Unit = std::unique_ptr<ut_unit, FreeUnit>;
using Converter = std::unique_ptr<cv_converter, FreeConverter>;

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Letters beyond ASCII that units are written with; UDUNITS-2 passes over some others in silence.
bool begins_with_known_letter(std::string_view text) {
  for (const std::string_view letter : {"\u00b5", "\u03bc", "\u00b7", "\u00c5"}) {  // µ μ · Å
    if (text.substr(0, letter.size()) == letter) return true;
  }
  return false;
}

/// UDUNITS-2 reads more than a unit: factors ("2 um"), origins ("m @ 3", "s since 1970"),
/// logarithms ("lg(re mW)"); and it stops without complaint at a stray ")". Digits may therefore
/// stand only in an exponent (s-1, m^2, cm3) or in a leading "1/", and brackets must pair.
/// @returns why it is not a plain unit, or an empty string
std::string fault_of_form(const std::string& unit) {
  int open_brackets = 0;
  for (std::size_t i = 0; i < unit.size(); ++i) {
    const char c = unit[i];
    if (c == '(') ++open_brackets;
    if (c == ')' && --open_brackets < 0) break;
    const auto byte = static_cast<unsigned char>(c);
    const bool starts_letter = byte >= 0xc0;
    if (byte < 0x20 || byte == 0x7f) return "holds a control character";
    if (starts_letter && !begins_with_known_letter(std::string_view(unit).substr(i))) {
      return "is not known";
    }
    const bool continues_letter = byte >= 0x80 && !starts_letter;
    if (continues_letter && (i == 0 || static_cast<unsigned char>(unit[i - 1]) < 0xc0)) {
      return "is not known";
    }
    if (c == '@') return "has an origin of its own (@)";
    if (!is_digit(c)) continue;
    const std::size_t after = unit.find_first_not_of(' ', i + 1);
    const bool reciprocal = i == 0 && c == '1' && after != std::string::npos && unit[after] == '/';
    const bool after_power = i > 1 && unit[i - 1] == '*' && unit[i - 2] == '*';
    const bool exponent =
        after_power || (i > 0 && std::string_view(" ./*()").find(unit[i - 1]) == std::string::npos);
    if (!reciprocal && !exponent) return "holds a second number";
  }
  return open_brackets == 0 ? "" : "has an unpaired bracket";
}

/// value * factor, where UDUNITS-2 has made the factor by chains of roundings: one that is a whole
/// number or the inverse of one up to rounding is taken for exactly that, so that "80 um" is the
/// double nearest to 8e-5.
double scaled(double value, double factor) {
  constexpr double rounding = 4e-15;  // [-] relative, some 20 units in the last place
  const bool is_inverse = std::abs(factor) < 1;
  const double whole = std::round(is_inverse ? 1 / factor : factor);
  const double meant = is_inverse ? 1 / whole : whole;
  if (std::abs(meant - factor) > rounding * std::abs(factor)) return value * factor;
  return is_inverse ? value / whole : value * whole;
}

}  // namespace

struct UnitSystem::State {
  ut_system* system = nullptr;
  ut_error_message_handler previous_handler = nullptr;

  void add_symbol(const char* symbol, const char* meaning) {
    const Unit unit(ut_parse(system, meaning, UT_UTF8));
    if (unit) ut_map_symbol_to_unit(symbol, UT_ASCII, unit.get());
  }
};

UnitSystem::UnitSystem() : state_(std::make_unique<State>()) {
  state_->previous_handler = ut_set_error_message_handler(ut_ignore);
  state_->system = ut_read_xml(nullptr);
  if (state_->system == nullptr) {
    ut_status status = UT_SUCCESS;
    const char* path = ut_get_path_xml(nullptr, &status);
    const std::string where = path == nullptr ? "its default place" : path;
    ut_set_error_message_handler(state_->previous_handler);
    throw EnvironmentError(
        "cannot read the database of units " + where +
        "; install it (Debian package libudunits2-data), or let UDUNITS2_XML_PATH "
        "name udunits2.xml");
  }
  state_->add_symbol("P", "poise");
  state_->add_symbol("dyn", "dyne");
}

UnitSystem::~UnitSystem() {
  ut_free_system(state_->system);
  ut_set_error_message_handler(state_->previous_handler);
}

double UnitSystem::convert(double value, const std::string& unit,
                           const std::string& si_unit) const {
  const std::string fault = fault_of_form(unit);
  if (!fault.empty()) throw UnitError{fault};

  const Unit from(ut_parse(state_->system, unit.c_str(), UT_UTF8));
  if (!from) throw UnitError{"is not known"};
  const Unit to(ut_parse(state_->system, si_unit.c_str(), UT_UTF8));
  if (!to) throw UnitError{"cannot be compared with " + si_unit};

  const Converter converter(ut_are_convertible(from.get(), to.get()) != 0
                                ? ut_get_converter(from.get(), to.get())
                                : nullptr);
  const std::string not_convertible =
      si_unit == "1" ? "is not dimensionless" : "cannot be converted to " + si_unit;
  if (!converter) throw UnitError{not_convertible};

  // Proportional: f(0) = 0 and f(2) = 2 f(1). A reciprocal (s for 1/s) is "convertible" to
  // UDUNITS-2, with f(0) infinite.
  const double at_zero = cv_convert_double(converter.get(), 0);
  const double at_one = cv_convert_double(converter.get(), 1);
  const double at_two = cv_convert_double(converter.get(), 2);
  if (!std::isfinite(at_zero)) throw UnitError{not_convertible};
  if (at_zero != 0 || std::abs(at_two - 2 * at_one) > 1e-12 * std::abs(at_two)) {
    throw UnitError{"has an origin of its own or is a logarithm"};
  }
  return scaled(value, at_one);
}

}  // namespace hemoscale::coupling
