#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <utility>

#include "coupling/scheme/coupled_loop.hpp"
#include "macro/flow_field.hpp"
#include "macro/viscosity/viscosity_law.hpp"
#include "micro/synthetic/synthetic_model.hpp"

// Flows and micro models of known answers for the tests of the coupling.
namespace hemoscale::coupling::testing {

/// A flow with one velocity gradient inside the box |x_d| <= 1 m; none outside.
template <int dim>
class UniformGradient final : public macro::FlowField<dim> {
 public:
  explicit UniformGradient(macro::Tensor<dim> gradient) : gradient_(std::move(gradient)) {}

  std::optional<macro::FlowState<dim>> at(const macro::Vector<dim>& x, double) const override {
    if (x.cwiseAbs().maxCoeff() > 1) return std::nullopt;
    macro::FlowState<dim> state;
    state.velocity = gradient_ * x;
    state.velocity_gradient = gradient_;
    return state;
  }

 private:
  macro::Tensor<dim> gradient_;
};

/// Synthetic models that follow `law`, one stream of noise for each slot.
inline MicroFactory synthetic(const macro::ViscosityLaw& law, double noise, std::uint64_t seed) {
  return [law, noise, seed](int slot) -> std::unique_ptr<micro::MicroModel<2>> {
    micro::SyntheticParameters parameters;
    parameters.law = [law](double rate, double hematocrit) {
      return law.viscosity(rate, hematocrit);
    };
    parameters.noise = noise;
    return std::make_unique<micro::SyntheticModel>(parameters, seed,
                                                   static_cast<std::uint64_t>(slot));
  };
}

/// A model that fails where it is told to, else behaves as the one inside.
class FailingModel final : public micro::MicroModel<2> {
 public:
  FailingModel(std::unique_ptr<micro::MicroModel<2>> inside, std::function<void()> before)
      : inside_(std::move(inside)), before_(std::move(before)) {}

  micro::Observation<2> advance(const micro::Forcing<2>& forcing, const micro::Run& run) override {
    const micro::Observation<2> observation = inside_->advance(forcing, run);
    before_();  // after the state has changed, to show that the change is undone
    return observation;
  }
  micro::Snapshot snapshot() const override { return inside_->snapshot(); }
  void restore(const micro::Snapshot& snapshot) override { inside_->restore(snapshot); }

 private:
  std::unique_ptr<micro::MicroModel<2>> inside_;
  std::function<void()> before_;
};

/// Runs that are short but hold enough samples for an error.
inline micro::Run short_run() {
  micro::Run run;
  run.warm_up_strain = 1;
  run.minimum_strain = 20;
  run.maximum_strain = 200;
  run.relative_standard_error = 0.02;
  return run;
}

/// For models without noise, where one sample is as good as many.
inline micro::Run exact_run() {
  micro::Run run;
  run.minimum_strain = 1;
  run.maximum_strain = 2;
  run.relative_standard_error = 0.02;
  return run;
}

inline LoopOptions loop_options(const micro::Run& run) {
  LoopOptions options;
  options.run = run;
  options.bounds.lowest_viscosity = 1e-6;
  options.bounds.highest_viscosity = 1e3;
  return options;
}

/// Human blood, roughly (Cho and Kensey 1991).
inline macro::ViscosityLaw blood() {
  macro::CarreauYasuda law;
  law.mu0 = 0.056;
  law.mu_inf = 3.45e-3;
  law.time = 3.313;
  law.power = 0.3568;
  law.transition = 2;
  return law;
}

inline macro::ViscosityLaw power_law(double consistency, double power) {
  macro::PowerLaw law;
  law.consistency = consistency;
  law.power = power;
  law.lowest_shear_rate = 1e-6;
  law.highest_shear_rate = 1e9;
  return law;
}

inline macro::ViscosityLaw newtonian(double viscosity) {
  macro::Newtonian law;
  law.mu = viscosity;
  return law;
}

}  // namespace hemoscale::coupling::testing
