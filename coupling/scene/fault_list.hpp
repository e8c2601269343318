#pragma once

#include <string>
#include <vector>

#include "coupling/config/settings.hpp"
#include "coupling/error.hpp"
#include "macro/error.hpp"
#include "micro/error.hpp"

namespace hemoscale::coupling {

/// Faults of a case as they are found, each at the place of its key.
class FaultList {
 public:
  explicit FaultList(const Settings& settings) : settings_(settings) {}

  void add(const std::string& key, const std::string& message) {
    const Location place = settings_.location(key);
    faults.push_back({place.file, place.line, place.column, key, message});
  }

  /// Runs a builder; what it complains of becomes a fault of that key.
  template <class Builder>
  void attempt(const std::string& key, const Builder& build) {
    try {
      build();
    } catch (const CaseError& error) {
      faults.insert(faults.end(), error.faults().begin(), error.faults().end());
    } catch (const micro::ParameterError& error) {
      add(key, error.what());
    } catch (const macro::ParameterError& error) {
      add(key, error.what());
    }
  }

  std::vector<Fault> faults;

 private:
  const Settings& settings_;
};

}  // namespace hemoscale::coupling
