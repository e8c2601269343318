#include "coupling/config/parameter_sections.hpp"

namespace hemoscale::coupling {

using Kind = ParameterKind;

namespace {

std::vector<Parameter> channel_parameters() {
  const Condition channel{"macro.model", "channel"};
  return {
      {.key = "macro.channel.height",
       .kind = Kind::quantity,
       .unit = "m",
       .range = between(1e-7, 1),
       .required = true,
       .applies_when = {channel},
       .sentence = "Distance between the two walls of the channel."},
      {.key = "macro.channel.drive",
       .kind = Kind::choice,
       .choices = {"pressure-gradient", "mean-velocity"},
       .default_value = "mean-velocity",
       .applies_when = {channel},
       .sentence = "What is held while the viscosity changes."},
      {.key = "macro.channel.pressure_gradient",
       .kind = Kind::quantity,
       .unit = "Pa/m",
       .range = above(0),
       .required = true,
       .applies_when = {channel, {"macro.channel.drive", "pressure-gradient"}},
       .sentence = "Fall of pressure per length in the direction of the flow."},
      {.key = "macro.channel.mean_velocity",
       .kind = Kind::quantity,
       .unit = "m/s",
       .range = above(0),
       .required = true,
       .applies_when = {channel, {"macro.channel.drive", "mean-velocity"}},
       .sentence = "Flow rate per width over the height of the channel."},
  };
}

std::vector<Parameter> openfoam_parameters() {
  const std::vector<Condition> openfoam = {{"macro.model", "openfoam"}};
  return {
      {.key = "macro.openfoam.case",
       .kind = Kind::path,
       .required = true,
       .applies_when = openfoam,
       .sentence =
           "OpenFOAM case folder, relative to the folder of the case file; it is copied into "
           "the results before it is run, and itself never changed."},
      {.key = "macro.openfoam.mesh_command",
       .kind = Kind::text,
       .default_value = "blockMesh",
       .applies_when = openfoam,
       .sentence = "Command that makes the mesh, run in the copy of the case."},
      {.key = "macro.openfoam.solver",
       .kind = Kind::text,
       .default_value = "simpleFoam",
       .applies_when = openfoam,
       .sentence = "OpenFOAM solver; one that asks its viscosity model for the viscosity."},
      {.key = "macro.openfoam.ranks",
       .kind = Kind::integer,
       .range = between(1, 4096),
       .default_value = "1",
       .applies_when = openfoam,
       .sentence = "MPI ranks of the OpenFOAM solver."},
      {.key = "macro.openfoam.length_unit",
       .kind = Kind::quantity,
       .unit = "m",
       .range = above(0),
       .default_value = "1 m",
       .applies_when = openfoam,
       .sentence = "What the length 1 of the mesh means: \"1 um\" for a mesh in micrometres."},
      {.key = "macro.openfoam.time_unit",
       .kind = Kind::quantity,
       .unit = "s",
       .range = above(0),
       .default_value = "1 s",
       .applies_when = openfoam,
       .sentence = "What the time 1 of the OpenFOAM case means."},
      {.key = "macro.openfoam.velocity_field",
       .kind = Kind::text,
       .default_value = "U",
       .applies_when = openfoam,
       .sentence = "Name of the velocity field."},
      {.key = "macro.openfoam.interpolation",
       .kind = Kind::choice,
       .choices = {"taylor", "cell-point", "cell-point-face"},
       .default_value = "taylor",
       .applies_when = openfoam,
       .sentence =
           "How velocity is found between cell centres: from centre and gradient of the cell "
           "(taylor), or by OpenFOAM's interpolation of that name."},
      {.key = "macro.openfoam.profile",
       .kind = Kind::points,
       .unit = "m",
       .length = 2,
       .default_note = "no profile is written",
       .applies_when = openfoam,
       .sentence = "Ends of a line on which the final velocity is written to profile.csv, from "
                   "wall to wall."},
      {.key = "macro.openfoam.profile_mean_velocity",
       .kind = Kind::quantity,
       .unit = "m/s",
       .range = above(0),
       .default_note = "no comparison",
       .applies_when = openfoam,
       .sentence = "Mean velocity of the plane channel flow that the profile is compared with."},
  };
}

}  // namespace

std::vector<Parameter> macro_parameters() {
  const std::vector<Condition> coupled = {{"scene.kind", "coupled"}};
  std::vector<Parameter> table = {
      {.key = "macro.model",
       .kind = Kind::choice,
       .choices = {"channel", "openfoam"},
       .default_value = "channel",
       .applies_when = coupled,
       .sentence = "The macroscopic flow: plane channel (analytic), or an OpenFOAM case."},
  };
  const auto append = [&table](const std::vector<Parameter>& more) {
    table.insert(table.end(), more.begin(), more.end());
  };
  append(channel_parameters());
  append(openfoam_parameters());
  table.push_back({.key = "law.initial",
                   .kind = Kind::choice,
                   .choices = law_names(),
                   .default_value = "newtonian",
                   .applies_when = coupled,
                   .sentence = "The viscosity law that holds before any micro run."});
  append(law_parameters("law", "law.initial"));
  return table;
}

}  // namespace hemoscale::coupling
