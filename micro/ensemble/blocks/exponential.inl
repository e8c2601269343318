// Functions on vectors of any width.

template <class Real>
using Quad [[gnu::vector_size(4 * sizeof(Real))]] = Real;

// exp(x) for vectors of any width, |x| <= 80: x = k ln 2 + f with |f| <= ln(2)/2, Taylor's series
// of exp(f), and k added to the exponent. Relative error 1e-7 and 3e-16.

template <class P>
struct IntegersOf;
template <class P>
requires(sizeof(P{}[0]) == sizeof(float)) struct IntegersOf<P> {
  using Vector [[gnu::vector_size(sizeof(P))]] = std::int32_t;
};
template <class P>
requires(sizeof(P{}[0]) == sizeof(double)) struct IntegersOf<P> {
  using Vector [[gnu::vector_size(sizeof(P))]] = std::int64_t;
};

template <class Real, class P>
HEMOSCALE_LANES P exponential(P x) {
  constexpr bool single = sizeof(Real) == sizeof(float);
  constexpr Real per_ln2 = static_cast<Real>(1.4426950408889634);
  // ln 2 in two parts, of which the first times a small integer is exact.
  constexpr Real ln2_high =
      single ? static_cast<Real>(0.693359375) : static_cast<Real>(0.693147180369123816490);
  constexpr Real ln2_low =
      single ? static_cast<Real>(-2.12194440e-4) : static_cast<Real>(1.90821492927058770002e-10);
  using Integers = typename IntegersOf<P>::Vector;
  // Rounded to nearest: the fraction of a number so large has no bits.
  constexpr Real large = single ? static_cast<Real>(12582912) : static_cast<Real>(6755399441055744);
  const P shifted = x * per_ln2 + large;
  const P k = shifted - large;
  const P f = (x - k * ln2_high) - k * ln2_low;
  constexpr int degree = single ? 7 : 13;
  constexpr double inverse_factorial[14] = {1,
                                            1,
                                            1.0 / 2,
                                            1.0 / 6,
                                            1.0 / 24,
                                            1.0 / 120,
                                            1.0 / 720,
                                            1.0 / 5040,
                                            1.0 / 40320,
                                            1.0 / 362880,
                                            1.0 / 3628800,
                                            1.0 / 39916800,
                                            1.0 / 479001600,
                                            1.0 / 6227020800};
  P sum = P{} + static_cast<Real>(inverse_factorial[degree]);
  for (int i = degree - 1; i >= 0; --i) sum = sum * f + static_cast<Real>(inverse_factorial[i]);
  constexpr int mantissa = single ? 23 : 52;
  const Integers bits =
      reinterpret_cast<Integers>(sum) + (__builtin_convertvector(k, Integers) << mantissa);
  return reinterpret_cast<P>(bits);
}

// 1/sqrt(x) for the vectors of pairs that are narrower than 64 bytes.
HEMOSCALE_LANES Quad<float> reciprocal_root(Quad<float> x) {
  const Quad<float> root = {__builtin_sqrtf(x[0]), __builtin_sqrtf(x[1]), __builtin_sqrtf(x[2]),
                            __builtin_sqrtf(x[3])};
  return 1.0F / root;
}
HEMOSCALE_LANES Quad<double> reciprocal_root(Quad<double> x) {
  const Quad<double> root = {__builtin_sqrt(x[0]), __builtin_sqrt(x[1]), __builtin_sqrt(x[2]),
                             __builtin_sqrt(x[3])};
  return 1.0 / root;
}
