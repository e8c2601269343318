// Writes the nodes of every cell of a block one after the other, in clusters of x0..x3, y0..y3.
// Nodes that the last cluster lacks are put far away.

template <class Real>
inline constexpr Real far_away = static_cast<Real>(1e5);  // [um]

// Four nodes of every lane, rows to columns. Lane l of each 128-bit part meets lane l of the
// others: 4 x 4 blocks; entry k holds what belongs to the lanes k, 4 + k, 8 + k and 12 + k.
struct FourRows {
  Single lane[4];
};
HEMOSCALE_LANES FourRows transpose(const Single (&v)[4]) {
  const Single ab0 =
      __builtin_shufflevector(v[0], v[1], 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28, 13, 29);
  const Single ab1 = __builtin_shufflevector(v[0], v[1], 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27,
                                             14, 30, 15, 31);
  const Single cd0 =
      __builtin_shufflevector(v[2], v[3], 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28, 13, 29);
  const Single cd1 = __builtin_shufflevector(v[2], v[3], 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27,
                                             14, 30, 15, 31);
  return {
      {__builtin_shufflevector(ab0, cd0, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29),
       __builtin_shufflevector(ab0, cd0, 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30,
                               31),
       __builtin_shufflevector(ab1, cd1, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29),
       __builtin_shufflevector(ab1, cd1, 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30,
                               31)}};
}

// Both coordinates of a cluster lie side by side: one store for each cell.
HEMOSCALE_LANES void store_clusters(const Single (&x)[4], const Single (&y)[4],
                                    float* const (&cells)[16], size_t at) {
  const FourRows rx = transpose(x);
  const FourRows ry = transpose(y);
  for (int k = 0; k < 4; ++k) {
    const Single near = __builtin_shufflevector(rx.lane[k], ry.lane[k], 0, 1, 2, 3, 16, 17, 18, 19,
                                                4, 5, 6, 7, 20, 21, 22, 23);
    const Single far = __builtin_shufflevector(rx.lane[k], ry.lane[k], 8, 9, 10, 11, 24, 25, 26, 27,
                                               12, 13, 14, 15, 28, 29, 30, 31);
    const auto p0 = __builtin_shufflevector(near, near, 0, 1, 2, 3, 4, 5, 6, 7);
    const auto p1 = __builtin_shufflevector(near, near, 8, 9, 10, 11, 12, 13, 14, 15);
    const auto p2 = __builtin_shufflevector(far, far, 0, 1, 2, 3, 4, 5, 6, 7);
    const auto p3 = __builtin_shufflevector(far, far, 8, 9, 10, 11, 12, 13, 14, 15);
    __builtin_memcpy(cells[k] + at, &p0, sizeof p0);
    __builtin_memcpy(cells[4 + k] + at, &p1, sizeof p1);
    __builtin_memcpy(cells[8 + k] + at, &p2, sizeof p2);
    __builtin_memcpy(cells[12 + k] + at, &p3, sizeof p3);
  }
}
HEMOSCALE_LANES void store_clusters(const Double (&x)[4], const Double (&y)[4],
                                    double* const (&cells)[8], size_t at) {
  for (size_t k = 0; k < 8; ++k) {
    const Double both = {x[0][k], x[1][k], x[2][k], x[3][k], y[0][k], y[1][k], y[2][k], y[3][k]};
    __builtin_memcpy(cells[k] + at, &both, sizeof both);
  }
}

template <class Real, bool predicted>
HEMOSCALE_LANES void write_mirror(const MirrorArguments<Real>& g) {
  using V = typename Lanes<Real>::Vector;
  constexpr size_t width = Lanes<Real>::width;
  Real* cells[width];
  for (size_t k = 0; k < width; ++k) {
    cells[k] = g.mirror + 8 * static_cast<size_t>(g.first_cluster[k]);
  }
  const V away = V{} + far_away<Real>;
  const V drift_x = predicted ? load<V>(g.drift) : V{};
  const V drift_y = predicted ? load<V>(g.drift + width) : V{};
  for (int first = 0; first < g.nodes; first += cluster_nodes) {
    V x[4], y[4];
    for (int i = 0; i < cluster_nodes; ++i) {
      const bool exists = first + i < g.nodes;
      const size_t place = static_cast<size_t>(first + i) * width;
      x[i] = exists ? load<V>(g.x + place) : away;
      y[i] = exists ? load<V>(g.y + place) : away;
      if (predicted && exists) {
        x[i] += load<V>(g.add_x + place) - drift_x;
        y[i] += load<V>(g.add_y + place) - drift_y;
      }
    }
    store_clusters(x, y, cells, 2 * static_cast<size_t>(first));
  }
}
