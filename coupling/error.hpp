#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace hemoscale::coupling {

/// One fault of a case: where it is and what to do about it.
struct Fault {
  std::string file;     // as the user named it; empty if the fault has no file
  int line = 0;         // 1-based; 0 if unknown
  int column = 0;       // 1-based; 0 if unknown
  std::string key;      // full dotted key, e.g. "micro.membrane.stretch_modulus"
  std::string message;  // what is wrong, the value, what is allowed, what to do
};

/// The user's case is wrong. Holds all faults that were found, not the first alone; what() prints
/// one line per fault: "file:line:column: key: message".
class CaseError : public std::runtime_error {
 public:
  explicit CaseError(std::vector<Fault> faults);
  const std::vector<Fault>& faults() const { return faults_; }

 private:
  std::vector<Fault> faults_;
};

/// A file, library, MPI or OpenFOAM failed; with path or rank and the system's reason.
struct EnvironmentError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The coupled iteration failed: diverged, not finite.
struct NumericalError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

}  // namespace hemoscale::coupling
