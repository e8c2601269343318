"""A chart and a map of a real case: explicit Euler is of first order, and its limit is the real one."""

import csv
import math
import pathlib
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from command_line import CommandLineTest, figures, summary  # noqa: E402
from small_case import SMALL  # noqa: E402

STUDY = """
[study]
name = "steps"
timeout = "1 min"
[error]
figure = "shear stress in the last interval"
against = "finest"
[refine]
key = "micro.time_step"
values = ["4 us", "2 us", "1 us", "0.125 us"]
[[series]]
name = "soft"
[[series]]
name = "stiff"
set = { "micro.membrane.stretch_modulus" = "2e-5 N/m" }
[map]
key = "micro.time_step"
stable = "2 us"
unstable = "2 ms"
tolerance = 0.1
predicted = "limit of the time step"
"""

HAS_MATPLOTLIB = (
    subprocess.run(["/usr/bin/python3", "-c", "import matplotlib"], check=False, capture_output=True).returncode == 0
)


def rows(path):
    """Rows of a table of a study as dictionaries, units in their names."""
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


class Chart(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.case = self.write_case(SMALL)

    def chart(self, study, *arguments):
        """Runs a study; without matplotlib it must say so, and the tables must be there all the same."""
        (self.case / "study.toml").write_text(study, encoding="utf-8")
        result = self.hemoscale("chart", self.case, *arguments)
        if HAS_MATPLOTLIB:
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        else:
            self.assert_refused(result, 3, "matplotlib", "tables are written")
        return result

    def assert_picture(self, name):
        if HAS_MATPLOTLIB:
            path = self.case / "results" / "steps" / name
            self.assertEqual(path.read_bytes()[:4], b"\x89PNG")
            self.assertGreater(path.stat().st_size, 20000)

    def test_chart(self):
        result = self.chart(STUDY)
        results = self.case / "results" / "steps"
        table = rows(results / "chart.csv")
        self.assertEqual([row["series"] for row in table], ["soft"] * 4 + ["stiff"] * 4)
        error = "error of shear stress in the last interval [-]"
        for row in table:
            self.assertEqual(row["status"], "finished")
            self.assertGreater(float(row["cpu time [s]"]), 0)
            steps = float(row["steps [-]"])
            self.assertAlmostEqual(steps * float(row["micro.time_step [s]"]), 16e-3, places=6)
            found = figures(results / row["folder"] / "results")
            name = "shear stress in the last interval"
            self.assertEqual(found[name], float(row[name + " [Pa]"]))
        finest = float(table[3]["shear stress in the last interval [Pa]"])
        first = float(table[0]["shear stress in the last interval [Pa]"])
        self.assertAlmostEqual(float(table[0][error]), abs(first - finest) / finest, places=15)
        self.assertEqual(table[3][error], "")
        orders = rows(results / "orders.csv")
        self.assertEqual([row["curve"] for row in orders], ["soft", "stiff"])
        for row in orders:
            # Against a reference eight times finer than the last run the order of Euler is
            # ln((4 - 1/8) / (1 - 1/8)) / ln 4 = 1.07 over the whole axis.
            self.assertAlmostEqual(float(row["order [-]"]), 1.07, delta=0.1)
            self.assertEqual(row["points [-]"], "3")
        best = [float(row[error]) for row in table if row["on front"] == "yes"]
        self.assertIn(min(float(row[error]) for row in table if row[error]), best)
        self.assertIn("order", result.stdout)
        self.assert_picture("chart.png")

    def test_second_command_keeps_every_run(self):
        self.chart(STUDY)
        before = (self.case / "results" / "steps" / "chart.csv").read_bytes()
        again = self.chart(STUDY)
        self.assertEqual(again.stdout.count("(earlier run)"), 8)
        self.assertEqual(before, (self.case / "results" / "steps" / "chart.csv").read_bytes())
        listed = self.chart(STUDY.replace('"2 us", ', '"2 us", "1.5 us", '), "--list")
        self.assertEqual(listed.stdout.count(": finished\n"), 8)
        self.assertEqual(listed.stdout.count(": to be run\n"), 2)

    def test_map(self):
        self.chart(STUDY, "--map", "--jobs", "2")
        for row in rows(self.case / "results" / "steps" / "map.csv"):
            self.assertEqual(row["outcome"], "found")
            stable, unstable = float(row["stable [s]"]), float(row["unstable [s]"])
            self.assertLess(stable, unstable)
            self.assertLessEqual(unstable, 1.1 * stable)
            self.assertAlmostEqual(float(row["boundary [s]"]), math.sqrt(stable * unstable), delta=1e-12)
            # The estimate keeps to the safe side, by no more than a half.
            self.assertGreater(float(row["boundary / predicted [-]"]), 1)
            self.assertLess(float(row["boundary / predicted [-]"]), 1.5)
            self.assertIn("time step", row["message"])
        self.assert_picture("map.png")

    def test_without_matplotlib_the_tables_are_there_and_the_reason_is_told(self):
        (self.folder / "matplotlib.py").write_text("raise ImportError('no matplotlib here')")
        study = STUDY.replace('"2 us", "1 us", ', "")
        (self.case / "study.toml").write_text(study, encoding="utf-8")
        hidden = {"PYTHONPATH": str(self.folder)}
        result = self.hemoscale("chart", self.case, environment=hidden)
        self.assert_refused(result, 3, "no matplotlib here", "python3-matplotlib", "tables are written")
        self.assertEqual(len(rows(self.case / "results" / "steps" / "chart.csv")), 4)

    def test_runs_that_fail_are_part_of_the_chart(self):
        study = STUDY.replace('name = "steps"', 'name = "steps"\nforce = true').replace('"4 us"', '"0.2 ms"')
        self.chart(study)
        table = rows(self.case / "results" / "steps" / "chart.csv")
        self.assertEqual([row["status"] for row in table[:4]], ["failed"] + ["finished"] * 3)
        self.assertIn("time step", table[0]["message"])
        self.assertEqual(table[0]["error of shear stress in the last interval [-]"], "")
        self.assert_picture("chart.png")

    def test_options_of_a_run_count_as_given(self):
        result = self.run_case(self.case, "--set", "micro.cells=3", "--set", "micro.time_step=5 us", "--results", self.folder / "set")
        self.assertEqual(result.returncode, 0)
        found = summary(self.folder / "set")
        self.assertEqual(found["settings"]["micro.cells"], "3")
        self.assertEqual(found["settings"]["micro.time_step"], "5e-06")
        self.assertGreater(found["timings"]["process"]["cpu [s]"], 0)
        names = figures(self.folder / "set")
        self.assertEqual(names["time step"], 5e-6)
        self.assertGreater(names["limit of the time step"], 5e-6)
        self.run_case(self.case, "--results", self.folder / "plain")
        self.assertNotEqual(found["identity"], summary(self.folder / "plain")["identity"])
        self.assertIn("micro: 3 cells", self.hemoscale("check", "--set", "micro.cells=3", self.case).stdout)


if __name__ == "__main__":
    unittest.main()
