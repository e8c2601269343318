#include <string>

#include "coupling/config/parameter_sections.hpp"

namespace hemoscale::coupling {

using Kind = ParameterKind;

namespace {

const std::vector<Condition> of_plasma = {{"micro.model", "plasma"}};

Parameter quantity(const std::string& key, const std::string& unit, Range range,
                   const std::string& default_note, const std::string& sentence) {
  return {.key = "micro.plasma." + key,
          .kind = unit.empty() ? Kind::number : Kind::quantity,
          .unit = unit,
          .range = range,
          .default_note = default_note,
          .applies_when = of_plasma,
          .sentence = sentence};
}

Parameter choice(const std::string& key, const std::vector<std::string>& choices,
                 const std::string& default_note, const std::string& sentence) {
  Parameter parameter = quantity(key, "", {}, default_note, sentence);
  parameter.kind = Kind::choice;
  parameter.choices = choices;
  return parameter;
}

/// Unbounded flow has no particles.
const Condition bounded = {"micro.plasma.flow", "unbounded-shear", true};

/// The flow: where, how fast, how finely.
std::vector<Parameter> flow_parameters() {
  const std::string only = "needed by the flows that have one";
  Parameter flow = choice("flow", plasma_flows(), "",
                          "What flows where; cases/plasma-verification holds an example of each.");
  flow.default_value = "open-channel";
  Parameter membranes = choice(
      "membranes", {"none", "implicit", "immersed", "direct"}, "",
      "Red cells in the plasma, and how they meet it. implicit: boundary integrals and nodes, "
      "quasi-steady, stable for any stiffness; immersed: spread forces, explicit; direct: membrane "
      "nodes are particles of the plasma (Tsubota et al. 2006), explicit.");
  membranes.default_value = "none";
  Parameter length = quantity("length", "m", above(0), "",
                              "Length of the domain along the flow; edge of boxes and patches.");
  length.required = true;
  length.applies_when.push_back(bounded);
  Parameter spacing = quantity("spacing", "m", above(0), "", "Mean distance of the particles, l0.");
  spacing.required = true;
  spacing.applies_when.push_back(bounded);
  Parameter disorder =
      quantity("disorder", "",
               {.lowest = 0, .highest = 0.5, .lowest_allowed = true, .highest_allowed = false}, "",
               "Each particle starts displaced at random by up to this times the spacing.");
  disorder.default_value = "0";
  disorder.applies_when.push_back(bounded);
  Parameter inlet = choice("inlet", {"uniform", "parabolic"}, "",
                           "Velocity at the inlet of open channels: uniform, scaled to the exact "
                           "flux, or the parabola of developed flow.");
  inlet.default_value = "uniform";
  return {
      flow,
      membranes,
      length,
      quantity("height", "m", above(0), only, "Distance of the walls; diameter of the pipe."),
      spacing,
      disorder,
      quantity("speed", "m/s", above(0), only,
               "Mean velocity of channels and pipe, velocity of the moving wall (couette), or "
               "amplitude of the vortices (taylor-green)."),
      inlet,
      quantity("frequency", "1/s", above(0), "steady driving",
               "Of the pressure gradient of a periodic channel that oscillates (Womersley flow)."),
      quantity(
          "rate", "1/s", above(0), only,
          "Shear rate of the shear box and of unbounded shear; angular velocity of the rotating "
          "patch."),
      quantity("gravity", "m/s^2", above(0), only, "Acceleration that holds the column down."),
      quantity("radius", "m", above(0), only, "Radius of the cylinder in the channel."),
      quantity("throat", "m", above(0), only, "Smallest height of the constriction."),
      quantity("narrowing", "m", above(0), only, "Length over which the channel is constricted."),
      quantity("nose", "m", above(0), only,
               "Abscissa at which the divider of a bifurcation begins."),
      quantity("divider", "m", above(0), only, "Thickness of the divider of a bifurcation."),
      quantity("time_step", "s", above(0), "a fifth of a spacing, or 0.4 of the viscous limit",
               "Longest time step."),
  };
}

/// The method, as a named scheme and as choices of its own.
std::vector<Parameter> method_parameters() {
  const std::string scheme_says = "as the scheme says";
  Parameter scheme = choice(
      "scheme", {"best", "paper", "repaired", "moving"}, "",
      "best: least squares on resting nodes, velocity and pressure together; moving: the same on "
      "nodes that move with the fluid; paper: Tsubota et al. 2006 to the letter; repaired: that "
      "method with its published corrections. The keys below change single choices.");
  scheme.default_value = "best";
  return {
      scheme,
      choice("operators", {"mps", "cmps", "gc", "lsmps2"}, scheme_says,
             "Discrete gradient and Laplacian; lsmps2 is the least-squares solver, the others the "
             "semi-implicit particle method."),
      choice("gradient_form", {"difference", "minimum", "antisymmetric"}, scheme_says,
             "Reference value of the pressure gradient of mps, cmps and gc."),
      choice("laplacian_scale", {"local", "reference"}, scheme_says,
             "Normalisation of their Laplacian: of each particle, or of the full lattice."),
      quantity("kernel_ratio", "", above(1), scheme_says,
               "Kernel radius over the spacing; with mps, cmps and gc that of the gradient."),
      quantity("laplacian_ratio", "", above(1), scheme_says,
               "Kernel radius of the Laplacian of mps, cmps and gc over the spacing."),
      choice(
          "source", {"pnd", "divergence", "hs-ecs"}, scheme_says,
          "What drives the pressure: number density, divergence, or the rate of the density with "
          "error compensation; lsmps2 knows the divergence alone."),
      quantity("relaxation", "", {.lowest = 0, .highest = 1, .lowest_allowed = false}, scheme_says,
               "Share of the density deviation that one step of pnd removes."),
      choice("coupling", {"chorin", "incremental", "coupled"}, scheme_says,
             "Velocity and pressure one after the other, or together (lsmps2)."),
      choice("viscosity", {"explicit", "implicit"}, scheme_says, "Treatment of the viscous term."),
      choice("time_scheme", {"euler", "sdirk2"}, scheme_says,
             "First or second order in time (sdirk2: lsmps2)."),
      choice("inertia", {"unsteady", "quasi-steady"}, scheme_says,
             "With the rate of momentum, or Stokes flow (lsmps2, coupled): for Re below 1 and "
             "steady driving."),
      choice("motion", {"lagrangian", "ale", "eulerian"}, scheme_says,
             "Nodes move with the fluid, with a transport velocity, or rest (lsmps2)."),
      choice("walls", {"dummy", "antisymmetric", "lsmps"}, scheme_says,
             "Dummy particles at the velocity of the wall, or mirrored, or nodes on the wall "
             "(lsmps2)."),
      choice("shifting", {"none", "concentration", "ops"}, scheme_says,
             "What keeps moving particles apart."),
      quantity("stabilisation", "", above(0), "50",
               "Constant of the coupled solver that ties neighbouring pressures together."),
      quantity("tolerance", "",
               {.lowest = 1e-14, .highest = 0.1, .lowest_allowed = true, .highest_allowed = true},
               "1e-10", "Relative residual at which linear solves end."),
      choice("linear_solver", {"automatic", "banded", "sparse-direct", "aggregate", "hypre"},
             "automatic", "Linear solver (lsmps2); automatic chooses by size and shape."),
  };
}

}  // namespace

const std::vector<std::string>& plasma_flows() {
  static const std::vector<std::string> flows = {"open-channel",   "periodic-channel", "couette",
                                                 "taylor-green",   "taylor-green-3d",  "shear-box",
                                                 "column",         "rotating-patch",   "cylinder",
                                                 "constriction",   "bifurcation",      "pipe",
                                                 "unbounded-shear"};
  return flows;
}

std::vector<Parameter> plasma_parameters() {
  std::vector<Parameter> table = flow_parameters();
  const std::vector<Parameter> method = method_parameters();
  table.insert(table.end(), method.begin(), method.end());
  return table;
}

}  // namespace hemoscale::coupling
