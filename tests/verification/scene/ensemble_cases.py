"""What the keys of an ensemble on vectors do to its runs: figures, warnings and statements of the program."""

import pathlib
import re
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from command_line import summary, table  # noqa: E402
from ensemble_case import CHANNEL, INTEGRATORS, EnsembleTest, lasting, with_micro  # noqa: E402


class EnsembleCases(EnsembleTest):
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

    def test_distance_from_the_nodes_of_another_run(self):
        name = "distance of the nodes from the reference"
        self.run_figures(CHANNEL + "nodes = true\n")
        nodes = self.folder / "results" / "nodes.csv"
        kept = self.folder / "kept.csv"
        nodes.rename(kept)
        text = CHANNEL + 'reference_nodes = "../kept.csv"\n'
        self.assertEqual(self.run_figures(text)[name], 0)
        # A tenth of the step: the error of the step, far below a cell and far above rounding.
        seen = self.run_figures(with_micro(text, 'time_step = "2 us"'))
        self.assertGreater(seen[name], 1e-13)
        self.assertLess(seen[name], 1e-8)
        # Every node 3 um to the right.
        lines = kept.read_text().splitlines()
        moved = [line.split(",") for line in lines[1:]]
        kept.write_text("\n".join([lines[0], *(f"{c},{float(x) + 3e-6},{y}" for c, x, y in moved)]) + "\n")
        self.assertAlmostEqual(self.run_figures(text)[name], 3e-6, delta=1e-12)
        kept.write_text("\n".join(lines[:-1]) + "\n")
        result = self.hemoscale("run", self.write_case(text), "--results", self.folder / "results")
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("output.reference_nodes", result.stderr)
        self.assertIn("479 rows", result.stderr)

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

    def test_late_lists_are_told(self):
        text = with_micro(CHANNEL, 'list_skin = "0.02 um"', "migration.shear_diffusion = 0.5")
        seen = self.run_figures(text)
        self.assertGreater(seen["rebuilds that came late"], 0)
        self.assertIn("micro.list_skin", " ".join(summary(self.folder / "results")["warnings"]))

    def test_exchange_interval_reaches_the_model(self):
        seen = self.run_figures(with_micro(CHANNEL, "regions.exchange_interval = 7"))
        self.assertEqual(seen["steps between exchanges of copies"], 7)


if __name__ == "__main__":
    unittest.main()
