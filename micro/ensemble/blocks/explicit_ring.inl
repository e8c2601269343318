// One explicit step of every ring of a block:  x += dt [u(x) - u(frame)] + tau F.
//
// In single precision most increments of a small step are below half a unit in the last place of
// the offset. What rounding drops is therefore kept in the memory arrays and added in the next step
// [Kahan 1965]; double precision does the same, at no cost worth a variant.

template <class Real, class Bending, bool parallel_flow, bool walls>
HEMOSCALE_LANES void explicit_ring(const BlockArguments<Real>& g) {
  using V = typename Lanes<Real>::Vector;
  using Nodes = StoredNodes<V, Real>;
  constexpr int width = Lanes<Real>::width;
  RingExtremes<V> extremes;
  V largest = V{};
  AreaSum<V> area;
  pass_ring<Real, Bending, parallel_flow, walls>(
      g, load<V>(g.area), Nodes{g.x, g.y}, extremes,
      [&](int a, const typename Nodes::Node& node, V vx, V vy, V fx, V fy) {
        const V dx = fx + vx;
        const V dy = fy + vy;
        const V wanted_x = dx + load<V>(g.memory_x + a * width);
        const V wanted_y = dy + load<V>(g.memory_y + a * width);
        const V moved_x = node.x + wanted_x;
        const V moved_y = node.y + wanted_y;
        store(g.memory_x + a * width, wanted_x - (moved_x - node.x));
        store(g.memory_y + a * width, wanted_y - (moved_y - node.y));
        store(g.x + a * width, moved_x);
        store(g.y + a * width, moved_y);
        largest = larger(largest, fx * fx + fy * fy);  // against the flow
        area.add(a, moved_x, moved_y);
      });
  store(g.area, area.area());
  store(g.extremes, extremes.stretched);
  store(g.extremes + width, extremes.shortened);
  store(g.extremes + 2 * width, largest);
}
