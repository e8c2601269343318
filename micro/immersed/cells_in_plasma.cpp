#include "micro/immersed/cells_in_plasma.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "micro/error.hpp"

namespace hemoscale::micro {

CellsInPlasma::CellsInPlasma(Coupling coupling, double time_step)
    : coupling_(std::move(coupling)), time_step_(time_step) {
  if (!(time_step > 0)) {
    throw ParameterError(fmt::format("the time step is {:g} s; it must be positive", time_step));
  }
}

void CellsInPlasma::advance_by(double duration) {
  if (auto* implicit = std::get_if<0>(&coupling_)) {
    (*implicit)->advance_by(duration);
    return;
  }
  if (!(duration > 0)) {
    throw ParameterError(fmt::format("the duration is {:g} s; it must be positive", duration));
  }
  // Rounding must not add a step to a stretch that holds a whole number of them.
  const auto count = std::max(1L, std::lround(std::ceil(duration / time_step_ - 1e-9)));
  const double step = duration / static_cast<double>(count);
  for (long k = 0; k < count; ++k) {
    if (auto* immersed = std::get_if<1>(&coupling_)) {
      (*immersed)->step(step);
    } else {
      std::get<2>(coupling_)->step(step);
    }
  }
}

const std::vector<Cell>& CellsInPlasma::cells() const {
  return std::visit([](const auto& c) -> const std::vector<Cell>& { return c->cells(); },
                    coupling_);
}

double CellsInPlasma::time() const {
  return std::visit([](const auto& c) { return c->time(); }, coupling_);
}

std::int64_t CellsInPlasma::steps() const {
  if (const auto* one = implicit()) return one->counters().steps;
  if (const auto* immersed = std::get_if<1>(&coupling_)) return (*immersed)->steps();
  return std::get<2>(coupling_)->steps();
}

std::vector<double> CellsInPlasma::tensions(std::size_t cell) const {
  if (const auto* one = implicit()) return one->tensions(cell);
  const Cell& c = cells()[cell];
  return c.membrane->tensions(c.positions);
}

std::vector<Limit> CellsInPlasma::limits() const {
  if (const auto* immersed = std::get_if<1>(&coupling_)) return (*immersed)->limits(time_step_);
  if (const auto* direct = std::get_if<2>(&coupling_)) return (*direct)->limits(time_step_);
  return {};
}

const ImplicitMembranes* CellsInPlasma::implicit() const {
  const auto* one = std::get_if<0>(&coupling_);
  return one == nullptr ? nullptr : one->get();
}

const ParticleSet<2>* CellsInPlasma::particles() const {
  if (const auto* immersed = std::get_if<1>(&coupling_)) return &(*immersed)->particles();
  if (const auto* direct = std::get_if<2>(&coupling_)) return &(*direct)->particles();
  return nullptr;
}

Snapshot CellsInPlasma::snapshot() const {
  return std::visit([](const auto& c) { return c->snapshot(); }, coupling_);
}

void CellsInPlasma::restore(const Snapshot& snapshot) {
  std::visit([&](const auto& c) { c->restore(snapshot); }, coupling_);
}

}  // namespace hemoscale::micro
