// Segments, turning angles and bending moments of rings, a cell per lane.

template <class V>
struct Segment {
  V ex, ey;  // [um] from node to node
  V q;       // [1/um] inverse length
  V tx, ty;  // [-] direction
};

template <class V>
HEMOSCALE_LANES Segment<V> segment(V x0, V y0, V x1, V y1) {
  Segment<V> s;
  s.ex = x1 - x0;
  s.ey = y1 - y0;
  s.q = reciprocal_root(s.ex * s.ex + s.ey * s.ey);
  s.tx = s.ex * s.q;
  s.ty = s.ey * s.q;
  return s;
}

// tan(theta/2) of the turn from a to b: sine / (1 + cosine). Invalid near reversal, where the
// membrane laws end too; the watch on segments and angles ends such runs.
template <class V>
HEMOSCALE_LANES V half_tangent(const Segment<V>& a, const Segment<V>& b) {
  const V sine = a.tx * b.ty - a.ty * b.tx;
  const V cosine = a.tx * b.tx + a.ty * b.ty;
  return sine * reciprocal(V{} + 1 + cosine);
}

// Inverse tangent by a polynomial in t^2 for |t| <= tan(pi/8), turns of 45 degrees at a node;
// beyond, which few shapes reach, atan t = pi/4 + atan((t - 1)/(t + 1)) in addition.
HEMOSCALE_LANES Single small_arctangent(Single t) {  // relative error 3e-8 before rounding
  const Single z = t * t;
  Single p = z * 0.0805374449538F - 0.138776856032F;
  p = p * z + 0.199777106478F;
  p = p * z - 0.333329491539F;
  return t + t * (z * p);
}
HEMOSCALE_LANES Double small_arctangent(Double t) {  // as in micro/cells/turning_angle_bending.hpp
  const Double z = t * t;
  Double p = z * 0.021133752033748364 - 0.04347919839046537;
  p = p * z + 0.0568830340363325;
  p = p * z - 0.066402251735395;
  p = p * z + 0.07689952488233016;
  p = p * z - 0.09090773003240828;
  p = p * z + 0.11111106177375227;
  p = p * z - 0.14285714180900647;
  p = p * z + 0.19999999998854168;
  p = p * z - 0.33333333333328435;
  return t + t * (z * p);
}
template <class V>
HEMOSCALE_LANES V arctangent(V t) {
  using Real = LaneType<V>;
  constexpr Real tan_pi_8 = static_cast<Real>(0.41421356237309503);
  const V magnitude = t < 0 ? -t : t;
  if (!any_above(magnitude, tan_pi_8)) {
    return small_arctangent(t);
  }
  const V folded = (magnitude - 1) / (magnitude + 1);
  const V far = small_arctangent(folded) + static_cast<Real>(0.78539816339744831);
  const V positive = magnitude > tan_pi_8 ? far : small_arctangent(magnitude);
  return t < 0 ? -positive : positive;
}

// Moment M = dE/dtheta at a node and its slope dM/dtheta, from tan(theta/2).
template <class V>
struct Moment {
  V value, slope;
};
struct TurningAngle {
  template <class V, class Real>
  HEMOSCALE_LANES static Moment<V> moment(V half_tangent, Real bending, Real natural) {
    return {bending * (2 * arctangent(half_tangent) - natural), V{} + bending};
  }
};
struct HalfAngle {
  template <class V, class Real>
  HEMOSCALE_LANES static Moment<V> moment(V half_tangent, Real bending, Real natural) {
    const V t = (half_tangent - natural) * reciprocal(V{} + 1 + half_tangent * natural);
    const V t2 = t * t;
    return {(2 * bending) * (t + t * t2), bending * ((1 + t2) * (1 + 3 * t2))};
  }
};
