"""Ensembles on vectors: broken values give one clear message, limits hold on both sides, variants are sound."""

import pathlib
import re
import sys
import tomllib
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from ensemble_case import CHANNEL, INTEGRATORS, EnsembleTest, with_micro  # noqa: E402

CASES = pathlib.Path(__file__).parents[3] / "cases"


class BadEnsembles(EnsembleTest):
    def test_limits_hold_on_both_sides(self):
        for name, more in INTEGRATORS.items():
            with self.subTest(name):
                text = with_micro(CHANNEL, f'integrator = "{name}"', more)
                told = self.accepted(text)
                limit = float(re.search(r"limit of the time step (\S+) s", told)[1])
                self.accepted(with_micro(text, f'time_step = "{0.999 * limit} s"'))
                beyond = with_micro(text, f'time_step = "{1.001 * limit} s"')
                self.refused(beyond, "micro.time_step", "exceeds", "case.toml:", "--force", "reduce it")
                self.accepted(with_micro(beyond, "force = true"))

    def test_keys_of_other_integrators(self):
        self.refused(with_micro(CHANNEL, "chebyshev.stages = 6"), "micro.chebyshev.stages", "micro.integrator")
        self.refused(with_micro(CHANNEL, 'inertia.cell_mass = "1e-8 kg/m"'), "micro.inertia.cell_mass", "inertial")
        self.refused(with_micro(CHANNEL, 'drag.momentum = "1 kg/m^2"'), "micro.drag.momentum", "inertial")
        self.refused(with_micro(CHANNEL, "drag.normal_ratio = 2"), "micro.drag.normal_ratio", "chebyshev")
        self.accepted(with_micro(CHANNEL, "drag.normal_ratio = 2", 'integrator = "explicit"'))

    def test_values_out_of_range(self):
        inertial = with_micro(CHANNEL, 'integrator = "inertial"', 'precision = "double"')
        self.refused(with_micro(inertial, 'inertia.cell_mass = "0 kg/m"'), "micro.inertia.cell_mass", "> 0 kg/m")
        self.refused(with_micro(inertial, 'inertia.cell_mass = "1 kg"'), "micro.inertia.cell_mass", "kg/m")
        self.refused(with_micro(inertial, 'drag.momentum = "-1 kg/m^2"'), "micro.drag.momentum", ">= 0")
        self.refused(with_micro(inertial, "drag.normal_ratio = 0"), "micro.drag.normal_ratio", "> 0")
        chebyshev = with_micro(CHANNEL, 'integrator = "chebyshev"')
        for stages in (1, 51):
            self.refused(with_micro(chebyshev, f"chebyshev.stages = {stages}"), "micro.chebyshev.stages", "2 to 50")
        self.refused(with_micro(CHANNEL, "regions.exchange_interval = 0"), "micro.regions.exchange_interval", "1")
        self.refused(with_micro(CHANNEL, "regions.copy_growth = 1"), "micro.regions.copy_growth", "> 1")
        self.refused(with_micro(CHANNEL, 'regions.copies = "slip"'), "micro.regions.copies", "flow", "frozen")
        for law in ("wall_lift", "shear_lift", "shear_diffusion"):
            self.refused(with_micro(CHANNEL, f"migration.{law} = -1"), f"micro.migration.{law}", ">= 0")

    def test_mass_in_single_precision_needs_long_steps(self):
        self.refused(with_micro(CHANNEL, 'integrator = "inertial"'), "micro.precision", "double")

    def test_laws_of_contact(self):
        morse = CHANNEL.replace("[micro.contact]", '[micro.contact]\nlaw = "morse"')
        self.refused(morse, "micro.contact.morse.energy_scale", "micro.contact.morse.steepness", faults=2)
        morse = morse.replace('"morse"', '"morse"\nmorse.energy_scale = "1e-14 N"\nmorse.steepness = "1e7 1/m"')
        seen = self.run_figures(morse)
        self.assertEqual(seen["overlapping pairs of cells at the end"], 0)
        self.refused(morse.replace("1e7", "1e6"), "micro.contact.law", "strongest attraction", "cutoff")
        self.refused(morse.replace("1e7", "1e8"), "micro.contact.law", "steepness times cutoff", "20")
        jones = CHANNEL.replace(
            "[micro.contact]", '[micro.contact]\nlaw = "lennard-jones"\nlennard_jones.energy_scale = "1e-14 N"'
        )
        self.run_figures(jones)
        core = jones.replace('"1e-14 N"', '"1e-14 N"\nlennard_jones.core = "0.6 um"')
        self.refused(core, "micro.contact.law", "core")
        both = CHANNEL.replace("[micro.contact]", '[micro.contact]\nmorse.steepness = "1e7 1/m"')
        self.refused(both, "micro.contact.morse.steepness", "micro.contact.law")

    def test_reference_has_no_options_of_vectors(self):
        reference = with_micro(CHANNEL, 'integrator = "explicit-reference"')
        reference = re.sub(r"\[micro.packing\]\n.*\n", "", reference)
        self.accepted(reference)
        jones = reference.replace(
            "[micro.contact]", '[micro.contact]\nlaw = "lennard-jones"\nlennard_jones.energy_scale = "1e-14 N"'
        )
        self.refused(jones, "micro.contact.law", "on vectors alone")
        self.refused(with_micro(reference, "drag.normal_ratio = 2"), "micro.drag.normal_ratio", "on vectors alone")
        self.refused(with_micro(reference, "platelets.per_cell = 1"), "micro.platelets.per_cell", "on vectors alone")
        self.refused(with_micro(reference, "migration.wall_lift = 0.1"), "micro.migration.wall_lift", "micro.integrator")
        pulsatile = with_micro(reference, 'flow.kind = "womersley"', 'flow.frequency = "1 Hz"')
        self.refused(pulsatile, "micro.flow.kind", "on vectors alone")

    def test_vectors_do_not_run_in_a_shear_box(self):
        box = with_micro(CHANNEL, 'integrator = "explicit"').replace('domain = "channel"', 'domain = "shear-box"')
        box = box.replace('mean_velocity = "20 um/s"', 'shear_rate = "10 1/s"').replace('[micro.channel]\nheight = "30 um"\n', "")
        self.refused(box, "micro.integrator", "explicit-reference")

    def test_lift_is_for_red_cells_alone(self):
        for law in ("wall_lift", "shear_lift", "shear_diffusion"):
            text = with_micro(CHANNEL, f"migration.{law} = 0.1", "platelets.per_cell = 0.25")
            self.refused(text, f"micro.migration.{law}", "platelets")

    def test_what_cannot_be_packed(self):
        self.refused(CHANNEL.replace("hematocrit = 0.3", "hematocrit = 0.7"), "micro.packing.kind", "lattice of cells",
                     "case.toml:")
        low = CHANNEL.replace('height = "30 um"', 'height = "2.5 um"')
        self.refused(low, "micro.packing.kind", "across")
        rows = CHANNEL.replace('kind = "lattice"', 'kind = "lattice"\nrows = 20')
        self.refused(rows, "micro.packing.kind", "20 rows")
        crowded = with_micro(CHANNEL, "platelets.per_cell = 10")
        self.accepted(crowded)
        result = self.hemoscale("run", self.write_case(crowded))
        self.assert_refused(result, 2, "micro.platelets.per_cell", "platelets found a place", "case.toml:")

    def test_places_of_a_table(self):
        case = CHANNEL.replace('kind = "lattice"', 'kind = "table"\ntable = "places.csv"').replace("cells = 12", "cells = 3")
        case = case.replace("hematocrit = 0.3", "hematocrit = 0.06")
        head = "x [m],y [m],angle [rad]\n"
        good = ["4e-6,8e-6,0", "4e-6,15e-6,0.5", "14e-6,22e-6,1"]

        def write(rows):
            self.write_case(case)
            (self.folder / "case" / "places.csv").write_text(head + "\n".join(rows) + "\n", encoding="utf-8")

        def refuse(rows, *fragments):
            write(rows)
            self.refused(case, "micro.packing.table", "case.toml:", *fragments)

        write(good)
        self.accepted(case)
        self.assertAlmostEqual(self.run_figures(case)["area fraction at the first output"], 0.06, delta=1e-4)
        refuse(["4e-6,8e-6,0", "4e-6,8.1e-6,0", good[2]], "cell 0 and kind 0, cell 1", "interlock")
        refuse(["4e-6,8e-6,0", "4e-6,8e-6,1.57", good[2]], "interlock", "outlines cross", "move one of them")
        refuse([good[0], good[1], "14e-6,29e-6,0"], "cell 2", "beyond a wall", "move the cell into the fluid")
        refuse([good[0], good[1], "14e-6,45e-6,0"], "cell 2", "beyond a wall")
        refuse(good[:2], "3 columns and 2 rows", "3 cells")
        head = "x [um],y [um],angle [rad]\n"
        refuse(good, "x [m],y [m],angle [rad]")
        (self.folder / "case" / "places.csv").unlink()
        result = self.hemoscale("check", self.folder / "case")
        self.assert_refused(result, 3, "places.csv")

    def test_random_packing_that_is_too_dense(self):
        dense = CHANNEL.replace("cells = 12", "cells = 6").replace('kind = "lattice"', 'kind = "random"').replace("hematocrit = 0.3", "hematocrit = 0.74")
        result = self.hemoscale("run", self.write_case(dense))
        self.assert_refused(result, 2, "micro.packing.kind", "case.toml:", "lower the hematocrit")

    def test_variants_of_the_vessel_are_sound(self):
        case = CASES / "vessel-ensemble"
        for name in ["", *tomllib.loads((case / "case.toml").read_text(encoding="utf-8"))["variant"]]:
            with self.subTest(name):
                result = self.hemoscale("check", case, *(["--variant", name] if name else []))
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertIn("limit of the time step", result.stdout)


if __name__ == "__main__":
    unittest.main()
