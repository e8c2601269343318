#pragma once

#include "coupling/rheology/rheology_sample.hpp"
#include "micro/observation.hpp"

namespace hemoscale::coupling {

/// The rheology that a micro run measured: viscosity = shear stress / shear rate, and its standard
/// error likewise (the shear rate is imposed, hence exact).
///
/// The hematocrit of the sample is `hematocrit`, that of the flow it stands for; the micro domain
/// approximates it by a whole number of cells.
///
/// @throws NumericalError if the shear rate is not positive, an estimate is not finite or a
///         standard error negative, or the mean shear stress is not positive (no viscosity)
template <int dim>
RheologySample to_rheology(const micro::Observation<dim>& observation, double hematocrit);

}  // namespace hemoscale::coupling
