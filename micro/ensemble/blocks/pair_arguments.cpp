#include "micro/ensemble/blocks/pair_arguments.hpp"

#include <cmath>
#include <variant>

#include "micro/ensemble/blocks/block_store.hpp"

namespace hemoscale::micro::blocks {
namespace {

constexpr double square_micrometre = micrometre * micrometre;

template <class Real>
void set(const PairPotential& p, double tau, PairArguments<Real>& g) {
  const double um6 = square_micrometre * square_micrometre * square_micrometre;
  g.law = {
      static_cast<Real>(tau * p.scale * um6), static_cast<Real>(p.rest_squared / square_micrometre),
      static_cast<Real>(p.cutoff_squared / square_micrometre), static_cast<Real>(p.attraction)};
}
template <class Real>
void set(const MorsePotential& p, double tau, PairArguments<Real>& g) {
  const double e = std::exp(p.steepness * (p.rest_distance - p.cutoff));
  const double scale = tau * 2 * p.steepness * p.energy_scale / micrometre;
  g.morse = {static_cast<Real>(scale), static_cast<Real>(p.steepness * micrometre),
             static_cast<Real>(p.rest_distance / micrometre),
             static_cast<Real>(scale * e * (e - 1)),
             static_cast<Real>(p.cutoff * p.cutoff / square_micrometre)};
}
template <class Real>
void set(const LennardJonesPotential& p, double tau, PairArguments<Real>& g) {
  const double e = std::pow(p.rest_distance / p.cutoff, 6);
  const double scale = tau * 12 * p.energy_scale / square_micrometre;
  g.lennard_jones = {static_cast<Real>(scale), static_cast<Real>(p.rest_distance / micrometre),
                     static_cast<Real>(p.core / micrometre),
                     static_cast<Real>(scale * e * (e - 1) / (p.cutoff / micrometre)),
                     static_cast<Real>(p.cutoff * p.cutoff / square_micrometre)};
}

}  // namespace

template <class Real>
PairArguments<Real> pair_arguments(const ContactLaw& law, double tau) {
  PairArguments<Real> g;
  std::visit([&](const auto& l) { set(l, tau, g); }, law);
  return g;
}

template PairArguments<float> pair_arguments<float>(const ContactLaw&, double);
template PairArguments<double> pair_arguments<double>(const ContactLaw&, double);

static_assert(std::variant_size_v<ContactLaw> == pair_forms);

}  // namespace hemoscale::micro::blocks
