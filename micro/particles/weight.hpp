#pragma once

namespace hemoscale::micro {

/// Weight of the moving-particle method, singular at the origin (Koshizuka and Oka 1996):
/// w = radius / r - 1 within the radius, else zero. It keeps particles apart.
inline double singular_weight(double distance, double radius) {
  return distance < radius ? radius / distance - 1 : 0;
}

/// Weight of least-squares fits (Tamai and Koshizuka 2014): w = (1 - r / radius)^2 within the
/// radius, else zero.
inline double compact_weight(double distance, double radius) {
  const double s = 1 - distance / radius;
  return s > 0 ? s * s : 0;
}

}  // namespace hemoscale::micro
