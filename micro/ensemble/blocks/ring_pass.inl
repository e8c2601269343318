// One pass along every ring of a block, from the first node to the last: hands out for each node
// where it is, how far the given flow carries it relative to the frame in a step, dt [u(x) -
// u(frame)], and how far the forces do, tau F. Nodes that were handed out may be moved at once.

// The nodes as they are stored.
template <class V, class Real>
struct StoredNodes {
  const Real* x;
  const Real* y;
  struct Node {
    V x, y;
  };
  HEMOSCALE_LANES Node at(int i) const {
    constexpr int width = Lanes<Real>::width;
    return {load<V>(x + i * width), load<V>(y + i * width)};
  }
  HEMOSCALE_LANES static Segment<V> between(const Node& a, const Node& b) {
    return segment<V>(a.x, a.y, b.x, b.y);
  }
  HEMOSCALE_LANES static V x_of(const Node& a) { return a.x; }
  HEMOSCALE_LANES static V y_of(const Node& a) { return a.y; }
};

template <class V>
struct RingExtremes {  // l0/l of the segments
  V stretched = V{} + 1;
  V shortened = V{} + 1;
};

// Drag that is larger or smaller across the membrane than along it: forces are given in units of
// the drag along it, and their part along the normal n is changed by `excess` = along/across - 1.
// The normal is that of the chord between both neighbours.
template <class V, class Real>
HEMOSCALE_LANES void turn_by_drag(Real excess, V chord_x, V chord_y, V& fx, V& fy) {
  const V normal =
      (fx * chord_y - fy * chord_x) * excess * reciprocal(chord_x * chord_x + chord_y * chord_y);
  fx += normal * chord_y;
  fy -= normal * chord_x;
}

template <class Real, class Bending, bool parallel_flow, bool walls, class V, class Nodes,
          class Take>
HEMOSCALE_LANES void pass_ring(const BlockArguments<Real>& g, V area, const Nodes& nodes,
                               RingExtremes<V>& extremes, const Take& take) {
  constexpr int width = Lanes<Real>::width;
  using Node = typename Nodes::Node;
  const RingTables<Real>& ring = *g.ring;
  const int n = ring.nodes;
  const V half_pressure = static_cast<Real>(-0.5) * (ring.area * (area - ring.rest_area));
  const FlowRows<V, parallel_flow> flow(g.flow);
  const V frame_y = walls ? load<V>(g.frame_y) : V{};
  const auto moment_of = [&](const Segment<V>& a, const Segment<V>& b, int i) {
    return Bending::moment(half_tangent(a, b), ring.bending[i], ring.natural[i]).value;
  };
  const Node first = nodes.at(0);
  Node here = first;
  Node after = nodes.at(1);
  Segment<V> s = Nodes::between(here, after);
  const Node last = nodes.at(n - 1);
  const Segment<V> closing = Nodes::between(last, here);
  const V first_moment = moment_of(closing, s, 0);
  const V last_moment = moment_of(Nodes::between(nodes.at(n - 2), last), closing, n - 1);
  V moment = first_moment;
  // Pull of the segment before, of which the first node needs that of the last segment.
  V fx0, fy0;
  {
    const V ratio = ring.stretch * (ring.inverse_rest[n - 1] - closing.q);
    const V across = (last_moment - first_moment) * closing.q;
    fx0 = ratio * closing.ex - across * closing.ty;
    fy0 = ratio * closing.ey + across * closing.tx;
  }
  V ex0 = closing.ex;
  V ey0 = closing.ey;
  for (int a = 0; a < n; ++a) {
    Node beyond = first;
    if (a + 2 < n) {
      beyond = nodes.at(a + 2);
    }
    Segment<V> next = closing;
    V next_moment = first_moment;
    if (a + 1 < n) {
      if (a + 2 < n) {
        next = Nodes::between(after, beyond);
      }
      next_moment = moment_of(s, next, a + 1);
    }
    const V shortening = s.q * ring.rest[a];
    extremes.shortened = larger(extremes.shortened, shortening);
    extremes.stretched = smaller(extremes.stretched, shortening);
    const V ratio = ring.stretch * (ring.inverse_rest[a] - s.q);
    const V across = (moment - next_moment) * s.q;
    const V fx = ratio * s.ex - across * s.ty;
    const V fy = ratio * s.ey + across * s.tx;
    const V x = Nodes::x_of(here);
    const V y = Nodes::y_of(here);
    V vx, vy;
    flow.velocity(x, y, vx, vy);
    V unused = V{};
    V load_y = load<V>(g.force_y + a * width);
    if constexpr (walls) add_walls(g.walls, frame_y + y, load_y, unused);
    const V chord_x = ex0 + s.ex;
    const V chord_y = ey0 + s.ey;
    V sum_x = load<V>(g.force_x + a * width) + (fx - fx0) + half_pressure * chord_y;
    V sum_y = load_y + (fy - fy0) - half_pressure * chord_x;
    if (ring.normal_excess != 0) turn_by_drag(ring.normal_excess, chord_x, chord_y, sum_x, sum_y);
    take(a, here, vx, vy, sum_x, sum_y);
    fx0 = fx;
    fy0 = fy;
    ex0 = s.ex;
    ey0 = s.ey;
    moment = next_moment;
    s = next;
    here = after;
    after = beyond;
  }
}

// The area within nodes that come one after the other.
template <class V>
struct AreaSum {
  V first_x = V{}, first_y = V{}, x = V{}, y = V{}, twice = V{};
  HEMOSCALE_LANES void add(int a, V next_x, V next_y) {
    if (a == 0) {
      first_x = next_x;
      first_y = next_y;
    } else {
      twice += x * next_y - next_x * y;
    }
    x = next_x;
    y = next_y;
  }
  HEMOSCALE_LANES V area() const {
    return static_cast<LaneType<V>>(0.5) * (twice + (x * first_y - first_x * y));
  }
};
