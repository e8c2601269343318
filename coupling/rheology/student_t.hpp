#pragma once

namespace hemoscale::coupling {

/// The t for which a Student-t variable lies in [-t, t] with the given probability.
///
///   P(|T| > t) = I_{nu / (nu + t^2)}(nu / 2, 1 / 2)     (regularised incomplete beta function;
///                                                       Abramowitz and Stegun 1964, 26.7.1)
///
/// @param probability         in (0, 1)
/// @param degrees_of_freedom  nu, positive, not necessarily whole; infinity gives the normal law
/// @returns                   t [-]; infinity if degrees_of_freedom is not positive (no statement)
double student_t_half_width(double probability, double degrees_of_freedom);

/// Probability that each of `count` independent intervals must have for all of them together to
/// have `probability`: probability^(1/count) (Sidak 1967, J. Am. Stat. Assoc. 62, 626).
double sidak_probability(double probability, int count);

}  // namespace hemoscale::coupling
