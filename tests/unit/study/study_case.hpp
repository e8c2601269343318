#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "coupling/error.hpp"
#include "coupling/study/read_study.hpp"

namespace hemoscale::coupling {

/// A folder with a small valid case and a study of it, that goes when this object does.
class StudyCase {
 public:
  explicit StudyCase(const std::string& study) {
    std::string folder = testing::TempDir() + "hemoscale-study-XXXXXX";
    if (mkdtemp(folder.data()) == nullptr) throw std::runtime_error("no temporary folder");
    folder_ = folder;
    write("case.toml",
          "case.name = \"small\"\n"
          "scene.kind = \"micro\"\n"
          "fluid.hematocrit = 0.2\n"
          "[micro]\n"
          "cells = 4\n"
          "nodes = 24\n"
          "shear_rate = \"100 1/s\"\n"
          "duration = \"2 ms\"\n"
          "output_interval = \"1 ms\"\n"
          "contact = { stiffness = \"4 Pa\", rest_distance = \"0.7 um\", cutoff = \"1 um\" }\n"
          "[variant.stiff]\n"
          "micro.membrane.stretch_modulus = \"2e-5 N/m\"\n");
    write("study.toml", study);
  }
  ~StudyCase() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  StudyCase(const StudyCase&) = delete;
  StudyCase& operator=(const StudyCase&) = delete;

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  const std::filesystem::path& folder() const { return folder_; }
  Study read() const { return read_study(folder_); }

 private:
  std::filesystem::path folder_;
};

/// "line key" of every fault that an action finds, in the order told.
template <class Action>
std::vector<std::string> fault_places(const Action& action) {
  std::vector<std::string> places;
  try {
    action();
  } catch (const CaseError& error) {
    for (const Fault& fault : error.faults()) {
      EXPECT_FALSE(fault.message.empty());
      places.push_back(std::to_string(fault.line) + " " + fault.key);
    }
  }
  return places;
}

/// The text of the CaseError that an action throws.
template <class Action>
std::string complaint(const Action& action) {
  try {
    action();
  } catch (const CaseError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

}  // namespace hemoscale::coupling
