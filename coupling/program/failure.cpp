#include "coupling/program/failure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <sstream>
#include <vector>

#include "coupling/error.hpp"
#include "macro/error.hpp"
#include "micro/error.hpp"

namespace hemoscale::coupling {

namespace {

/// Every line of `text`, indented.
std::string indented(const std::string& text) {
  std::istringstream lines(text);
  std::string result;
  for (std::string line; std::getline(lines, line);) result += "  " + line + "\n";
  return result;
}

Outcome make(int exit_code, const std::string& title, const std::string& text) {
  return {exit_code, "hemoscale: " + title + "\n" + indented(text)};
}

Outcome of_case(const CaseError& error) {
  const std::vector<Fault>& faults = error.faults();
  const bool of_file = std::any_of(faults.begin(), faults.end(),
                                   [](const Fault& fault) { return !fault.file.empty(); });
  Outcome outcome =
      make(exit_case, of_file ? "the case is not valid" : "the request is not valid", error.what());
  outcome.message += fmt::format("{} {}\n", faults.size(), faults.size() == 1 ? "fault" : "faults");
  return outcome;
}

}  // namespace

Outcome outcome_of(const std::exception_ptr& exception) {
  const std::string parameter = "a parameter is not admissible";
  const std::string environment = "a file, a library or a program failed";
  const std::string numerics = "the numerics failed";
  try {
    std::rethrow_exception(exception);
  } catch (const CaseError& error) {
    return of_case(error);
  } catch (const micro::ParameterError& error) {
    return make(exit_case, parameter, error.what());
  } catch (const macro::ParameterError& error) {
    return make(exit_case, parameter, error.what());
  } catch (const EnvironmentError& error) {
    return make(exit_environment, environment, error.what());
  } catch (const micro::EnvironmentError& error) {
    return make(exit_environment, environment, error.what());
  } catch (const macro::EnvironmentError& error) {
    return make(exit_environment, environment, error.what());
  } catch (const NumericalError& error) {
    return make(exit_numerics, numerics, error.what());
  } catch (const micro::NumericalError& error) {
    return make(exit_numerics, numerics, error.what());
  } catch (const macro::NumericalError& error) {
    return make(exit_numerics, numerics, error.what());
  } catch (const std::bad_alloc&) {
    return make(exit_defect, "out of memory",
                "the case needs more memory than there is; reduce cells, nodes or points");
  } catch (const std::exception& error) {
    return make(exit_defect, "a defect of this program",
                std::string(error.what()) + "\nplease report it together with the case");
  } catch (...) {
    return make(exit_defect, "a defect of this program",
                "an exception of unknown type; please report it together with the case");
  }
}

}  // namespace hemoscale::coupling
