#pragma once

#include <cstdint>

#include "micro/ensemble/regions/copy_carrier.hpp"

namespace hemoscale::micro {

/// How an ensemble is spread over ranks.
struct RegionOptions {
  regions::CopyMotion motion = regions::CopyMotion::flow;
  /// Steps between exchanges of copies; 0: by `exchange_interval`. With 1 the bits do not depend on
  /// the number of ranks.
  std::int64_t exchange_interval = 0;
  /// [-] Cells stray from the regions of their ranks; they are dealt out anew when copies have
  /// become so many times as many as after the last time.
  double copy_growth = 1.3;
};

/// What the ranks did besides advancing their cells, on this rank.
struct RegionCounters {
  double step_seconds = 0;       // [s] advancing cells, with waiting and exchanging in between
  double waiting_seconds = 0;    // [s] for copies, with nothing else to do
  double exchange_seconds = 0;   // [s] forming and reading messages
  double search_seconds = 0;     // [s] finding who needs copies of whom
  double agreement_seconds = 0;  // [s] deciding together how long lists last
  double migration_seconds = 0;  // [s] moving cells to other ranks
  int columns = 1;               // of regions along the channel; ranks are columns times rows
  std::int64_t migrations = 0;
  std::int64_t messages = 0;  // of copies
  std::int64_t bytes = 0;     // in them
  std::int64_t cells = 0;     // now
  std::int64_t copies = 0;    // now
};

}  // namespace hemoscale::micro
