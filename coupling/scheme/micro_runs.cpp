#include "coupling/scheme/micro_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <cstdint>
#include <exception>
#include <mutex>
#include <numeric>
#include <utility>

#include "coupling/error.hpp"
#include "coupling/scheme/byte_stream.hpp"
#include "micro/error.hpp"

namespace hemoscale::coupling {

namespace {

enum class Failure : std::int64_t { none, numerical, other };

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

struct MicroRuns::Outcome {
  FinishedRun run;
  micro::Snapshot state;
  std::unique_ptr<micro::MicroModel<2>> model;
  Failure failure = Failure::none;
  std::string reason;
};

// One at a time on a rank.
struct MicroRuns::Turns {
  std::mutex factory;
  std::mutex callback;
};

MicroRuns::MicroRuns(MicroFactory factory, const micro::Communicator& communicator, int threads)
    : factory_(std::move(factory)), communicator_(communicator), threads_(threads) {
  assert(threads >= 1);
}

void MicroRuns::restore(std::map<int, micro::Snapshot> states) {
  states_ = std::move(states);
  live_models_.clear();
}

// Makes one run on this rank, on any thread; every exception becomes part of the outcome.
MicroRuns::Outcome MicroRuns::make_run(const PlannedRun& planned, Model model,
                                       const micro::Run& run, const RunCallback& on_run,
                                       Turns& turns) const {
  Outcome outcome;
  outcome.run.slot = planned.slot;
  outcome.run.shear_rate = planned.flow.shear_rate;
  outcome.run.rank = communicator_.rank();
  try {
    if (!model) {
      {
        const std::lock_guard lock(turns.factory);
        model = factory_(planned.slot);
      }
      if (const auto state = states_.find(planned.slot); state != states_.end()) {
        model->restore(state->second);
      }
    }
    const auto begin = std::chrono::steady_clock::now();
    outcome.run.observation = model->advance(planned.flow.forcing, run);
    outcome.run.wall_time = seconds_since(begin);
    outcome.state = model->snapshot();
    if (on_run) {
      const std::lock_guard lock(turns.callback);
      on_run(outcome.run, *model);
    }
    outcome.model = std::move(model);
  } catch (const micro::NumericalError& error) {
    outcome.failure = Failure::numerical;
    outcome.reason = error.what();
  } catch (const NumericalError& error) {
    outcome.failure = Failure::numerical;
    outcome.reason = error.what();
  } catch (const std::exception& error) {
    outcome.failure = Failure::other;
    outcome.reason = error.what();
  } catch (...) {
    outcome.failure = Failure::other;
    outcome.reason = "unknown exception";
  }
  return outcome;
}

std::vector<MicroRuns::Outcome> MicroRuns::make_own_runs(const std::vector<PlannedRun>& plan,
                                                         const std::vector<std::size_t>& own,
                                                         const micro::Run& run,
                                                         const RunCallback& on_run) {
  // Models leave live_models_ here and come back when every rank has succeeded: after a failure
  // they are made anew from the states before the call.
  std::vector<Model> models(own.size());
  for (std::size_t k = 0; k < own.size(); ++k) {
    if (auto node = live_models_.extract(plan[own[k]].slot)) models[k] = std::move(node.mapped());
  }
  std::vector<Outcome> outcomes(own.size());
  Turns turns;
  const auto count = static_cast<std::ptrdiff_t>(own.size());
  // With one run, or one thread, the model may use the threads inside.
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads_) if (threads_ > 1 && count > 1)
  for (std::ptrdiff_t i = 0; i < count; ++i) {
    const auto k = static_cast<std::size_t>(i);
    outcomes[k] = make_run(plan[own[k]], std::move(models[k]), run, on_run, turns);
  }
  return outcomes;
}

std::vector<FinishedRun> MicroRuns::advance(const std::vector<PlannedRun>& plan,
                                            const micro::Run& run, const RunCallback& on_run) {
  const std::vector<int> ranks = spread_over_ranks(plan, communicator_.size());
  std::vector<std::size_t> own;
  for (std::size_t i = 0; i < plan.size(); ++i) {
    if (ranks[i] == communicator_.rank()) own.push_back(i);
  }
  std::vector<Outcome> outcomes = make_own_runs(plan, own, run, on_run);

  ByteWriter message;
  for (std::size_t k = 0; k < own.size(); ++k) {
    message.integer(static_cast<std::int64_t>(own[k]));
    message.integer(static_cast<std::int64_t>(outcomes[k].failure));
    message.text(outcomes[k].reason);
    message.observation(outcomes[k].run.observation);
    message.real(outcomes[k].run.wall_time);
    message.snapshot(outcomes[k].state);
  }
  std::vector<FinishedRun> finished(plan.size());
  std::vector<micro::Snapshot> states(plan.size());
  Failure worst = Failure::none;
  std::string reasons;
  const std::vector<std::string> messages = communicator_.all_gather(message.bytes());
  for (std::size_t rank = 0; rank < messages.size(); ++rank) {
    ByteReader reader(messages[rank]);
    while (!reader.at_end()) {
      const auto i = static_cast<std::size_t>(reader.integer());
      const auto failure = static_cast<Failure>(reader.integer());
      const std::string reason = reader.text();
      finished[i].slot = plan[i].slot;
      finished[i].shear_rate = plan[i].flow.shear_rate;
      finished[i].observation = reader.observation();
      finished[i].rank = static_cast<int>(rank);
      finished[i].wall_time = reader.real();
      states[i] = reader.snapshot();
      if (failure == Failure::none) continue;
      worst = std::max(worst, failure);
      reasons += fmt::format("{}rank {}: micro run of slot {} at shear rate {:.6g} 1/s: {}",
                             reasons.empty() ? "" : "\n", rank, plan[i].slot,
                             plan[i].flow.shear_rate, reason);
    }
  }
  if (worst == Failure::numerical) throw NumericalError(reasons);
  if (worst == Failure::other) throw EnvironmentError(reasons);

  for (std::size_t i = 0; i < plan.size(); ++i) {
    states_[plan[i].slot] = std::move(states[i]);
    live_models_.erase(plan[i].slot);  // out of date if another rank made this run
  }
  for (std::size_t k = 0; k < own.size(); ++k) {
    live_models_[plan[own[k]].slot] = std::move(outcomes[k].model);
  }
  return finished;
}

std::vector<int> spread_over_ranks(const std::vector<PlannedRun>& plan, int ranks) {
  std::vector<std::size_t> order(plan.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return plan[a].flow.shear_rate < plan[b].flow.shear_rate;  // the slowest run first
  });
  std::vector<double> load(static_cast<std::size_t>(ranks), 0.0);
  std::vector<int> result(plan.size());
  for (const std::size_t i : order) {
    const auto least = std::min_element(load.begin(), load.end());
    *least += 1 / plan[i].flow.shear_rate;
    result[i] = static_cast<int>(least - load.begin());
  }
  return result;
}

}  // namespace hemoscale::coupling
