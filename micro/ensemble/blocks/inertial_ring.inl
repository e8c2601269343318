// One step of nodes with mass, after the momentum and viscous forces of [Tsubota2006, section 3.3]:
//
//   m dv/dt = F + zeta (u - v) + k |u - v| (u - v)
//
// Velocities belong to the middles of the steps. Relaxation by the linear (viscous) drag is exact,
// forces and the quadratic (momentum) drag are those at the beginning of the step:
//
//   c = u + [F + k |u - v| (u - v)] / zeta,   v' = v + (1 - exp(-dt zeta/m)) (c - v),   x' = x + dt
//   v'
//
// For m -> 0 this is the explicit step, for zeta -> 0 the leapfrog. (The exact integral of x with
// the velocity at its beginning would be unstable from the overdamped limit on, whatever the mass.)
// The memory holds the displacements dt v of the last step; `share` is 1 - exp(...).

template <class Real, class Bending, bool parallel_flow, bool walls>
HEMOSCALE_LANES void inertial_ring(const BlockArguments<Real>& g) {
  using V = typename Lanes<Real>::Vector;
  using Nodes = StoredNodes<V, Real>;
  constexpr int width = Lanes<Real>::width;
  const Real momentum = g.ring->momentum;
  const V drift_x = load<V>(g.drift);
  const V drift_y = load<V>(g.drift + width);
  RingExtremes<V> extremes;
  V largest = V{};
  AreaSum<V> area;
  pass_ring<Real, Bending, parallel_flow, walls>(
      g, load<V>(g.area), Nodes{g.x, g.y}, extremes,
      [&](int a, const typename Nodes::Node& node, V vx, V vy, V fx, V fy) {
        const V wx = load<V>(g.memory_x + a * width) - drift_x;
        const V wy = load<V>(g.memory_y + a * width) - drift_y;
        V cx = vx + fx;
        V cy = vy + fy;
        if (momentum != 0) {
          const V slip_x = vx - wx;
          const V slip_y = vy - wy;
          const V square = slip_x * slip_x + slip_y * slip_y;
          // A slip of zero has a root of zero: the smallest number keeps its inverse finite.
          const V slip = momentum * square * reciprocal_root(square + static_cast<Real>(1e-30));
          cx += slip * slip_x;
          cy += slip * slip_y;
        }
        const V dx = wx + g.share * (cx - wx);
        const V dy = wy + g.share * (cy - wy);
        const V moved_x = node.x + g.move * dx;
        const V moved_y = node.y + g.move * dy;
        store(g.memory_x + a * width, dx + drift_x);
        store(g.memory_y + a * width, dy + drift_y);
        store(g.x + a * width, moved_x);
        store(g.y + a * width, moved_y);
        const V against_x = dx - vx;  // the flow
        const V against_y = dy - vy;
        largest = larger(largest, against_x * against_x + against_y * against_y);
        area.add(a, moved_x, moved_y);
      });
  store(g.area, area.area());
  store(g.extremes, extremes.stretched);
  store(g.extremes + width, extremes.shortened);
  store(g.extremes + 2 * width, largest);
}
