#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "micro/ensemble/observables/cell_shape.hpp"
#include "micro/model.hpp"
#include "micro/vector.hpp"

namespace hemoscale::micro {

/// A line across a channel or an opening. Positive is from its left to its right, seen on the way
/// from `from` to `to`: drawn upwards, along +x.
struct CountedSection {
  std::string name;
  Vector<2> from = Vector<2>::Zero();  // [m]
  Vector<2> to = Vector<2>::Zero();    // [m]
};

/// What has passed a section since counting began, backward passages subtracted.
struct Passages {
  std::int64_t cells = 0;  // [-]
  double area = 0;         // [m^2] of these cells, each with its area when it passed
};

/// Counts the cells whose centroid passes sections, from sample to sample: the discharge into the
/// daughters of a bifurcation. Cells are known by identities, so that they may appear and vanish.
class PassageCounter {
 public:
  /// @param period  [m] of the domain along x; 0 if it is not periodic
  PassageCounter(std::vector<CountedSection> sections, double period);

  /// Between two samples a cell must move by less than half the period.
  /// @param identities  of the cells, as long as `shapes`
  void update(std::span<const std::int64_t> identities, std::span<const CellShape> shapes);

  /// Everything that continues the counting with the same numbers.
  void store(Snapshot& snapshot) const;
  /// @throws ParameterError if the snapshot is not of these sections
  void load(const Snapshot& snapshot);

  const std::vector<CountedSection>& sections() const { return sections_; }
  const std::vector<Passages>& passages() const { return passages_; }

 private:
  std::vector<CountedSection> sections_;
  double period_ = 0;
  std::map<std::int64_t, Vector<2>> places_;  // [m] of the last sample
  std::vector<Passages> passages_;
};

}  // namespace hemoscale::micro
