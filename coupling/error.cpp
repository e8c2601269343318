#include "coupling/error.hpp"

#include <utility>

namespace hemoscale::coupling {

namespace {

std::string one_line(const Fault& fault) {
  std::string text;
  if (!fault.file.empty()) {
    text += fault.file + ":";
    if (fault.line > 0) {
      text += std::to_string(fault.line) + ":";
      if (fault.column > 0) text += std::to_string(fault.column) + ":";
    }
    text += " ";
  }
  if (!fault.key.empty()) text += fault.key + ": ";
  return text + fault.message;
}

std::string one_line_each(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& fault : faults) {
    if (!text.empty()) text += "\n";
    text += one_line(fault);
  }
  return text;
}

}  // namespace

CaseError::CaseError(std::vector<Fault> faults)
    : std::runtime_error(one_line_each(faults)), faults_(std::move(faults)) {}

}  // namespace hemoscale::coupling
