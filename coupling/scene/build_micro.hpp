#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>

#include "coupling/config/settings.hpp"
#include "coupling/scheme/micro_runs.hpp"
#include "micro/ensemble/ensemble_model.hpp"
#include "micro/model.hpp"

namespace hemoscale::coupling {

/// @param threads  inside one model
/// @param force    run beyond a stability limit
micro::EnsembleParameters build_ensemble_parameters(const Settings& settings, int threads,
                                                    bool force);

micro::Run build_run(const Settings& settings);

/// Called with each model of an ensemble that is made, to watch it.
using EnsembleHook = std::function<void(int slot, micro::EnsembleModel&)>;

/// The factory of micro models of a coupled case: the model of a slot draws its random numbers from
/// the stream of that number. Models run on one thread each; the loop runs several at a time.
MicroFactory build_micro_factory(const Settings& settings, bool force, EnsembleHook hook);

}  // namespace hemoscale::coupling
