#include "coupling/config/parameter_tree.hpp"

namespace hemoscale::coupling {

const ParameterTree* ParameterTree::find(const std::string& name) const {
  for (const auto& [child_name, child] : children) {
    if (child_name == name) return &child;
  }
  return nullptr;
}

ParameterTree* ParameterTree::find(const std::string& name) {
  for (auto& [child_name, child] : children) {
    if (child_name == name) return &child;
  }
  return nullptr;
}

}  // namespace hemoscale::coupling
