#pragma once

#include "micro/ensemble/blocks/kernel_arguments.hpp"
#include "micro/ensemble/contact_law.hpp"

namespace hemoscale::micro::blocks {

/// A law of contact in the units of the kernels; the form is the index of the alternative.
/// @param tau  [m/N] dt / zeta of the cells on which the forces act
template <class Real>
PairArguments<Real> pair_arguments(const ContactLaw& law, double tau);

}  // namespace hemoscale::micro::blocks
