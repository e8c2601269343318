// Laws of contact on vectors of squared distances s: force over distance f, and -df/ds, so that
// F = f d and -dF/dx = -f I + 2 (-df/ds) d d'. Both are exactly zero from the cutoff on.

template <class P>
struct PairForce {
  P f;
  P slope;  // -df/ds
};

// Powers of the distance are formed with a little more than s, [um^2]: pairs that coincide have
// finite numbers times d = 0 then, and no other pair notices.
template <class Real>
inline constexpr Real coincident = static_cast<Real>(1e-20);

// micro/ensemble/pair_potential.hpp. With w = rc^2 - s and b = r0^2 - s: f = A w^2 b.
struct PolynomialLaw {
  template <class Real, class P>
  HEMOSCALE_LANES static PairForce<P> at(const PairArguments<Real>& g, P s) {
    const P zero = P{};
    const P ones = zero + 1;
    const P weak = zero + g.law.attraction;
    const P inside = g.law.cutoff - s;
    const P w = inside > 0 ? inside : zero;
    const P b = g.law.rest - s;
    const P scaled = g.law.scale * w * (b > 0 ? ones : weak);
    return {scaled * w * b, scaled * (b + b + w)};
  }
};

// micro/ensemble/morse_potential.hpp. With e = exp(b (re - r)): F = 2 b D e (e - 1) less that at
// rc, F' = -2 b^2 D e (2 e - 1).
struct MorseLaw {
  template <class Real, class P>
  HEMOSCALE_LANES static PairForce<P> at(const PairArguments<Real>& g, P s) {
    const P zero = P{};
    const P q = reciprocal_root(s + coincident<Real>);
    const P wanted = g.morse.steepness * (g.morse.rest - s * q);
    const P lowest = zero - 80;  // pairs beyond the cutoff, which do not count
    const P e = exponential<Real>(wanted > lowest ? wanted : lowest);
    const P f = (g.morse.scale * (e * (e - 1)) - g.morse.cut_force) * q;
    const P stiffness = (g.morse.scale * g.morse.steepness) * (e * (e + e - 1));
    const P slope = static_cast<Real>(0.5) * (f + stiffness) * (q * q);
    return {s < g.morse.cutoff ? f : zero, s < g.morse.cutoff ? slope : zero};
  }
};

// micro/ensemble/lennard_jones_potential.hpp. With p = (re/r)^6: F = 12 e p (p - 1)/r less that at
// rc, F' = -12 e p (13 p - 7)/r^2; within the core along the tangent there.
struct LennardJonesLaw {
  template <class Real, class P>
  HEMOSCALE_LANES static PairForce<P> at(const PairArguments<Real>& g, P s) {
    const P zero = P{};
    const P core = zero + g.lennard_jones.core;
    const P q = reciprocal_root(s + coincident<Real>);
    const P r = s * q;
    const P outer_q = r > core ? q : zero + 1 / g.lennard_jones.core;
    const P inner = r > core ? zero : r - core;
    const P t = g.lennard_jones.rest * outer_q;
    const P t2 = t * t;
    const P p = t2 * t2 * t2;
    const P scaled = g.lennard_jones.scale * p * outer_q;
    const P stiffness = scaled * (13 * p - 7) * outer_q;
    const P f = (scaled * (p - 1) - g.lennard_jones.cut_force - stiffness * inner) * q;
    const P slope = static_cast<Real>(0.5) * (f + stiffness) * (q * q);
    return {s < g.lennard_jones.cutoff ? f : zero, s < g.lennard_jones.cutoff ? slope : zero};
  }
};
