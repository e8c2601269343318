// One step of every ring of a block by the stabilised explicit Runge-Kutta-Chebyshev method of
// second order [Sommeijer, Shampine and Verwer 1997]: s evaluations of the membrane, flow and walls
// for a step that is about 0.65 s^2 / 2 times as long as an explicit one. Rings couple to
// themselves alone because forces of contacts are those at the beginning of the step: first order
// for contacts.
//
// Stages are kept as displacements D from the stored nodes, and segments are formed as differences
// of both, so that stages much smaller than the last place of the offsets count. The first, D_0, is
// what rounding dropped in the last step, as in the explicit kernel.
//
//   D_1 = D_0 + force_1 K_0,   D_j = base_j D_0 + before_j D_(j-1) + second_j D_(j-2)
//                                    + force_j K_(j-1) + first_force_j K_0

template <class V, class Real>
struct StageNodes {
  const Real* x;
  const Real* y;
  const Real* stage_x;
  const Real* stage_y;
  struct Node {
    V x, y, dx, dy;
  };
  HEMOSCALE_LANES Node at(int i) const {
    constexpr int width = Lanes<Real>::width;
    const int k = i * width;
    return {load<V>(x + k), load<V>(y + k), load<V>(stage_x + k), load<V>(stage_y + k)};
  }
  HEMOSCALE_LANES static Segment<V> between(const Node& a, const Node& b) {
    return segment<V>(V{}, V{}, (b.x - a.x) + (b.dx - a.dx), (b.y - a.y) + (b.dy - a.dy));
  }
  HEMOSCALE_LANES static V x_of(const Node& a) { return a.x + a.dx; }
  HEMOSCALE_LANES static V y_of(const Node& a) { return a.y + a.dy; }
};

template <class Real, class Bending, bool parallel_flow, bool walls>
HEMOSCALE_LANES void rkc_ring(const BlockArguments<Real>& g) {
  using V = typename Lanes<Real>::Vector;
  using Nodes = StageNodes<V, Real>;
  constexpr int width = Lanes<Real>::width;
  const int values = g.ring->nodes * width;
  Real* const first_x = g.scratch;  // K_0
  Real* const first_y = g.scratch + values;
  // Stages by turns, each over the last but one; the memory is the first of all.
  Real* const stage_x[2] = {g.scratch + 2 * values, g.scratch + 4 * values};
  Real* const stage_y[2] = {g.scratch + 3 * values, g.scratch + 5 * values};
  RingExtremes<V> extremes;
  V area = load<V>(g.area);
  for (int j = 0; j < g.stage_count; ++j) {
    const StageWeights<Real> w = g.stages[j];
    const Real* const before_x = j == 0 ? g.memory_x : stage_x[(j + 1) % 2];
    const Real* const before_y = j == 0 ? g.memory_y : stage_y[(j + 1) % 2];
    const Real* const second_x = j < 2 ? g.memory_x : stage_x[j % 2];
    const Real* const second_y = j < 2 ? g.memory_y : stage_y[j % 2];
    Real* const next_x = stage_x[j % 2];
    Real* const next_y = stage_y[j % 2];
    AreaSum<V> sum;
    pass_ring<Real, Bending, parallel_flow, walls>(
        g, area, Nodes{g.x, g.y, before_x, before_y}, extremes,
        [&](int a, const typename Nodes::Node& node, V vx, V vy, V fx, V fy) {
          const int k = a * width;
          const V kx = fx + vx;
          const V ky = fy + vy;
          if (j == 0) {
            store(first_x + k, kx);
            store(first_y + k, ky);
          }
          const V dx = w.base * load<V>(g.memory_x + k) + w.before * node.dx +
                       w.second * load<V>(second_x + k) + w.force * kx +
                       w.first_force * load<V>(first_x + k);
          const V dy = w.base * load<V>(g.memory_y + k) + w.before * node.dy +
                       w.second * load<V>(second_y + k) + w.force * ky +
                       w.first_force * load<V>(first_y + k);
          store(next_x + k, dx);
          store(next_y + k, dy);
          sum.add(a, node.x + dx, node.y + dy);
        });
    area = sum.area();
  }
  const Real* const last_x = stage_x[(g.stage_count + 1) % 2];
  const Real* const last_y = stage_y[(g.stage_count + 1) % 2];
  const FlowRows<V, parallel_flow> flow(g.flow);
  V largest = V{};
  AreaSum<V> sum;
  for (int a = 0; a < g.ring->nodes; ++a) {
    const int k = a * width;
    const V x = load<V>(g.x + k);
    const V y = load<V>(g.y + k);
    const V dx = load<V>(last_x + k);
    const V dy = load<V>(last_y + k);
    const V moved_x = x + dx;
    const V moved_y = y + dy;
    store(g.memory_x + k, dx - (moved_x - x));
    store(g.memory_y + k, dy - (moved_y - y));
    store(g.x + k, moved_x);
    store(g.y + k, moved_y);
    V vx, vy;
    flow.velocity(x, y, vx, vy);
    const V slip_x = dx - vx;
    const V slip_y = dy - vy;
    largest = larger(largest, slip_x * slip_x + slip_y * slip_y);
    sum.add(a, moved_x, moved_y);
  }
  store(g.area, sum.area());
  store(g.extremes, extremes.stretched);
  store(g.extremes + width, extremes.shortened);
  store(g.extremes + 2 * width, largest);
}
