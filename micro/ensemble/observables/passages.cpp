#include "micro/ensemble/observables/passages.hpp"

#include <fmt/core.h>

#include <cmath>
#include <utility>

#include "micro/error.hpp"

namespace hemoscale::micro {
namespace {

double cross(const Vector<2>& a, const Vector<2>& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// On the left of the section, or on it: a centroid that stops on the line has not passed.
bool is_left(const CountedSection& section, const Vector<2>& x) {
  return cross(section.to - section.from, x - section.from) >= 0;
}

/// +1 or -1 if the way from a to b crosses the section, else 0.
int crossing(const CountedSection& section, const Vector<2>& a, const Vector<2>& b) {
  const bool starts_left = is_left(section, a);
  if (starts_left == is_left(section, b)) return 0;
  const CountedSection way{.name = {}, .from = a, .to = b};
  if (is_left(way, section.from) == is_left(way, section.to)) return 0;
  return starts_left ? 1 : -1;
}

}  // namespace

PassageCounter::PassageCounter(std::vector<CountedSection> sections, double period)
    : sections_(std::move(sections)), period_(period), passages_(sections_.size()) {}

void PassageCounter::update(std::span<const std::int64_t> identities,
                            std::span<const CellShape> shapes) {
  std::map<std::int64_t, Vector<2>> places;
  for (std::size_t cell = 0; cell < shapes.size(); ++cell) {
    const Vector<2>& now = shapes[cell].centre;
    places.emplace(identities[cell], now);
    const auto found = places_.find(identities[cell]);
    if (found == places_.end()) continue;
    Vector<2> before = found->second;
    if (period_ > 0) {
      before.x() += period_ * std::nearbyint((now.x() - before.x()) / period_);
    }
    for (std::size_t s = 0; s < sections_.size(); ++s) {
      // The image of the section that is nearest to where the cell is.
      double shift = 0;
      if (period_ > 0) {
        const double middle = 0.5 * (sections_[s].from.x() + sections_[s].to.x());
        shift = period_ * std::nearbyint((now.x() - middle) / period_);
      }
      const Vector<2> by(shift, 0);
      const int sign = crossing(sections_[s], before - by, now - by);
      passages_[s].cells += sign;
      passages_[s].area += sign * shapes[cell].area;
    }
  }
  places_ = std::move(places);
}

void PassageCounter::store(Snapshot& snapshot) const {
  std::vector<double> areas;
  std::vector<std::int64_t> cells;
  for (const Passages& passed : passages_) {
    areas.push_back(passed.area);
    cells.push_back(passed.cells);
  }
  std::vector<double> places;
  std::vector<std::int64_t> identities;
  for (const auto& [identity, place] : places_) {
    identities.push_back(identity);
    places.push_back(place.x());
    places.push_back(place.y());
  }
  snapshot.reals["passages.areas"] = std::move(areas);
  snapshot.reals["passages.places"] = std::move(places);
  snapshot.integers["passages.cells"] = std::move(cells);
  snapshot.integers["passages.identities"] = std::move(identities);
}

void PassageCounter::load(const Snapshot& snapshot) {
  const auto areas = snapshot.reals.find("passages.areas");
  const auto cells = snapshot.integers.find("passages.cells");
  const auto places = snapshot.reals.find("passages.places");
  const auto identities = snapshot.integers.find("passages.identities");
  const bool complete = areas != snapshot.reals.end() && cells != snapshot.integers.end() &&
                        places != snapshot.reals.end() && identities != snapshot.integers.end();
  if (!complete || areas->second.size() != sections_.size() ||
      cells->second.size() != sections_.size() ||
      places->second.size() != 2 * identities->second.size()) {
    throw ParameterError(fmt::format(
        "snapshot: no passages through {} sections; restore it into a run with the same sections",
        sections_.size()));
  }
  for (std::size_t s = 0; s < sections_.size(); ++s) {
    passages_[s] = {.cells = cells->second[s], .area = areas->second[s]};
  }
  places_.clear();
  for (std::size_t k = 0; k < identities->second.size(); ++k) {
    places_[identities->second[k]] = {places->second[2 * k], places->second[2 * k + 1]};
  }
}

}  // namespace hemoscale::micro
