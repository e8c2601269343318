#include "micro/ensemble/packing/interpenetration_watch.hpp"

#include <fmt/core.h>

#include "micro/ensemble/interpenetration.hpp"
#include "micro/error.hpp"

namespace hemoscale::micro {

InterpenetrationWatch::InterpenetrationWatch(std::int64_t interval) : interval_(interval) {
  if (interval < 1) {
    throw ParameterError(fmt::format(
        "watch of interpenetration: every {} steps; at least 1 is needed; choose such as 1000",
        interval));
  }
}

std::size_t InterpenetrationWatch::look(std::int64_t step, std::span<const EnsembleState> kinds,
                                        const CellRoom& room) {
  const std::size_t count = count_interpenetrating_nodes(kinds, room);
  ++looks_;
  if (count > largest_) {
    largest_ = count;
    step_of_largest_ = step;
  }
  return count;
}

}  // namespace hemoscale::micro
