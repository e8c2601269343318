// What ranks and threads gain, and what exchanges cost: cells in a crowded channel, once by one
// process with one and with two threads, once by all ranks, in turns in one run:
//
//   mpirun -np 2 ensemble_ranks [CELLS [STEPS [INTERVAL [REPETITIONS]]]]
//
// INTERVAL is the number of steps between exchanges of copies; 0, the default, by the error bound.
// Best wall time of the repetitions and the processor time that belongs to it; efficiency is the
// time of one thread over the time and the number of threads or ranks. Wall times mean something on
// an idle machine alone: say how loaded it was with every figure.
//
// Then a cost model fitted to the run,
//
//   t = a nodes / ranks + (b copies + c messages) / interval + d log2(ranks) / leg,
//
// with a from the processor time of one thread, b from forming and reading messages, copies per
// length of border from the run on ranks, and, because messages within a machine tell nothing about
// a network, c and d from assumptions: 2 us a message or stage of a reduction, 10 GB/s. It is
// applied to 80 ranks with these cells and with a million, and to 10 000 ranks with a million.

#include <fmt/core.h>
#include <mpi.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <vector>

#include "micro/ensemble/regions/rank_messages.hpp"
#include "micro/ensemble/regions/region_ensemble.hpp"
#include "micro/ensemble/regions/region_grid.hpp"
#include "tests/support/micro/dense_channel.hpp"

namespace hemoscale::micro {
namespace {

constexpr int nodes = 100;
constexpr double latency = 2e-6;                 // [s] assumed
constexpr double seconds_per_byte = 1.0 / 10e9;  // assumed
constexpr double steps_per_leg = 32;             // between two decisions about the lists

struct Measured {
  double wall = 1e30, cpu = 0;  // [s] per step; processor time of all ranks
  RegionCounters counters;      // of this rank
};

struct Case {
  test::DenseChannel channel;
  std::int64_t steps = 0;
  std::int64_t interval = 0;
  int repetitions = 0;
};

void measure(const Case& c, const Communicator& ranks, int threads, Measured& best) {
  const regions::RankMessages messages(ranks);
  blocks::BlockSettings settings = c.channel.settings;
  settings.threads = threads;
  RegionEnsemble ensemble(settings, Precision::single, part_of_rank({c.channel.state}, ranks),
                          ranks, {.exchange_interval = c.interval});
  ensemble.advance(20);
  messages.sum({0});
  const RegionCounters before = ensemble.region_counters();
  const std::clock_t cpu = std::clock();
  const auto begin = std::chrono::steady_clock::now();
  ensemble.advance(c.steps);
  messages.sum({0});
  const double wall =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const double used = static_cast<double>(std::clock() - cpu) / CLOCKS_PER_SEC;
  const std::vector<double> all = messages.gather({used});
  const auto steps = static_cast<double>(c.steps);
  if (wall / steps >= best.wall) return;
  best.wall = wall / steps;
  best.cpu = 0;
  for (const double each : all) best.cpu += each / steps;
  best.counters = ensemble.region_counters();
  best.counters.exchange_seconds -= before.exchange_seconds;
  best.counters.waiting_seconds -= before.waiting_seconds;
  best.counters.agreement_seconds -= before.agreement_seconds;
  best.counters.search_seconds -= before.search_seconds;
  best.counters.messages -= before.messages;
  best.counters.bytes -= before.bytes;
}

void print(const char* name, const Measured& m, const Measured& one, int workers,
           double all_nodes) {
  fmt::print(
      "{:<12} wall {:8.2f} us a step ({:.2f} ns a node), processor {:8.2f} us; efficiency wall "
      "{:.3f}, processor {:.3f}\n",
      name, 1e6 * m.wall, 1e9 * m.wall / all_nodes, 1e6 * m.cpu, one.wall / (workers * m.wall),
      one.cpu / m.cpu);
}

struct Model {
  double per_node = 0;  // [s] a
  double per_copy = 0;  // [s] b
  double bytes_per_copy = 0;
  double copies_per_border = 0;  // [1/m]
  double interval = 1;
};

void extrapolate(const Model& m, int ranks, double cells, double length, double height) {
  const auto [columns, rows] = regions::choose_grid(ranks, length, height, true, false);
  const double border = 2 * height / rows + (rows > 1 ? 2 * length / columns : 0);
  const double copies = m.copies_per_border * border;
  const double compute = m.per_node * nodes * cells / ranks;
  const double neighbours = rows > 1 ? 8 : 2;
  const double exchange =
      (copies * (m.per_copy + m.bytes_per_copy * seconds_per_byte) + neighbours * latency) /
      m.interval;
  const double agreement = 2 * latency * std::log2(static_cast<double>(ranks)) / steps_per_leg;
  fmt::print(
      "{:>6} ranks ({} x {}), {:.0f} cells: {:.1f} cells and {:.1f} copies a rank; compute "
      "{:.2f}, exchange {:.2f}, agreement {:.2f} us a step; efficiency {:.3f}\n",
      ranks, columns, rows, cells, cells / ranks, copies, 1e6 * compute, 1e6 * exchange,
      1e6 * agreement, compute / (compute + exchange + agreement));
}

void run(const Case& c, const Communicator& all) {
  const Communicator single;
  const regions::RankMessages messages(all);
  Measured one, two_threads, ranks;
  for (int k = 0; k < c.repetitions; ++k) {
    if (all.is_root()) {
      measure(c, single, 1, one);
      measure(c, single, 2, two_threads);
    }
    messages.sum({0});
    measure(c, all, 1, ranks);
  }
  if (!all.is_root()) return;
  const auto cells = static_cast<double>(c.channel.state.cells);
  const double all_nodes = cells * nodes;
  print("1 thread", one, one, 1, all_nodes);
  print("2 threads", two_threads, one, 2, all_nodes);
  print(fmt::format("{} ranks", all.size()).c_str(), ranks, one, all.size(), all_nodes);
  if (all.size() == 1) return;
  const RegionCounters& r = ranks.counters;
  const double steps = static_cast<double>(c.steps);
  fmt::print(
      "rank 0, us a step: waiting for copies {:.2f}, messages {:.2f}, search {:.2f}, agreement "
      "{:.2f}; {} copies, {:.0f} bytes a message\n",
      1e6 * r.waiting_seconds / steps, 1e6 * r.exchange_seconds / steps,
      1e6 * r.search_seconds / steps, 1e6 * r.agreement_seconds / steps, r.copies,
      static_cast<double>(r.bytes) / static_cast<double>(std::max<std::int64_t>(1, r.messages)));
  const double height = c.channel.settings.height;
  const double length = c.channel.settings.length;
  Model m;
  m.interval = static_cast<double>(c.interval);
  m.per_node = one.cpu / all_nodes;
  const double exchanges = steps / m.interval;
  m.per_copy = r.exchange_seconds / exchanges / static_cast<double>(r.copies);
  m.bytes_per_copy = static_cast<double>(r.bytes) / exchanges / static_cast<double>(r.copies);
  m.copies_per_border = static_cast<double>(r.copies) / (2 * height);
  fmt::print(
      "a = {:.3f} ns a node, b = {:.3f} us a copy, {:.0f} bytes a copy, {:.3f} copies per um of "
      "border, exchange every {:.0f} steps\n",
      1e9 * m.per_node, 1e6 * m.per_copy, m.bytes_per_copy, 1e-6 * m.copies_per_border, m.interval);
  extrapolate(m, 80, cells, length, height);
  const double million = 1e6;
  const double side = std::sqrt(million / cells);  // the channel grows in both directions
  extrapolate(m, 80, million, length * side, height * side);
  extrapolate(m, 10000, million, length * side, height * side);
  extrapolate(m, 10000, million, length * million / cells, height);
}

}  // namespace
}  // namespace hemoscale::micro

int main(int argc, char** argv) {
  using namespace hemoscale;
  int provided = 0;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &provided);
  const auto argument = [&](int k, long otherwise) {
    return argc > k ? std::strtol(argv[k], nullptr, 10) : otherwise;
  };
  int code = 0;
  try {
    const micro::Communicator all(MPI_COMM_WORLD);
    constexpr int rows = 21;  // across 72 um
    micro::Case c;
    c.channel =
        test::dense_channel(static_cast<int>(argument(1, 1200) / rows), rows, micro::nodes, 3e-6);
    c.steps = argument(2, 500);
    c.interval = argument(3, 0);
    c.repetitions = static_cast<int>(argument(4, 3));
    c.channel.settings.time_step = 2e-3;
    if (c.interval == 0) {
      c.interval = micro::RegionEnsemble(c.channel.settings, micro::Precision::single,
                                         micro::part_of_rank({c.channel.state}, all), all)
                       .exchange_interval();
    }
    micro::run(c, all);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    code = 1;
    MPI_Abort(MPI_COMM_WORLD, code);
  }
  MPI_Finalize();
  return code;
}
