// The given flow relative to the frame of a cell, and the walls of a plane channel.

template <class V, bool parallel>
struct FlowRows;

// u = (c1 y + c2 y^2, 0): any flow along x that varies with y alone, to second order.
template <class V>
struct FlowRows<V, true> {
  V linear, square;
  template <class Real>
  HEMOSCALE_LANES explicit FlowRows(const Real* rows)
      : linear(load<V>(rows + Lanes<Real>::width)),
        square(load<V>(rows + 6 * Lanes<Real>::width)) {}
  HEMOSCALE_LANES void velocity(V, V y, V& vx, V& vy) const {
    vx = y * (linear + square * y);
    vy = V{};
  }
};

template <class V>
struct FlowRows<V, false> {
  V row[10];
  template <class Real>
  HEMOSCALE_LANES explicit FlowRows(const Real* rows) {
    for (int k = 0; k < 10; ++k) row[k] = load<V>(rows + k * Lanes<Real>::width);
  }
  HEMOSCALE_LANES void velocity(V x, V y, V& vx, V& vy) const {
    vx = x * (row[0] + row[4] * x + row[5] * y) + y * (row[1] + row[6] * y);
    vy = x * (row[2] + row[7] * x + row[8] * y) + y * (row[3] + row[9] * y);
  }
};

// Harmonic repulsion within the range of a wall, see micro/ensemble/wall_potential.hpp.
template <class V, class Real>
HEMOSCALE_LANES void add_walls(const PlaneWalls<Real>& walls, V height, V& load_y,
                               V& stiffness_yy) {
  const V zero = V{};
  const V below = walls.range - height;
  const V above = walls.range - (walls.height - height);
  load_y += walls.stiffness * (larger(below, zero) - larger(above, zero));
  const V k = zero + walls.stiffness;
  stiffness_yy += (below > 0 ? k : zero) + (above > 0 ? k : zero);
}
