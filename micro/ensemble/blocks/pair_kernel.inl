// Contacts of the clusters of a block with those of other cells, 4 x 4 pairs of nodes for an entry
// of the list, in the order of the list. Every cluster collects the forces on itself: nothing is
// scattered to other cells.
//
// A vector holds all four nodes of the cluster, once for each of as many nodes of the other as it
// has room for: entry j * 4 + i belongs to node i and node j of the other.

template <class Real>
struct PairLanes;

#if defined(__AVX512F__)
template <>
struct PairLanes<float> {
  using Vector = Single;
  static constexpr int others = 4;
  HEMOSCALE_LANES static Vector own(const float* p) {
    return reinterpret_cast<Vector>(_mm512_maskz_broadcast_f32x4(0xffff, _mm_loadu_ps(p)));
  }
  HEMOSCALE_LANES static Vector other(const float* p, int) {
    const __m512i each = _mm512_setr_epi32(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3);
    return reinterpret_cast<Vector>(_mm512_maskz_permutevar_ps(
        0xffff, _mm512_maskz_broadcast_f32x4(0xffff, _mm_loadu_ps(p)), each));
  }
  HEMOSCALE_LANES static Quad<float> sum(Vector v) {
    const auto half = __builtin_shufflevector(v, v, 0, 1, 2, 3, 4, 5, 6, 7) +
                      __builtin_shufflevector(v, v, 8, 9, 10, 11, 12, 13, 14, 15);
    return __builtin_shufflevector(half, half, 0, 1, 2, 3) +
           __builtin_shufflevector(half, half, 4, 5, 6, 7);
  }
};
template <>
struct PairLanes<double> {
  using Vector = Double;
  static constexpr int others = 2;
  HEMOSCALE_LANES static Vector own(const double* p) {
    return reinterpret_cast<Vector>(_mm512_maskz_broadcast_f64x4(0xff, _mm256_loadu_pd(p)));
  }
  HEMOSCALE_LANES static Vector other(const double* p, int first) {
    const __m512i each =
        _mm512_add_epi64(_mm512_setr_epi64(0, 0, 0, 0, 1, 1, 1, 1), _mm512_set1_epi64(first));
    return reinterpret_cast<Vector>(_mm512_maskz_permutexvar_pd(
        0xff, each, _mm512_maskz_broadcast_f64x4(0xff, _mm256_loadu_pd(p))));
  }
  HEMOSCALE_LANES static Quad<double> sum(Vector v) {
    return __builtin_shufflevector(v, v, 0, 1, 2, 3) + __builtin_shufflevector(v, v, 4, 5, 6, 7);
  }
};
#else
template <class Real>
struct PairLanes {
  using Vector = Quad<Real>;
  static constexpr int others = 1;
  HEMOSCALE_LANES static Vector own(const Real* p) {
    Vector v;
    __builtin_memcpy(&v, p, sizeof v);
    return v;
  }
  HEMOSCALE_LANES static Vector other(const Real* p, int first) { return Vector{} + p[first]; }
  HEMOSCALE_LANES static Vector sum(Vector v) { return v; }
};
#endif

template <class Real>
HEMOSCALE_LANES void set_lane(Real* row, int width, int count, Quad<Real> v) {
  for (int i = 0; i < count; ++i) row[i * width] = v[i];
}

enum class PairStiffness {
  none,
  diagonal_blocks,  // the part of dF/dx on the diagonal: three numbers per node
  bound             // twice the sum of its largest eigenvalues: one number per node
};

template <PairStiffness stiffness, class Real>
HEMOSCALE_LANES void collect(const PairArguments<Real>& g, size_t place, int count, Quad<Real> fx,
                             Quad<Real> fy, Quad<Real> kxx, Quad<Real> kxy, Quad<Real> kyy) {
  constexpr int width = Lanes<Real>::width;
  set_lane<Real>(g.force_x + place, width, count, fx);
  set_lane<Real>(g.force_y + place, width, count, fy);
  if constexpr (stiffness == PairStiffness::bound) {
    set_lane<Real>(g.stiffness_xx + place, width, count, 4 * kxx);
  }
  if constexpr (stiffness == PairStiffness::diagonal_blocks) {
    set_lane<Real>(g.stiffness_xx + place, width, count, kxx);
    set_lane<Real>(g.stiffness_xy + place, width, count, kxy);
    set_lane<Real>(g.stiffness_yy + place, width, count, kyy);
  }
}

// With s = d.d: F = f d and, where it is positive, the part -2 (df/ds) d d' of the stiffness
// -dF/dx.
template <class Real, class Law, PairStiffness stiffness>
HEMOSCALE_LANES void contact_forces(const PairArguments<Real>& g) {
  constexpr int width = Lanes<Real>::width;
  using Pair = PairLanes<Real>;
  using P = typename Pair::Vector;
  const P zero = P{};
  std::uint32_t entry = g.first_entry;
  for (std::uint32_t k = 0; k < g.active_count; ++k) {
    const ActiveCluster active = g.active[k];
    const Real* own =
        g.mirror + 8 * (static_cast<size_t>(g.first_cluster[active.lane]) + active.cluster);
    const P xi = Pair::own(own);
    const P yi = Pair::own(own + 4);
    P fx = zero, fy = zero, kxx = zero, kxy = zero, kyy = zero;
    for (; entry < active.end; ++entry) {
      const ClusterEntry e = g.entries[entry];
      const Real* other = g.mirror + 8 * static_cast<size_t>(e.other);
      const Real* shift = g.shifts + 2 * static_cast<size_t>(e.shift);
      for (int j = 0; j < cluster_nodes; j += Pair::others) {
        const P dx = xi - (Pair::other(other, j) + shift[0]);
        const P dy = yi - (Pair::other(other + 4, j) + shift[1]);
        const P s = dx * dx + dy * dy;
        const auto [f, slope] = Law::at(g, s);
        fx += f * dx;
        fy += f * dy;
        if constexpr (stiffness == PairStiffness::bound) {
          kxx += (slope > 0 ? slope : zero) * s;
        }
        if constexpr (stiffness == PairStiffness::diagonal_blocks) {
          const P k2 = slope > 0 ? slope + slope : zero;
          const P kx = k2 * dx;
          const P ky = k2 * dy;
          kxx += kx * dx;
          kxy += kx * dy;
          kyy += ky * dy;
        }
      }
    }
    const int first = active.cluster * cluster_nodes;
    const int count = g.nodes - first < cluster_nodes ? g.nodes - first : cluster_nodes;
    const size_t place = static_cast<size_t>(first) * width + active.lane;
    if (count == cluster_nodes) {
      collect<stiffness, Real>(g, place, cluster_nodes, Pair::sum(fx), Pair::sum(fy),
                               Pair::sum(kxx), Pair::sum(kxy), Pair::sum(kyy));
    } else {
      collect<stiffness, Real>(g, place, count, Pair::sum(fx), Pair::sum(fy), Pair::sum(kxx),
                               Pair::sum(kxy), Pair::sum(kyy));
    }
  }
}
