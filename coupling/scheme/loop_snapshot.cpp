// CoupledLoop::snapshot and restore: the state of the loop as named arrays.
//
//   loop.counters              integers: format, passes, whether the law is the initial one,
//   whether
//                              there is a history, whether its law is the initial one, samples,
//                              whether there is a candidate, whether the window has converged
//   loop.law.* loop.history.*  rows of the tables
//   loop.samples.*             one array for each field
//   loop.changes               of the passes in this window
//   model.<slot>.*             the state of the micro model of a slot

#include <fmt/format.h>

#include <charconv>
#include <map>
#include <string>

#include "coupling/error.hpp"
#include "coupling/scheme/coupled_loop.hpp"
#include "micro/error.hpp"

namespace hemoscale::coupling {

namespace {

constexpr std::int64_t format = 1;  // counts up when the arrays change their meaning

const std::string model_prefix = "model.";

using Rows = std::vector<macro::ViscosityRow>;

const std::vector<double>& reals(const micro::Snapshot& snapshot, const std::string& name) {
  const auto found = snapshot.reals.find(name);
  if (found == snapshot.reals.end()) {
    throw EnvironmentError(fmt::format(
        "checkpoint: array '{}' of the coupled loop is missing; it was written by another kind of "
        "run: start without --restart, or with the checkpoint of this case",
        name));
  }
  return found->second;
}

void store_rows(micro::Snapshot& snapshot, const std::string& name, const Rows& rows) {
  for (const macro::ViscosityRow& row : rows) {
    snapshot.reals[name + ".hematocrits"].push_back(row.hematocrit);
    snapshot.integers[name + ".knots"].push_back(static_cast<std::int64_t>(row.shear_rates.size()));
    auto& rates = snapshot.reals[name + ".shear_rates"];
    auto& viscosities = snapshot.reals[name + ".viscosities"];
    rates.insert(rates.end(), row.shear_rates.begin(), row.shear_rates.end());
    viscosities.insert(viscosities.end(), row.viscosities.begin(), row.viscosities.end());
  }
}

const std::vector<std::int64_t>& integers(const micro::Snapshot& snapshot, const std::string& name,
                                          std::size_t size) {
  const auto found = snapshot.integers.find(name);
  if (found == snapshot.integers.end() || found->second.size() != size) {
    throw EnvironmentError(fmt::format(
        "checkpoint: array '{}' of the coupled loop is missing or has another length than {}; it "
        "was written by another kind of run: start without --restart, or with the checkpoint of "
        "this case",
        name, size));
  }
  return found->second;
}

macro::ViscosityLaw stored_law(const micro::Snapshot& snapshot, const std::string& name) {
  const std::vector<double>& hematocrits = reals(snapshot, name + ".hematocrits");
  const auto& knots = integers(snapshot, name + ".knots", hematocrits.size());
  const std::vector<double>& rates = reals(snapshot, name + ".shear_rates");
  const std::vector<double>& viscosities = reals(snapshot, name + ".viscosities");
  Rows rows;
  std::ptrdiff_t begin = 0;
  for (std::size_t r = 0; r < hematocrits.size(); ++r) {
    const std::ptrdiff_t end = begin + static_cast<std::ptrdiff_t>(knots[r]);
    if (knots[r] < 1 || end > std::ssize(rates) || end > std::ssize(viscosities)) {
      throw EnvironmentError(fmt::format(
          "checkpoint: arrays '{}.*' do not fit each other; the file is damaged: use the one "
          "before it",
          name));
    }
    rows.push_back({hematocrits[r],
                    {rates.begin() + begin, rates.begin() + end},
                    {viscosities.begin() + begin, viscosities.begin() + end}});
    begin = end;
  }
  return macro::ViscosityLaw(macro::ViscosityTable(std::move(rows)));
}

// Every field of a sample with its name, for writing and reading alike.
template <class Sample, class Use>
void for_each_field(Sample& s, const Use& use) {
  use("shear_rate", s.shear_rate);
  use("hematocrit", s.hematocrit);
  use("shear_stress", s.shear_stress);
  use("viscosity", s.viscosity);
  use("viscosity_error", s.viscosity_error);
  use("first_normal_difference", s.first_normal_difference);
  use("first_normal_error", s.first_normal_error);
  use("effective_samples", s.effective_samples);
  use("averaging_time", s.averaging_time);
}

void store_samples(micro::Snapshot& snapshot, const std::vector<RheologySample>& samples) {
  for (const RheologySample& sample : samples) {
    for_each_field(sample, [&](const char* name, double value) {
      snapshot.reals[std::string("loop.samples.") + name].push_back(value);
    });
    snapshot.integers["loop.samples.precision_reached"].push_back(sample.precision_reached);
    snapshot.integers["loop.samples.dimension"].push_back(sample.dimension);
  }
}

std::vector<RheologySample> stored_samples(const micro::Snapshot& snapshot, std::size_t count) {
  std::vector<RheologySample> samples(count);
  if (count == 0) return samples;
  const auto& precise = integers(snapshot, "loop.samples.precision_reached", count);
  const auto& dimension = integers(snapshot, "loop.samples.dimension", count);
  for (std::size_t i = 0; i < count; ++i) {
    for_each_field(samples[i], [&](const char* name, double& value) {
      const auto& values = reals(snapshot, std::string("loop.samples.") + name);
      if (values.size() != count) {
        throw EnvironmentError(fmt::format(
            "checkpoint: array 'loop.samples.{}' has {} values, not {}; the file is damaged: use "
            "the one before it",
            name, values.size(), count));
      }
      value = values[i];
    });
    samples[i].precision_reached = precise[i] != 0;
    samples[i].dimension = static_cast<int>(dimension[i]);
  }
  return samples;
}

// "model.<slot>.<name>" to slot and name.
template <class Arrays, class Place>
void collect_models(const Arrays& arrays, const Place& place) {
  for (const auto& [name, values] : arrays) {
    if (name.rfind(model_prefix, 0) != 0) continue;
    int slot = -1;
    const char* const begin = name.data() + model_prefix.size();
    const char* const end = name.data() + name.size();
    const auto [rest, error] = std::from_chars(begin, end, slot);
    if (error != std::errc() || rest == end || *rest != '.' || slot < 0) {
      throw EnvironmentError(
          fmt::format("checkpoint: array '{}' names no micro model; the file is damaged: use the "
                      "one before it",
                      name));
    }
    place(slot, std::string(rest + 1, end), values);
  }
}

}  // namespace

micro::Snapshot CoupledLoop::snapshot() const {
  micro::Snapshot result;
  result.integers["loop.counters"] = {format,
                                      state_.passes,
                                      !state_.law_is_table,
                                      state_.history.has_value(),
                                      state_.history.has_value() && !state_.history->law_is_table,
                                      static_cast<std::int64_t>(state_.samples.size()),
                                      state_.candidate.has_value(),
                                      state_.has_converged};
  const auto rows_of = [](const macro::ViscosityLaw& law) -> const Rows& {
    return std::get<macro::ViscosityTable>(law.model()).rows();
  };
  if (state_.law_is_table) store_rows(result, "loop.law", rows_of(state_.law));
  if (state_.history) {
    if (state_.history->law_is_table) {
      store_rows(result, "loop.history.law", rows_of(state_.history->law));
    }
    store_rows(result, "loop.history.candidate", rows_of(state_.history->candidate));
    result.reals["loop.history.factor"] = {state_.history->factor};
  }
  store_samples(result, state_.samples);
  result.reals["loop.changes"] = state_.changes;
  for (const auto& [slot, state] : micro_runs_.states()) {
    const std::string prefix = fmt::format("{}{}.", model_prefix, slot);
    for (const auto& [name, values] : state.reals) result.reals[prefix + name] = values;
    for (const auto& [name, values] : state.integers) result.integers[prefix + name] = values;
  }
  return result;
}

void CoupledLoop::restore(const micro::Snapshot& snapshot) {
  const auto& counters = integers(snapshot, "loop.counters", 8);
  if (counters[0] != format) {
    throw EnvironmentError(fmt::format(
        "checkpoint: format {} of the coupled loop; this program reads format {}: use the version "
        "that wrote it",
        counters[0], format));
  }
  State next{initial_law_, false, {}, std::nullopt, {}, std::nullopt, 0, false};
  next.passes = static_cast<int>(counters[1]);
  if (counters[2] == 0) {
    next.law = stored_law(snapshot, "loop.law");
    next.law_is_table = true;
  }
  if (counters[3] != 0) {
    History history{initial_law_, false, stored_law(snapshot, "loop.history.candidate"), 1};
    if (counters[4] == 0) {
      history.law = stored_law(snapshot, "loop.history.law");
      history.law_is_table = true;
    }
    const auto& factor = reals(snapshot, "loop.history.factor");
    if (factor.size() != 1) {
      throw EnvironmentError(
          "checkpoint: array 'loop.history.factor' does not hold one value; the file is damaged: "
          "use the one before it");
    }
    history.factor = factor[0];
    next.history = std::move(history);
  }
  next.samples = stored_samples(snapshot, static_cast<std::size_t>(counters[5]));
  if (counters[6] != 0) next.candidate.emplace(table_of(next.samples));
  next.has_converged = counters[7] != 0;
  next.changes = reals(snapshot, "loop.changes");

  std::map<int, micro::Snapshot> models;
  collect_models(snapshot.reals, [&](int slot, std::string name, const auto& values) {
    models[slot].reals[std::move(name)] = values;
  });
  collect_models(snapshot.integers, [&](int slot, std::string name, const auto& values) {
    models[slot].integers[std::move(name)] = values;
  });
  micro_runs_.restore(std::move(models));
  state_ = std::move(next);
}

}  // namespace hemoscale::coupling
