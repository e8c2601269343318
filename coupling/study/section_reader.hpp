#pragma once

#include <optional>
#include <string>
#include <vector>

#include "coupling/config/read_case.hpp"
#include "coupling/config/read_value.hpp"

namespace hemoscale::coupling {

/// One section of a study file: its keys, each of a given type. What does not fit becomes a fault;
/// reading goes on.
class SectionReader {
 public:
  /// Reports keys that are not in `known`, with the nearest one.
  /// @param node  null if the section is not there: nothing is reported then
  SectionReader(const ParameterTree* node, std::string name, const std::vector<std::string>& known,
                ValueReader& reader, std::vector<Fault>& faults);

  bool exists() const { return node_ != nullptr; }
  const ParameterTree* find(const std::string& key) const;
  Location place() const { return node_ != nullptr ? node_->location : Location{}; }
  /// Where a key stands; the section if it is not there.
  Location place(const std::string& key) const;

  std::optional<std::string> text(const std::string& key);
  /// Letters, digits, '-' and '_': becomes part of file names.
  std::optional<std::string> word(const std::string& key);
  std::optional<bool> flag(const std::string& key);
  std::optional<int> count(const std::string& key, int highest);
  std::optional<double> duration(const std::string& key);  // [s] above 0
  std::optional<double> number(const std::string& key, const Range& range);
  /// A list with at least one element.
  std::vector<ParameterTree> list(const std::string& key);
  /// { "micro.cells" = 40, micro.nodes = 24 }, as one flat list.
  std::vector<Override> overrides(const std::string& key);

  /// The key must be there.
  void require(const std::string& key, const std::string& example);
  void refuse(const std::string& key, const std::string& message);

 private:
  template <class Value>
  std::optional<Value> read(const std::string& key, Parameter parameter);
  std::string full(const std::string& key) const;

  const ParameterTree* node_;
  std::string name_;
  ValueReader& reader_;
  std::vector<Fault>& faults_;
};

/// The values of a table and of the tables in it, by dotted key, in file order.
std::vector<Override> flattened(const ParameterTree& table);

}  // namespace hemoscale::coupling
