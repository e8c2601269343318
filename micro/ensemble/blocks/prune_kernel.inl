// Which entries of a list hold a pair of nodes within a reach. Keeps their order.

HEMOSCALE_LANES bool any_below(Single v, float limit) {
  return any_above(-v, -limit);
}
HEMOSCALE_LANES bool any_below(Double v, double limit) {
  return any_above(-v, -limit);
}
HEMOSCALE_LANES bool any_below(Quad<float> v, float limit) {
  return v[0] < limit || v[1] < limit || v[2] < limit || v[3] < limit;
}
HEMOSCALE_LANES bool any_below(Quad<double> v, double limit) {
  return v[0] < limit || v[1] < limit || v[2] < limit || v[3] < limit;
}

template <class Real>
HEMOSCALE_LANES PruneCounts prune_entries(const PruneArguments<Real>& g) {
  using Pair = PairLanes<Real>;
  using P = typename Pair::Vector;
  PruneCounts kept;
  std::uint32_t entry = 0;
  for (std::uint32_t k = 0; k < g.active_count; ++k) {
    const ActiveCluster active = g.active[k];
    const Real* own =
        g.mirror + 8 * (static_cast<size_t>(g.first_cluster[active.lane]) + active.cluster);
    const P xi = Pair::own(own);
    const P yi = Pair::own(own + 4);
    const std::uint32_t before = kept.entries;
    for (; entry < active.end; ++entry) {
      const ClusterEntry e = g.entries[entry];
      const Real* other = g.mirror + 8 * static_cast<size_t>(e.other);
      const Real* shift = g.shifts + 2 * static_cast<size_t>(e.shift);
      P nearest{};
      for (int j = 0; j < cluster_nodes; j += Pair::others) {
        const P dx = xi - (Pair::other(other, j) + shift[0]);
        const P dy = yi - (Pair::other(other + 4, j) + shift[1]);
        const P s = dx * dx + dy * dy;
        nearest = j == 0 ? s : (s < nearest ? s : nearest);
      }
      g.kept_entries[kept.entries] = e;
      kept.entries += any_below(nearest, g.reach_squared) ? 1U : 0U;
    }
    if (kept.entries > before) {
      g.kept_active[kept.active++] = {active.cluster, active.lane, kept.entries};
    }
  }
  return kept;
}
