#include "coupling/scene/build_micro.hpp"

#include <utility>

#include "coupling/scene/build_law.hpp"
#include "micro/synthetic/synthetic_model.hpp"

namespace hemoscale::coupling {

micro::EnsembleParameters build_ensemble_parameters(const Settings& settings, int threads,
                                                    bool force) {
  micro::EnsembleParameters p;
  // Where cells come and go, one stands for all.
  p.cells = settings.has("micro.cells") ? static_cast<int>(settings.integer("micro.cells")) : 1;
  p.nodes = static_cast<int>(settings.integer("micro.nodes"));
  p.hematocrit = settings.quantity("fluid.hematocrit");
  p.plasma_viscosity = settings.quantity("fluid.plasma_viscosity");
  if (settings.text("micro.domain") == "channel") {
    p.domain = micro::PlaneChannel{settings.quantity("micro.channel.height")};
    p.wall = {settings.quantity("micro.wall.stiffness"), settings.quantity("micro.wall.range")};
  } else if (settings.text("micro.domain") == "geometry") {
    // What walls do to nodes and steps is that of a channel; the flow says where they are.
    p.domain = micro::PlaneChannel{settings.quantity("micro.shape.length")};
    p.wall = {settings.quantity("micro.wall.stiffness"), settings.quantity("micro.wall.range")};
  } else {
    p.domain = micro::ShearBox{settings.quantity("micro.aspect_ratio")};
  }
  const std::string outline = settings.text("micro.shape.outline");
  p.outline.outline = outline == "ellipse"    ? micro::Outline::ellipse
                      : outline == "deflated" ? micro::Outline::deflated
                                              : micro::Outline::evans_fung;
  if (p.outline.outline == micro::Outline::deflated) {
    p.outline.reduced_area = settings.quantity("micro.shape.reduced_area");
  }
  p.outline.length = settings.quantity("micro.shape.length");
  if (p.outline.outline == micro::Outline::ellipse) {
    p.outline.aspect = settings.quantity("micro.shape.aspect");
  }
  p.membrane.stretch_modulus = settings.quantity("micro.membrane.stretch_modulus");
  p.membrane.bending_modulus = settings.quantity("micro.membrane.bending_modulus");
  p.membrane.bending_law = settings.text("micro.membrane.bending_law") == "half-angle-tangent"
                               ? micro::BendingLaw::half_angle_tangent
                               : micro::BendingLaw::turning_angle;
  p.membrane.natural_shape = settings.text("micro.membrane.natural_shape") == "flat"
                                 ? micro::NaturalShape::flat
                                 : micro::NaturalShape::outline;
  p.membrane.area_modulus = settings.quantity("micro.membrane.area_modulus");
  p.drag.convention = settings.text("micro.drag.convention") == "node"
                          ? micro::DragConvention::node
                          : micro::DragConvention::cell;
  p.drag.coefficient = settings.quantity("micro.drag.coefficient");
  if (settings.text("micro.contact.law") == "polynomial") {  // the only one of the reference
    p.contact = {settings.quantity("micro.contact.stiffness"),
                 settings.quantity("micro.contact.rest_distance"),
                 settings.quantity("micro.contact.cutoff"),
                 settings.quantity("micro.contact.attraction")};
  }
  if (settings.has("micro.time_step")) p.time_step = settings.quantity("micro.time_step");
  p.force = force || settings.boolean("micro.force");
  p.threads = threads;
  return p;
}

micro::Run build_run(const Settings& settings) {
  micro::Run run;
  run.warm_up_strain = settings.quantity("micro.run.warm_up_strain");
  run.minimum_strain = settings.quantity("micro.run.minimum_strain");
  run.maximum_strain = settings.quantity("micro.run.maximum_strain");
  run.relative_standard_error = settings.quantity("micro.run.relative_standard_error");
  return run;
}

MicroFactory build_micro_factory(const Settings& settings, bool force, EnsembleHook hook) {
  const auto seed = static_cast<std::uint64_t>(settings.integer("case.seed"));
  if (settings.text("micro.model") == "synthetic") {
    const macro::ViscosityLaw law = build_law(settings, "micro.synthetic.law", "micro.synthetic");
    micro::SyntheticParameters parameters;
    parameters.law = [law](double shear_rate, double hematocrit) {
      return law.viscosity(shear_rate, hematocrit);
    };
    parameters.plasma_viscosity = settings.quantity("fluid.plasma_viscosity");
    parameters.noise = settings.quantity("micro.synthetic.noise");
    parameters.correlation_strain = settings.quantity("micro.synthetic.correlation_strain");
    return [parameters, seed](int slot) -> std::unique_ptr<micro::MicroModel<2>> {
      return std::make_unique<micro::SyntheticModel>(parameters, seed,
                                                     static_cast<std::uint64_t>(slot));
    };
  }
  const micro::EnsembleParameters parameters = build_ensemble_parameters(settings, 1, force);
  return [parameters, seed,
          hook = std::move(hook)](int slot) -> std::unique_ptr<micro::MicroModel<2>> {
    auto model =
        std::make_unique<micro::EnsembleModel>(parameters, seed, static_cast<std::uint64_t>(slot));
    if (hook) hook(slot, *model);
    return model;
  };
}

}  // namespace hemoscale::coupling
