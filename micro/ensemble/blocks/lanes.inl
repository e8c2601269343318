// Vectors of 64 bytes: 16 single or 8 double numbers. The compiler turns them into the widest
// registers of the instruction set that a file is compiled for, so that all versions share one
// layout in memory.
//
// This file is compiled several times with different instruction sets, inside a namespace of its
// version. Everything in it is inlined by force: no symbol of a wider version can be chosen by the
// linker for a narrower one.

constexpr int lane_bytes = 64;

template <class Real>
struct Lanes {
  static constexpr int width = lane_bytes / static_cast<int>(sizeof(Real));
  using Vector [[gnu::vector_size(64)]] = Real;
};

using Single = Lanes<float>::Vector;
using Double = Lanes<double>::Vector;

#define HEMOSCALE_LANES [[gnu::always_inline]] inline

template <class V>
struct LaneTypeOf;
template <>
struct LaneTypeOf<Single> {
  using Type = float;
};
template <>
struct LaneTypeOf<Double> {
  using Type = double;
};
template <class V>
using LaneType = typename LaneTypeOf<V>::Type;

template <class V, class Real>
HEMOSCALE_LANES V load(const Real* p) {
  return *reinterpret_cast<const V*>(p);
}
template <class V, class Real>
HEMOSCALE_LANES void store(Real* p, V v) {
  *reinterpret_cast<V*>(p) = v;
}
template <class V>
HEMOSCALE_LANES V larger(V a, V b) {
  return a > b ? a : b;
}
template <class V>
HEMOSCALE_LANES V smaller(V a, V b) {
  return a < b ? a : b;
}

// Whether any lane exceeds a limit.
HEMOSCALE_LANES bool any_above(Single v, float limit) {
#if defined(__AVX512F__)
  return _mm512_cmp_ps_mask(reinterpret_cast<__m512>(v), _mm512_set1_ps(limit), _CMP_GT_OQ) != 0;
#else
  bool any = false;
  for (int k = 0; k < Lanes<float>::width; ++k) any |= v[k] > limit;
  return any;
#endif
}
HEMOSCALE_LANES bool any_above(Double v, double limit) {
#if defined(__AVX512F__)
  return _mm512_cmp_pd_mask(reinterpret_cast<__m512d>(v), _mm512_set1_pd(limit), _CMP_GT_OQ) != 0;
#else
  bool any = false;
  for (int k = 0; k < Lanes<double>::width; ++k) any |= v[k] > limit;
  return any;
#endif
}

// 1/x and 1/sqrt(x). With wide instructions an estimate is refined by one or two steps of Newton's
// method, to about one unit in the last place; narrower versions divide.
HEMOSCALE_LANES Single reciprocal(Single x) {
#if defined(__AVX512F__)
  const Single r =
      reinterpret_cast<Single>(_mm512_maskz_rcp14_ps(0xffff, reinterpret_cast<__m512>(x)));
  return r + r * (1.0F - x * r);
#else
  return 1.0F / x;
#endif
}
HEMOSCALE_LANES Double reciprocal(Double x) {
  return 1.0 / x;
}
HEMOSCALE_LANES Single reciprocal_root(Single x) {
#if defined(__AVX512F__)
  const Single r =
      reinterpret_cast<Single>(_mm512_maskz_rsqrt14_ps(0xffff, reinterpret_cast<__m512>(x)));
  return r + (0.5F * r) * (1.0F - (x * r) * r);
#else
  alignas(lane_bytes) float root[Lanes<float>::width];
  store(root, x);
  for (float& v : root) v = __builtin_sqrtf(v);
  return 1.0F / load<Single>(root);
#endif
}
HEMOSCALE_LANES Double reciprocal_root(Double x) {
#if defined(__AVX512F__)
  return 1.0 / reinterpret_cast<Double>(_mm512_maskz_sqrt_pd(0xff, reinterpret_cast<__m512d>(x)));
#else
  alignas(lane_bytes) double root[Lanes<double>::width];
  store(root, x);
  for (double& v : root) v = __builtin_sqrt(v);
  return 1.0 / load<Double>(root);
#endif
}
