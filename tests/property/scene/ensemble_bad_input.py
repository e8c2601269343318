"""Ensembles on vectors: every key reaches the model, broken values give one clear message, limits hold on both sides."""

import pathlib
import re
import sys
import tomllib
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from command_line import CommandLineTest, figures, summary, table  # noqa: E402

CASES = pathlib.Path(__file__).parents[3] / "cases"

CHANNEL = """[case]
name = "channel"
[scene]
kind = "micro"
[fluid]
hematocrit = 0.3
[micro]
model = "ensemble"
domain = "channel"
cells = 12
nodes = 40
mean_velocity = "20 um/s"
duration = "4 ms"
output_interval = "2 ms"
[micro.channel]
height = "30 um"
[micro.packing]
kind = "lattice"
[micro.contact]
rest_distance = "0.5 um"
[output]
trajectory = false
"""

INTEGRATORS = {
    "explicit": "",
    "chebyshev": "chebyshev.stages = 6\n",
    "inertial": 'inertia.cell_mass = "2e-8 kg/m"\ndrag.momentum = "1e-3 kg/m^2"\nprecision = "double"\n',
    "linearly-implicit": "",
    "constant-operator": "",
    "constant-operator-2": "",
}


def with_micro(text, *lines):
    """The case with more lines in its section micro."""
    return text.replace('model = "ensemble"\n', 'model = "ensemble"\n' + "\n".join(lines) + "\n")


def lasting(text, duration, interval):
    return text.replace('"4 ms"', f'"{duration}"').replace('"2 ms"', f'"{interval}"')


class Ensembles(CommandLineTest):
    def refused(self, text, *fragments, faults=1):
        result = self.hemoscale("check", self.write_case(text))
        self.assert_refused(result, 2, *fragments)
        self.assertIn(f"{faults} fault", result.stderr)
        return result

    def accepted(self, text, *arguments):
        result = self.hemoscale("check", self.write_case(text), *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def run_figures(self, text, *arguments):
        case = self.write_case(text)
        self.run_case(case, "--results", self.folder / "results", *arguments)
        return figures(self.folder / "results")

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

    def test_every_integrator_runs(self):
        for name, more in INTEGRATORS.items():
            with self.subTest(name):
                seen = self.run_figures(with_micro(CHANNEL, f'integrator = "{name}"', more))
                self.assertLessEqual(seen["time step"], 0.81 * seen["limit of the time step"])
                self.assertEqual(seen["overlapping pairs of cells at the end"], 0)

    def test_forced_run_says_so(self):
        text = with_micro(CHANNEL, 'integrator = "explicit"', 'time_step = "0.02 ms"')
        limit = float(re.search(r"exceeds (\S+) s", self.refused(text, "micro.time_step").stderr)[1])
        text = text.replace('"0.02 ms"', f'"{1.01 * limit} s"')
        self.run_figures(lasting(text, "0.2 ms", "0.1 ms"), "--force")
        self.assertIn("forced", " ".join(summary(self.folder / "results")["warnings"]))

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

    def test_migration_moves_cells_and_is_named(self):
        still = self.run_figures(lasting(CHANNEL, "0.2 s", "0.1 s"))
        name = "mean square distance of the cells from the axis"
        rate = "rate of the mean square distance by lift laws"
        self.assertEqual(still[rate], 0)
        for law, value, source in (("wall_lift", 0.1, "Olla"), ("shear_lift", 0.153, "Coupier"), ("shear_diffusion", 0.02, "Leighton")):
            with self.subTest(law):
                text = with_micro(CHANNEL, f"migration.{law} = {value}", 'list_skin = "0.5 um"')
                seen = self.run_figures(lasting(text, "0.2 s", "0.1 s"))
                self.assertIn(source, " ".join(summary(self.folder / "results")["statements"]))
                if law != "shear_diffusion":
                    self.assertLess(seen[rate], 0)
                    # Between the outputs the rate is nearly constant.
                    change = (seen[name] - seen[name + " at the first output"]) / 0.2
                    other = (still[name] - still[name + " at the first output"]) / 0.2
                    self.assertAlmostEqual(change - other, seen[rate], delta=0.15 * abs(seen[rate]))
                else:
                    self.assertNotEqual(seen[rate], 0)

    def test_rates_by_cause_are_the_rate_of_the_mean_square_distance(self):
        text = with_micro(CHANNEL, 'integrator = "explicit"', 'precision = "double"', 'time_step = "0.2 us"',
                          "platelets.per_cell = 3")
        self.run_figures(lasting(text, "6 us", "0.2 us"))
        series = table(self.folder / "results" / "series.csv")
        for kind in ("", "platelets: "):
            square = series[kind + "mean square distance of the cells from the axis"]
            rates = kind + "rate of the mean square distance by "
            parts = {cause: series[rates + cause] for cause in ("attraction", "repulsion", "other kinds", "walls")}
            self.assertGreater(min(map(abs, parts["other kinds"])), 0)
            for n in range(1, len(square)):
                # Forces at the end of an explicit step are those that move the nodes in the next.
                change = (square[n] - square[n - 1]) / (series["time"][n] - series["time"][n - 1])
                total = sum(part[n - 1] for part in parts.values())
                size = sum(abs(part[n - 1]) for part in parts.values())
                self.assertAlmostEqual(change, total, delta=5e-4 * size)

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
        dense = CHANNEL.replace('kind = "lattice"', 'kind = "random"').replace("hematocrit = 0.3", "hematocrit = 0.74")
        result = self.hemoscale("run", self.write_case(dense))
        self.assert_refused(result, 2, "micro.packing.kind", "case.toml:", "lower the hematocrit")

    def test_late_lists_are_told(self):
        text = with_micro(CHANNEL, 'list_skin = "0.02 um"', "migration.shear_diffusion = 0.5")
        seen = self.run_figures(text)
        self.assertGreater(seen["rebuilds that came late"], 0)
        self.assertIn("micro.list_skin", " ".join(summary(self.folder / "results")["warnings"]))

    def test_exchange_interval_reaches_the_model(self):
        seen = self.run_figures(with_micro(CHANNEL, "regions.exchange_interval = 7"))
        self.assertEqual(seen["steps between exchanges of copies"], 7)

    def test_variants_of_the_vessel_are_sound(self):
        case = CASES / "vessel-ensemble"
        for name in ["", *tomllib.loads((case / "case.toml").read_text(encoding="utf-8"))["variant"]]:
            with self.subTest(name):
                result = self.hemoscale("check", case, *(["--variant", name] if name else []))
                self.assertEqual(result.returncode, 0, result.stderr)
                self.assertIn("limit of the time step", result.stdout)


if __name__ == "__main__":
    unittest.main()
