// One linearly implicit step of every ring of a block (Rosenbrock-Euler):
//
//   (I + tau K) d = dt [u(x) - u(frame)] + tau [F_ring + F_contact + F_wall],   x += d
//
// K is the full second derivative of the membrane's energy at x, so that rigid rotations meet no
// resistance but that of the forces; contacts and walls enter with the part of theirs that lies on
// the diagonal.
//
// The ring is cut at node 0, which is doubled: a chain of nodes 0, 1, ..., N, where 0 and N share
// the forces and drag of the node. Four unknowns close it: two components of the force that keeps
// the ends together (columns 0, 1), the bending moment across the cut (2), and the change of
// pressure by the area law (3):
//
//   A d + W l = r,    W' d = D l,   D = diag(0, 0, 1/(tau kappa/l0), A0/(tau k_A)),
//
// hence (W' A^-1 W + D) l = W' A^-1 r. Block elimination of A from node 0 to N gives both products
// on the way. Per segment e_a = d_(a+1) - d_a the energy has the blocks
//
//   H_aa     = E/l0 t t' + [T/l + (S_a + S_(a+1)) q^2] n n' - m q^2 (t n' + n t'),
//   H_a,a+1  = -S_(a+1) q_a q_(a+1) n_a n_(a+1)',
//
// with tension T, slopes S of the moments M, m_a = M_a - M_(a+1), q = 1/l: the coupling of nodes
// two apart has rank one, with p = q n.

template <class V>
struct ChainNode {  // what the back substitution needs; 18 vectors
  V ux, uy;
  V qxx, qxy, qyx, qyy;
  V rx, ry;
  V wx[4], wy[4];
  V px, py;
};

// Symmetric positive definite system of four unknowns, in place: G row by row below the diagonal.
// To the last two diagonal entries belong 1/k besides, for stiffnesses k that may be zero.
template <class V>
HEMOSCALE_LANES void solve_four(V (&g)[10], const V (&k)[2], V (&b)[4]) {
  V a[4][4];
  V inverse[4];
  for (int c = 0, e = 0; c < 4; ++c)
    for (int d = 0; d <= c; ++d, ++e) a[c][d] = g[e];
  for (int c = 0; c < 4; ++c) {
    inverse[c] = c < 2 ? reciprocal(a[c][c]) : k[c - 2] * reciprocal(1 + k[c - 2] * a[c][c]);
    for (int r = c + 1; r < 4; ++r) {
      const V l = a[r][c] * inverse[c];
      for (int d = c + 1; d <= r; ++d) a[r][d] -= l * a[d][c];
      b[r] -= l * b[c];
    }
  }
  for (int c = 3; c >= 0; --c) {
    V v = b[c];
    for (int r = c + 1; r < 4; ++r) v -= a[r][c] * b[r];
    b[c] = v * inverse[c];
  }
}

template <class Real, class Bending, bool parallel_flow, bool walls>
HEMOSCALE_LANES void implicit_ring(const BlockArguments<Real>& g) {
  using V = typename Lanes<Real>::Vector;
  constexpr int width = Lanes<Real>::width;
  const RingTables<Real>& ring = *g.ring;
  const int n = ring.nodes;
  const auto x_of = [&](int i) { return load<V>(g.x + i * width); };
  const auto y_of = [&](int i) { return load<V>(g.y + i * width); };
  const V zero = V{};
  const V one = zero + 1;
  const V pressure = -ring.area * (load<V>(g.area) - ring.rest_area);
  const V half_pressure = static_cast<Real>(0.5) * pressure;
  const FlowRows<V, parallel_flow> flow(g.flow);
  const V frame_y = walls ? load<V>(g.frame_y) : zero;

  const V x0 = x_of(0);
  const V y0 = y_of(0);
  V xa = x0;
  V ya = y0;
  V xb = x_of(1);
  V yb = y_of(1);
  Segment<V> s = segment<V>(x0, y0, xb, yb);
  V px = -s.ty * s.q;
  V py = s.tx * s.q;
  const Moment<V> closing =
      Bending::moment(half_tangent(segment<V>(x_of(n - 1), y_of(n - 1), x0, y0), s),
                      ring.bending[0], ring.natural[0]);
  V moment = closing.value;

  // Of the segment before: force, vector, second derivative, S p.
  V fx0 = zero, fy0 = zero, ex0 = zero, ey0 = zero;
  V hxx0 = zero, hxy0 = zero, hyy0 = zero;
  V px0 = zero, py0 = zero, slope0 = zero;
  V spx = zero, spy = zero;  // S_a p_a, with the slope at the node before the segment
  // What the elimination of the nodes before leaves: in the diagonal of this node and, as multiples
  // of p_a p_a', of the next; in the coupling to the next, R p_a'; in right-hand side and columns.
  V dxx = zero, dxy = zero, dyy = zero, d2 = zero;
  V rx = zero, ry = zero;
  V bx = zero, by = zero, b2 = zero;
  V wx[4] = {one, zero, -px, zero};
  V wy[4] = {zero, one, -py, zero};
  V w2[4] = {zero, zero, one, zero};
  V gram[10];
  for (V& v : gram) v = zero;
  V load_sum[4] = {zero, zero, zero, zero};
  V shortened = one;
  V stretched = one;
  auto* node = reinterpret_cast<ChainNode<V>*>(g.scratch);

  for (int a = 0; a < n; ++a, ++node) {
    const bool last = a + 1 == n;
    Segment<V> next = s;
    V next_moment = closing.value;
    V slope = zero;
    const V xi = xa;
    const V yi = ya;
    if (!last) {
      const int k = a + 2 == n ? 0 : a + 2;
      xa = xb;
      ya = yb;
      xb = x_of(k);
      yb = y_of(k);
      next = segment<V>(xa, ya, xb, yb);
      const Moment<V> bend =
          Bending::moment(half_tangent(s, next), ring.bending[a + 1], ring.natural[a + 1]);
      next_moment = bend.value;
      slope = bend.slope;
    }
    const V npx = -next.ty * next.q;
    const V npy = next.tx * next.q;
    const V m = moment - next_moment;
    const Real rest = ring.inverse_rest[a];
    const Real l_rest = ring.rest[a];
    const Real stiff = ring.stretch * rest;
    const V relative = s.q * ring.stretch;
    const V ratio = stiff - relative;  // tension over length
    const V fx = ratio * s.ex + m * px;
    const V fy = ratio * s.ey + m * py;
    const V shortening = s.q * l_rest;  // l0 / l
    shortened = larger(shortened, shortening);
    stretched = smaller(stretched, shortening);
    // H_aa in the frame of the segment: along, across, mixed; turned with t = (c, s).
    const V q2 = s.q * s.q;
    const V across = ratio + (slope0 + slope) * q2;
    const V mixed = m * q2;
    const V difference = stiff - across;
    const V c2 = s.tx * s.tx;
    const V cs = s.tx * s.ty;
    const V cos2 = c2 + c2 - 1;
    const V hxx = across + difference * c2 + (mixed + mixed) * cs;
    const V hxy = difference * cs - mixed * cos2;
    const V hyy = (stiff + across) - hxx;

    const Real share = a == 0 ? static_cast<Real>(0.5) : static_cast<Real>(1);
    const V gx = static_cast<Real>(0.5) * (ey0 + s.ey);
    const V gy = static_cast<Real>(-0.5) * (ex0 + s.ex);
    V vx, vy;
    flow.velocity(xi, yi, vx, vy);
    V loadx = load<V>(g.force_x + a * width) + vx;
    V loady = load<V>(g.force_y + a * width) + vy;
    V cxx = load<V>(g.stiffness_xx + a * width);
    V cxy = load<V>(g.stiffness_xy + a * width);
    V cyy = load<V>(g.stiffness_yy + a * width);
    if constexpr (walls) add_walls(g.walls, frame_y + yi, loady, cyy);
    const V kx = share * loadx + (fx - fx0) + pressure * gx - bx;
    const V ky = share * loady + (fy - fy0) + pressure * gy - by;
    const V pxx = share * (cxx + 1) + hxx0 + hxx + 2 * (px0 * spx) - dxx;
    const V pxy = share * cxy + hxy0 + hxy + (px0 * spy + py0 * spx) - dxy;
    const V pyy = share * (cyy + 1) + hyy0 + hyy + 2 * (py0 * spy) - dyy;
    const V inverse = reciprocal(pxx * pyy - pxy * pxy);
    const V ixx = pyy * inverse;
    const V ixy = -pxy * inverse;
    const V iyy = pxx * inverse;

    // Coupling to the next node, -H_aa + H_(a-1)a + H_a(a+1) and the turning of the pressure.
    const V jx = slope0 * px0 + rx;
    const V jy = slope0 * py0 + ry;
    const V snx = slope * npx;
    const V sny = slope * npy;
    const V bxx = -hxx - jx * px - px * snx;
    const V bxy = -hxy - jx * py - px * sny - half_pressure;
    const V byx = -hxy - jy * px - py * snx + half_pressure;
    const V byy = -hyy - jy * py - py * sny;

    const V ux = ixx * kx + ixy * ky;
    const V uy = ixy * kx + iyy * ky;
    const V qxx = ixx * bxx + ixy * byx;
    const V qxy = ixx * bxy + ixy * byy;
    const V qyx = ixy * bxx + iyy * byx;
    const V qyy = ixy * bxy + iyy * byy;
    const V qx = ixx * px + ixy * py;
    const V qy = ixy * px + iyy * py;
    wx[3] += gx;
    wy[3] += gy;
    if (last) {
      wx[2] += px;
      wy[2] += py;
    }
    V tx[4], ty[4];
    for (int c = 0; c < 4; ++c) {
      tx[c] = ixx * wx[c] + ixy * wy[c];
      ty[c] = ixy * wx[c] + iyy * wy[c];
      node->wx[c] = tx[c];
      node->wy[c] = ty[c];
    }
    for (int c = 0, e = 0; c < 4; ++c) {
      for (int d = 0; d <= c; ++d, ++e) gram[e] += wx[c] * tx[d] + wy[c] * ty[d];
      load_sum[c] += wx[c] * ux + wy[c] * uy;
    }
    node->ux = ux;
    node->uy = uy;
    node->qxx = qxx;
    node->qxy = qxy;
    node->qyx = qyx;
    node->qyy = qyy;
    node->rx = slope * qx;
    node->ry = slope * qy;
    node->px = px;
    node->py = py;

    // Elimination of this node from the next two.
    const V d2px = d2 * px;
    dxx = bxx * qxx + byx * qyx + d2px * px;
    dxy = bxx * qxy + byx * qyy + d2px * py;
    dyy = bxy * qxy + byy * qyy + d2 * py * py;
    d2 = slope * slope * (px * qx + py * qy);
    rx = slope * (bxx * qx + byx * qy);
    ry = slope * (bxy * qx + byy * qy);
    bx = bxx * ux + byx * uy + b2 * px;
    by = bxy * ux + byy * uy + b2 * py;
    b2 = slope * (px * ux + py * uy);
    for (int c = 0; c < 4; ++c) {
      wx[c] = w2[c] * px - (bxx * tx[c] + byx * ty[c]);
      wy[c] = w2[c] * py - (bxy * tx[c] + byy * ty[c]);
      w2[c] = -slope * (px * tx[c] + py * ty[c]);
    }
    fx0 = fx;
    fy0 = fy;
    ex0 = s.ex;
    ey0 = s.ey;
    hxx0 = hxx;
    hxy0 = hxy;
    hyy0 = hyy;
    px0 = px;
    py0 = py;
    slope0 = slope;
    spx = snx;
    spy = sny;
    moment = next_moment;
    s = next;
    px = npx;
    py = npy;
  }
  // Node N, the other half of node 0.
  V dx1, dy1;
  {
    const V gx = static_cast<Real>(0.5) * ey0;
    const V gy = static_cast<Real>(-0.5) * ex0;
    V vx, vy;
    flow.velocity(x0, y0, vx, vy);
    V loadx = load<V>(g.force_x) + vx;
    V loady = load<V>(g.force_y) + vy;
    V cxx = load<V>(g.stiffness_xx);
    V cxy = load<V>(g.stiffness_xy);
    V cyy = load<V>(g.stiffness_yy);
    if constexpr (walls) add_walls(g.walls, frame_y + y0, loady, cyy);
    constexpr Real half = static_cast<Real>(0.5);
    const V kx = half * loadx - fx0 + pressure * gx - bx;
    const V ky = half * loady - fy0 + pressure * gy - by;
    const V pxx = half * (cxx + 1) + hxx0 - dxx;
    const V pxy = half * cxy + hxy0 - dxy;
    const V pyy = half * (cyy + 1) + hyy0 - dyy;
    const V inverse = reciprocal(pxx * pyy - pxy * pxy);
    const V ixx = pyy * inverse;
    const V ixy = -pxy * inverse;
    const V iyy = pxx * inverse;
    wx[0] -= 1;
    wy[1] -= 1;
    wx[2] -= px0;
    wy[2] -= py0;
    wx[3] += gx;
    wy[3] += gy;
    const V ux = ixx * kx + ixy * ky;
    const V uy = ixy * kx + iyy * ky;
    V tx[4], ty[4];
    for (int c = 0; c < 4; ++c) {
      tx[c] = ixx * wx[c] + ixy * wy[c];
      ty[c] = ixy * wx[c] + iyy * wy[c];
    }
    for (int c = 0, e = 0; c < 4; ++c) {
      for (int d = 0; d <= c; ++d, ++e) gram[e] += wx[c] * tx[d] + wy[c] * ty[d];
      load_sum[c] += wx[c] * ux + wy[c] * uy;
    }
    const V stiffness[2] = {closing.slope, zero + ring.area};
    solve_four(gram, stiffness, load_sum);
    dx1 = ux;
    dy1 = uy;
    for (int c = 0; c < 4; ++c) {
      dx1 -= tx[c] * load_sum[c];
      dy1 -= ty[c] * load_sum[c];
    }
  }
  V dx2 = zero, dy2 = zero, px2 = zero, py2 = zero;
  V area = zero;
  V xn = x0 + dx1;
  V yn = y0 + dy1;
  V largest = zero;
  for (int a = n - 1; a >= 0; --a) {
    --node;
    const V w = px2 * dx2 + py2 * dy2;
    V dx = node->ux - node->qxx * dx1 - node->qxy * dy1 - node->rx * w;
    V dy = node->uy - node->qyx * dx1 - node->qyy * dy1 - node->ry * w;
    for (int c = 0; c < 4; ++c) {
      dx -= node->wx[c] * load_sum[c];
      dy -= node->wy[c] * load_sum[c];
    }
    const V xi = x_of(a);
    const V yi = y_of(a);
    const V xv = xi + dx;
    const V yv = yi + dy;
    store(g.x + a * width, xv);
    store(g.y + a * width, yv);
    area += xv * yn - xn * yv;
    V vx, vy;
    flow.velocity(xi, yi, vx, vy);
    const V slip_x = dx - vx;
    const V slip_y = dy - vy;
    largest = larger(largest, slip_x * slip_x + slip_y * slip_y);
    xn = xv;
    yn = yv;
    dx2 = dx1;
    dy2 = dy1;
    dx1 = dx;
    dy1 = dy;
    px2 = node->px;
    py2 = node->py;
  }
  store(g.area, static_cast<Real>(0.5) * area);
  store(g.extremes, stretched);
  store(g.extremes + width, shortened);
  store(g.extremes + 2 * width, largest);
}
