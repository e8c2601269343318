#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "micro/ensemble/flow/given_flow.hpp"

namespace hemoscale::micro {

/// A flow in time: linear between given flows at given times. The error of a part of angular
/// frequency w is (w dt)^2 / 8 of its amplitude for times dt apart.
class TableFlow final : public GivenFlow {
 public:
  /// @param times   [s] increasing, one for each flow
  /// @param flows   steady flows; at least two
  /// @param period  [s] longer than from the first time to the last: the flow then repeats, and
  /// goes
  ///                from the last one over to the first; empty: it exists between the first and the
  ///                last time alone
  /// @throws ParameterError for tables that are not so
  TableFlow(std::vector<double> times, std::vector<std::shared_ptr<const GivenFlow>> flows,
            std::optional<double> period = std::nullopt);

  /// @throws ParameterError for a time outside the table, unless it repeats
  LocalFlow at(const Vector<2>& x, double time) const override;

  bool is_steady() const override { return false; }
  double largest_shear_rate() const override { return largest_shear_rate_; }
  double largest_speed() const override { return largest_speed_; }

 private:
  std::vector<double> times_;  // [s]
  std::vector<std::shared_ptr<const GivenFlow>> flows_;
  std::optional<double> period_;   // [s]
  double largest_shear_rate_ = 0;  // [1/s]
  double largest_speed_ = 0;       // [m/s]
};

}  // namespace hemoscale::micro
