// Writes the nodes of every cell of a block one after the other, in clusters of x0..x3, y0..y3.
// Nodes that the last cluster lacks are put far away.

template <class Real>
inline constexpr Real far_away = static_cast<Real>(1e5);  // [um]

HEMOSCALE_LANES void transpose_store(Single a, Single b, Single c, Single d,
                                     float* const (&out)[16]) {
  // Lane l of each 128-bit part meets lane l of the others: 4 x 4 blocks.
  const Single ab0 =
      __builtin_shufflevector(a, b, 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28, 13, 29);
  const Single ab1 =
      __builtin_shufflevector(a, b, 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27, 14, 30, 15, 31);
  const Single cd0 =
      __builtin_shufflevector(c, d, 0, 16, 1, 17, 4, 20, 5, 21, 8, 24, 9, 25, 12, 28, 13, 29);
  const Single cd1 =
      __builtin_shufflevector(c, d, 2, 18, 3, 19, 6, 22, 7, 23, 10, 26, 11, 27, 14, 30, 15, 31);
  const Single r[4] = {
      __builtin_shufflevector(ab0, cd0, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29),
      __builtin_shufflevector(ab0, cd0, 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30, 31),
      __builtin_shufflevector(ab1, cd1, 0, 1, 16, 17, 4, 5, 20, 21, 8, 9, 24, 25, 12, 13, 28, 29),
      __builtin_shufflevector(ab1, cd1, 2, 3, 18, 19, 6, 7, 22, 23, 10, 11, 26, 27, 14, 15, 30,
                              31)};
  for (int k = 0; k < 4; ++k) {
    const Quad<float> p0 = __builtin_shufflevector(r[k], r[k], 0, 1, 2, 3);
    const Quad<float> p1 = __builtin_shufflevector(r[k], r[k], 4, 5, 6, 7);
    const Quad<float> p2 = __builtin_shufflevector(r[k], r[k], 8, 9, 10, 11);
    const Quad<float> p3 = __builtin_shufflevector(r[k], r[k], 12, 13, 14, 15);
    __builtin_memcpy(out[k], &p0, sizeof p0);
    __builtin_memcpy(out[4 + k], &p1, sizeof p1);
    __builtin_memcpy(out[8 + k], &p2, sizeof p2);
    __builtin_memcpy(out[12 + k], &p3, sizeof p3);
  }
}
HEMOSCALE_LANES void transpose_store(Double a, Double b, Double c, Double d,
                                     double* const (&out)[8]) {
  for (size_t k = 0; k < 8; ++k) {
    const Quad<double> q = {a[k], b[k], c[k], d[k]};
    __builtin_memcpy(out[k], &q, sizeof q);
  }
}

template <class Real, bool predicted>
HEMOSCALE_LANES void write_mirror(const MirrorArguments<Real>& g) {
  using V = typename Lanes<Real>::Vector;
  constexpr size_t width = Lanes<Real>::width;
  Real* out_x[width];
  Real* out_y[width];
  for (size_t k = 0; k < width; ++k) {
    out_x[k] = g.mirror + 8 * static_cast<size_t>(g.first_cluster[k]);
    out_y[k] = out_x[k] + 4;
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
    transpose_store(x[0], x[1], x[2], x[3], out_x);
    transpose_store(y[0], y[1], y[2], y[3], out_y);
    for (size_t k = 0; k < width; ++k) {
      out_x[k] += 8;
      out_y[k] += 8;
    }
  }
}
