// One implicit step of every ring of a block with an operator of constant coefficients.
//
// Backward differences of first order, d' = r(x'), or of second, d' = d/3 + (2/3) r(x'), with the
// displacements d of the last step and d' of this, x' = x + d', r = dt (u - u(frame)) + tau F. One
// step of a simplified Newton iteration from the prediction X = x + d meets either:
//
//   M s = b [r(X) - d],    d' = d + s,    b = 1 or 2/3.
//
// Any M that exceeds 3/4 of I + b tau K in the sense of quadratic forms is stable, K the second
// derivative of the energy: for a mode of K the iteration matrix is [1-q, 1-q; -q, 1-q] with
// q = b tau k / m, whose eigenvalues lie in the unit circle for 0 < q < 4/3. So M may bound K from
// above by something simple:
//
//   M = A + g g' b tau k_A / A0 - w w' / (p' w),     A = 1 + b tau c_i + a (-1,2,-1) + e
//   (1,-4,6,-4,1)
//
// with a = b tau E / min l0 and e = b tau kappa / min l0^3 in every direction (the stretching acts
// along the segment alone, and tension over length is below E/l0), c_i twice the sum of the
// stiffness of the contacts of node i (a pair of nodes moves as if joined by a spring of twice its
// diagonal), g the gradient of the area, p = (-y, x) the rigid rotation and w = (A - 1 - b tau c)
// p: the last term takes the resistance to rotation out again, exactly. It can be taken out because
// K resists no rotation either but for the turning of its forces. What is left of the error is the
// second difference of d in time of shapes that change, not of cells that turn.
//
// A is scalar, cyclic and pentadiagonal: nodes n-2 and n-1 border a banded elimination. The columns
// are the right-hand side r, the gradient g and h = (1 + b tau c) p, each with two components.
// Several short loops, because one long loop has more numbers under way than there are registers.

template <class V>
struct OperatorNode {
  V r[2], g[2], h[2];  // columns; over the pivots after the elimination
  V resist;            // 1 + b tau c
  V pivot;             // inverse
  V m1, m2;            // to the next two nodes
  V w1, w2;            // of the border, over the pivot
};

// Forward substitution of one pair of columns, node after node.
template <class V>
struct Substitution {
  V v0[2] = {V{}, V{}};  // from the nodes before into this one
  V v1[2] = {V{}, V{}};  // and into the next
  V r1[2] = {V{}, V{}};  // into the border
  V r2[2] = {V{}, V{}};
  V x, y;  // of this node, before they are divided by the pivot

  HEMOSCALE_LANES void pass(const OperatorNode<V>& node, V (&c)[2]) {
    x = c[0] - v0[0];
    y = c[1] - v0[1];
    r1[0] += node.w1 * x;
    r1[1] += node.w1 * y;
    r2[0] += node.w2 * x;
    r2[1] += node.w2 * y;
    v0[0] = v1[0] + node.m1 * x;
    v0[1] = v1[1] + node.m1 * y;
    v1[0] = node.m2 * x;
    v1[1] = node.m2 * y;
    c[0] = node.pivot * x;
    c[1] = node.pivot * y;
  }
  HEMOSCALE_LANES void reach_border(const V (&first)[2], const V (&second)[2]) {
    for (int k = 0; k < 2; ++k) {
      r1[k] = first[k] - r1[k];
      r2[k] = second[k] - r2[k];
    }
  }
};

// What the columns are made of, kept in the places that they will take.
template <class V>
struct OperatorShape {
  OperatorNode<V>* nodes;
  HEMOSCALE_LANES V& x(int i) const { return nodes[i].h[0]; }  // [um] predicted
  HEMOSCALE_LANES V& y(int i) const { return nodes[i].h[1]; }
  HEMOSCALE_LANES V& ex(int i) const { return nodes[i].g[0]; }  // [um] to the next node
  HEMOSCALE_LANES V& ey(int i) const { return nodes[i].g[1]; }
  HEMOSCALE_LANES V& q(int i) const { return nodes[i].pivot; }    // [1/um] inverse length
  HEMOSCALE_LANES V& moment(int i) const { return nodes[i].m1; }  // [um^2] of bending
};

// Segments and bending moments at the prediction. Long chains of operations, one per node: a loop
// of its own, so short that many nodes are under way at once.
template <class Real, class Bending, class V>
HEMOSCALE_LANES void set_shape(const BlockArguments<Real>& g, const OperatorShape<V>& shape) {
  constexpr int width = Lanes<Real>::width;
  const RingTables<Real>& ring = *g.ring;
  const int n = ring.nodes;
  const V drift_x = load<V>(g.drift);
  const V drift_y = load<V>(g.drift + width);
  const auto x_of = [&](int i) {
    return load<V>(g.x + i * width) + (load<V>(g.memory_x + i * width) - drift_x);
  };
  const auto y_of = [&](int i) {
    return load<V>(g.y + i * width) + (load<V>(g.memory_y + i * width) - drift_y);
  };
  V x = x_of(0);
  V y = y_of(0);
  const V first_x = x;
  const V first_y = y;
  Segment<V> before = segment<V>(x_of(n - 1), y_of(n - 1), x, y);
  const auto node = [&](int a, V next_x, V next_y) {
    const Segment<V> s = segment<V>(x, y, next_x, next_y);
    shape.x(a) = x;
    shape.y(a) = y;
    shape.ex(a) = s.ex;
    shape.ey(a) = s.ey;
    shape.q(a) = s.q;
    shape.moment(a) =
        Bending::moment(half_tangent(before, s), ring.bending[a], ring.natural[a]).value;
    before = s;
    x = next_x;
    y = next_y;
  };
  for (int a = 0; a + 1 < n; ++a) node(a, x_of(a + 1), y_of(a + 1));
  node(n - 1, first_x, first_y);
}

// Membrane, flow and walls at the prediction: columns of all nodes, and sums over them.
template <class V>
struct OperatorSums {
  V pr = V{};  // p'r
  V ph = V{};  // p'h
};

template <class Real, bool parallel_flow, bool walls, class V>
HEMOSCALE_LANES void set_columns(const BlockArguments<Real>& g, const OperatorShape<V>& shape,
                                 OperatorSums<V>& sums) {
  constexpr int width = Lanes<Real>::width;
  const RingTables<Real>& ring = *g.ring;
  const int n = ring.nodes;
  const Real b = g.share;
  const V drift_x = load<V>(g.drift);
  const V drift_y = load<V>(g.drift + width);
  const V one = V{} + 1;
  const V half_pressure =
      static_cast<Real>(-0.5) * (ring.area * (load<V>(g.area) - ring.rest_area));
  const FlowRows<V, parallel_flow> flow(g.flow);
  const V frame_y = walls ? load<V>(g.frame_y) : V{};
  // Pull of a segment on its first node.
  const auto pull = [&](int a, V ex, V ey, V q, V moment, V next_moment, V& fx, V& fy) {
    const V ratio = ring.stretch * (ring.inverse_rest[a] - q);
    const V across = (moment - next_moment) * (q * q);
    fx = ratio * ex - across * ey;
    fy = ratio * ey + across * ex;
  };
  const V first_moment = shape.moment(0);
  V ex0 = shape.ex(n - 1);
  V ey0 = shape.ey(n - 1);
  V fx0, fy0;
  pull(n - 1, ex0, ey0, shape.q(n - 1), shape.moment(n - 1), first_moment, fx0, fy0);
  V moment = first_moment;
  V shortened = one;
  V stretched = one;
  const auto node = [&](int a, V next_moment) {
    const V x = shape.x(a);
    const V y = shape.y(a);
    const V ex = shape.ex(a);
    const V ey = shape.ey(a);
    const V q = shape.q(a);
    const V shortening = q * ring.rest[a];
    shortened = larger(shortened, shortening);
    stretched = smaller(stretched, shortening);
    V fx, fy;
    pull(a, ex, ey, q, moment, next_moment, fx, fy);
    V vx, vy;
    flow.velocity(x, y, vx, vy);
    V load_y = load<V>(g.force_y + a * width) + vy;
    V c = load<V>(g.stiffness_xx + a * width);
    if constexpr (walls) add_walls(g.walls, frame_y + y, load_y, c);
    const V arm_x = ey0 + ey;
    const V arm_y = ex0 + ex;
    const V rx = b * (load<V>(g.force_x + a * width) + vx + (fx - fx0) + half_pressure * arm_x -
                      (load<V>(g.memory_x + a * width) - drift_x));
    const V ry = b * (load_y + (fy - fy0) - half_pressure * arm_y -
                      (load<V>(g.memory_y + a * width) - drift_y));
    const V resist = one + b * c;
    const V hx = -resist * y;
    const V hy = resist * x;
    sums.pr += ry * x - rx * y;
    sums.ph += hy * x - hx * y;
    OperatorNode<V>& to = shape.nodes[a];
    to.r[0] = rx;
    to.r[1] = ry;
    to.g[0] = static_cast<Real>(0.5) * arm_x;
    to.g[1] = static_cast<Real>(-0.5) * arm_y;
    to.h[0] = hx;
    to.h[1] = hy;
    to.resist = resist;
    fx0 = fx;
    fy0 = fy;
    ex0 = ex;
    ey0 = ey;
    moment = next_moment;
  };
  for (int a = 0; a + 1 < n; ++a) node(a, shape.moment(a + 1));
  node(n - 1, first_moment);
  store(g.extremes, stretched);
  store(g.extremes + width, shortened);
}

// L D L' of the chain 0 ... n-3, its products with the couplings to the border, and the
// substitution of the gradient of the area. @returns g'A^-1 g of the chain
template <class Real, class V>
HEMOSCALE_LANES V eliminate(Real o1, Real o2, Real diagonal, int n, OperatorNode<V>* nodes,
                            V (&border)[3], Substitution<V>& gradient) {
  const V zero = V{};
  V d = zero - (diagonal - 1);  // minus what is added to `resist` in the diagonal of this node
  V d_next = d;
  V e = zero + o1;
  V w1 = zero + o2;
  V w2 = zero + o1;
  V w1_next = zero;
  V w2_next = zero + o2;
  V s11 = zero, s12 = zero, s22 = zero;
  V gg = zero;
  const auto step = [&](int a, V coupling, Real c2, Real more1, Real more2) {
    OperatorNode<V>& node = nodes[a];
    const V pivot = reciprocal(node.resist - d);
    const V v1 = w1 + more1;
    const V v2 = w2 + more2;
    const V m1 = coupling * pivot;
    const V m2 = c2 * pivot;
    node.pivot = pivot;
    node.m1 = m1;
    node.m2 = m2;
    node.w1 = v1 * pivot;
    node.w2 = v2 * pivot;
    s11 += v1 * node.w1;
    s12 += v1 * node.w2;
    s22 += v2 * node.w2;
    d = d_next + coupling * m1;
    d_next = c2 * m2 - (diagonal - 1);
    e = o1 - c2 * m1;
    w1 = w1_next - m1 * v1;
    w2 = w2_next - m1 * v2;
    w1_next = -m2 * v1;
    w2_next = -m2 * v2;
    gradient.pass(node, node.g);
    gg += node.g[0] * gradient.x + node.g[1] * gradient.y;
  };
  const Real none = 0;
  for (int a = 0; a < n - 4; ++a) step(a, e, o2, none, none);
  step(n - 4, e, none, o2, none);
  step(n - 3, zero, none, o1, o2);
  border[0] = nodes[n - 2].resist + (diagonal - 1) - s11;
  border[1] = o1 - s12;
  border[2] = nodes[n - 1].resist + (diagonal - 1) - s22;
  gradient.reach_border(nodes[n - 2].g, nodes[n - 1].g);
  return gg;
}

template <class Real, class Bending, bool parallel_flow, bool walls>
HEMOSCALE_LANES void constant_operator_ring(const BlockArguments<Real>& g) {
  using V = typename Lanes<Real>::Vector;
  constexpr int width = Lanes<Real>::width;
  const RingTables<Real>& ring = *g.ring;
  const int n = ring.nodes;
  const Real b = g.share;
  const Real o1 = -b * (ring.largest_stretch + 4 * ring.largest_bending);
  const Real o2 = b * ring.largest_bending;
  const Real diagonal = 1 + b * (2 * ring.largest_stretch + 6 * ring.largest_bending);
  const V zero = V{};
  const V one = zero + 1;
  auto* const nodes = reinterpret_cast<OperatorNode<V>*>(g.scratch);
  const OperatorShape<V> shape{nodes};
  set_shape<Real, Bending>(g, shape);
  OperatorSums<V> sums;
  set_columns<Real, parallel_flow, walls>(g, shape, sums);
  V border[3];
  Substitution<V> rows_g, rows_h, rows_r;
  V gg = eliminate(o1, o2, diagonal, n, nodes, border, rows_g);
  V gh = zero, hh = zero, gr = zero, hr = zero;
  for (int a = 0; a < n - 2; ++a) {
    OperatorNode<V>& node = nodes[a];
    rows_h.pass(node, node.h);
    rows_r.pass(node, node.r);
    gh += node.g[0] * rows_h.x + node.g[1] * rows_h.y;
    hh += node.h[0] * rows_h.x + node.h[1] * rows_h.y;
    gr += node.g[0] * rows_r.x + node.g[1] * rows_r.y;
    hr += node.h[0] * rows_r.x + node.h[1] * rows_r.y;
  }
  rows_h.reach_border(nodes[n - 2].h, nodes[n - 1].h);
  rows_r.reach_border(nodes[n - 2].r, nodes[n - 1].r);
  // Solutions at the border.
  const V inverse = one / (border[0] * border[2] - border[1] * border[1]);
  const V i11 = inverse * border[2];
  const V i12 = -inverse * border[1];
  const V i22 = inverse * border[0];
  V zr1[2], zr2[2];
  V zh1[2], zh2[2], zg1[2], zg2[2];
  for (int k = 0; k < 2; ++k) {
    zg1[k] = i11 * rows_g.r1[k] + i12 * rows_g.r2[k];
    zg2[k] = i12 * rows_g.r1[k] + i22 * rows_g.r2[k];
    zh1[k] = i11 * rows_h.r1[k] + i12 * rows_h.r2[k];
    zh2[k] = i12 * rows_h.r1[k] + i22 * rows_h.r2[k];
    zr1[k] = i11 * rows_r.r1[k] + i12 * rows_r.r2[k];
    zr2[k] = i12 * rows_r.r1[k] + i22 * rows_r.r2[k];
    gg += rows_g.r1[k] * zg1[k] + rows_g.r2[k] * zg2[k];
    gh += rows_g.r1[k] * zh1[k] + rows_g.r2[k] * zh2[k];
    hh += rows_h.r1[k] * zh1[k] + rows_h.r2[k] * zh2[k];
    gr += rows_g.r1[k] * zr1[k] + rows_g.r2[k] * zr2[k];
    hr += rows_h.r1[k] * zr1[k] + rows_h.r2[k] * zr2[k];
  }
  // Woodbury's formula for the two terms of rank one. With q = A^-1 w = p - A^-1 h:
  //   g'q = -g'A^-1 h,   w'A^-1 r = p'r - h'A^-1 r,   w'q - p'w = h'A^-1 h - p'h,
  //
  // for g'p = 0: rotation changes no area.
  // The area part is scaled by the modulus, so that none is possible.
  const Real area = b * ring.area;
  const V t11 = one + area * gg;
  const V t12 = -gh;
  const V t22 = hh - sums.ph;
  const V t1 = area * gr;
  const V t2 = sums.pr - hr;
  const V determinant = one / (t11 * t22 - area * t12 * t12);
  const V pressure_part = determinant * (t22 * t1 - area * t12 * t2);
  const V rotation_part = determinant * (t11 * t2 - t12 * t1);

  // Back substitution and motion, from the last node to the first.
  V z1x = zero, z1y = zero, z2x = zero, z2y = zero;
  V area_sum = zero;
  V largest = zero;
  V xn = zero, yn = zero;
  const Real move = g.move;
  const V drift_x = load<V>(g.drift);
  const V drift_y = load<V>(g.drift + width);
  const FlowRows<V, parallel_flow> flow(g.flow);
  const auto finish = [&](int a, V zx, V zy) {
    const V x = load<V>(g.x + a * width);
    const V y = load<V>(g.y + a * width);
    const V mx = load<V>(g.memory_x + a * width);
    const V my = load<V>(g.memory_y + a * width);
    const V dx = mx - drift_x;
    const V dy = my - drift_y;
    const V sx = zx + rotation_part * (y + dy);
    const V sy = zy - rotation_part * (x + dx);
    const V new_dx = dx + sx;
    const V new_dy = dy + sy;
    const V new_x = x + move * new_dx;
    const V new_y = y + move * new_dy;
    store(g.x + a * width, new_x);
    store(g.y + a * width, new_y);
    store(g.memory_x + a * width, mx + sx);
    store(g.memory_y + a * width, my + sy);
    const V px = new_x + new_dx;
    const V py = new_y + new_dy;
    area_sum += px * yn - xn * py;
    xn = px;
    yn = py;
    // The mirror moves from one prediction to the next.
    V vx, vy;
    flow.velocity(x + dx, y + dy, vx, vy);
    const V slip_x = (new_dx + sx) - vx;
    const V slip_y = (new_dy + sy) - vy;
    largest = larger(largest, slip_x * slip_x + slip_y * slip_y);
  };
  V bx[2], by[2];
  for (int k = 0; k < 2; ++k) {
    const V* const zr = k == 0 ? zr1 : zr2;
    const V* const zg = k == 0 ? zg1 : zg2;
    const V* const zh = k == 0 ? zh1 : zh2;
    bx[k] = zr[0] - pressure_part * zg[0] + rotation_part * zh[0];
    by[k] = zr[1] - pressure_part * zg[1] + rotation_part * zh[1];
  }
  finish(n - 1, bx[1], by[1]);
  const V last_x = xn;
  const V last_y = yn;
  finish(n - 2, bx[0], by[0]);
  for (int a = n - 3; a >= 0; --a) {
    const OperatorNode<V>& node = nodes[a];
    const V zx = node.r[0] - pressure_part * node.g[0] + rotation_part * node.h[0] -
                 node.w1 * bx[0] - node.w2 * bx[1] - node.m1 * z1x - node.m2 * z2x;
    const V zy = node.r[1] - pressure_part * node.g[1] + rotation_part * node.h[1] -
                 node.w1 * by[0] - node.w2 * by[1] - node.m1 * z1y - node.m2 * z2y;
    z2x = z1x;
    z2y = z1y;
    z1x = zx;
    z1y = zy;
    finish(a, zx, zy);
  }
  // The first term of the sum was void, and the segment from the last node to the first is missing.
  area_sum += last_x * yn - xn * last_y;
  store(g.area, static_cast<Real>(0.5) * area_sum);
  store(g.extremes + 2 * width, largest);
}
