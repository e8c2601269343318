"""Cells pass the bifurcation of cases/vessel-ensemble: exact counts, restart, refusals."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from command_line import PROGRAM, CommandLineTest, figures, summary, table  # noqa: E402

REQUIRED = os.environ.get("REQUIRE_OPENFOAM")
HAS_OPENFOAM = os.environ.get("HEMOSCALE_HAS_PLUGIN") == "1" and shutil.which("simpleFoam")
BIFURCATION = pathlib.Path(__file__).parents[3] / "cases" / "vessel-ensemble" / "bifurcation"

CASE = """[case]
name = "fed"
seed = 3
[scene]
kind = "micro"
[fluid]
hematocrit = 0.15
[micro]
domain = "geometry"
nodes = 24
duration = "0.24 s"
output_interval = "20 ms"
time_step = "10 us"
[micro.flow]
kind = "openfoam"
case = "bifurcation"
length_unit = "1 um"
time_unit = "1 ms"
grid_spacing = "3 um"
inlet = "inlet"
outlets = "upper, lower"
overhang = "16 um"
settling_time = "0.15 s"
[micro.membrane]
stretch_modulus = "1e-4 N/m"
# So few nodes fold over the nose of the divider unless they are stiff.
bending_modulus = "5e-18 J"
[micro.contact]
stiffness = "200 Pa"
rest_distance = "0.6 um"
cutoff = "1 um"
[micro.wall]
stiffness = "500 Pa"
[output]
checkpoint_interval = "1000 s"
"""


@unittest.skipUnless(HAS_OPENFOAM or REQUIRED, "OpenFOAM or the plug-in is missing")
class FedBifurcation(CommandLineTest):
    @classmethod
    def setUpClass(cls):
        """The flow, solved once on a coarse mesh and not to the end."""
        cls.solved = pathlib.Path(tempfile.mkdtemp(prefix="hemoscale-test-"))
        cls.addClassCleanup(shutil.rmtree, cls.solved, ignore_errors=True)
        folder = cls.solved / "bifurcation"
        shutil.copytree(BIFURCATION, folder)
        control = folder / "system" / "controlDict"
        text = control.read_text(encoding="utf-8").replace("2000;", "100;")
        control.write_text(text, encoding="utf-8")
        environment = {"WM_PROJECT_DIR": "/usr/share/openfoam", **os.environ}
        for command in (["/usr/bin/python3", "geometry.py", "2.5"], ["blockMesh"], ["simpleFoam"]):
            subprocess.run(command, cwd=folder, env=environment, capture_output=True, check=True)

    def write_case(self, text, name="case"):
        folder = super().write_case(text, name)
        if not (folder / "bifurcation").exists():
            (folder / "bifurcation").symlink_to(self.solved / "bifurcation")
        return folder

    def test_cells_balance_exactly_and_a_restart_continues_with_the_same_bits(self):
        whole, broken = self.folder / "whole", self.folder / "broken"
        case = self.write_case(CASE)
        self.run_case(case, "--results", whole)
        series = table(whole / "series.csv")
        for entered, cells, upper, lower in zip(
            series["entered"], series["cells"], series["left through upper"], series["left through lower"]
        ):
            self.assertEqual(entered, cells + upper + lower)
        self.assertGreater(series["left through upper"][-1], series["left through lower"][-1])
        self.assertGreater(series["left through lower"][-1], 0)
        places = table(whole / "places.csv")
        last = places["time"][-1]
        self.assertEqual(sum(time == last for time in places["time"]), series["cells"][-1])
        self.assertEqual(len(series["time"]), 13)
        self.assertEqual(len(list((whole / "frames").glob("*.h5"))), 12)  # none of the empty vessel
        # In the parent, filled long ago, at about the hematocrit of the feed.
        there = sum(
            time == last and 20e-6 < x < 180e-6 for time, x in zip(places["time"], places["x"])
        )
        self.assertAlmostEqual(there * 13.3e-12 / (160e-6 * 75e-6), 0.15, delta=0.03)
        found = figures(whole)
        self.assertAlmostEqual(sum(found["flow share of " + o] for o in ("upper", "lower")), 1, delta=5e-3)
        self.assertAlmostEqual(sum(found["cell share of " + o] for o in ("upper", "lower")), 1, delta=1e-12)
        self.assertEqual(
            found["cells counted at upper"],
            found["cell share of upper"] * (found["cells counted at upper"] + found["cells counted at lower"]),
        )
        self.assertAlmostEqual(found["time from which cells are counted"], 0.15, delta=1e-12)
        # Parent, daughters, and what lies between them and the rounded corners.
        self.assertAlmostEqual(found["area of the fluid"], (15000 + 12750 + 1010) * 1e-12, delta=2e-10)
        hematocrit = found["cells between the openings"] * 13.6e-12 / found["area of the fluid"]
        self.assertAlmostEqual(found["tube hematocrit"], hematocrit, delta=0.03 * hematocrit)
        self.assertIn(
            "prescribed flow: no hydrodynamic interaction, no lift", summary(whole)["statements"]
        )

        self.run_case(case, "--results", broken, "--set", "micro.duration=160 ms")
        for _ in range(2):  # the second finds everything done
            self.run_case(case, "--results", broken, "--restart")
            self.assertEqual(figures(broken), found)
        for name in ("series.csv", "places.csv"):
            self.assertEqual((broken / name).read_bytes(), (whole / name).read_bytes(), name)

    def test_platelets_enter_in_proportion(self):
        results = self.folder / "results"
        more = ["--set", "micro.duration=66 ms", "--set", "micro.platelets.per_cell=0.5"]
        more += ["--set", "micro.flow.settling_time=0"]
        self.run_case(self.write_case(CASE), "--results", results, *more)
        found = figures(results)
        red = found["entered"] + found["waiting"]
        self.assertAlmostEqual(found["platelets: entered"] + found["platelets: waiting"], red / 2, delta=1.5)
        self.assertGreater(red, 50)
        # The last output ends a part of an interval.
        frames = sorted(path.name for path in (results / "frames").glob("*.h5"))
        self.assertEqual(frames, [f"cells-00000{n}.h5" for n in (1, 2, 3, 4)])
        self.assertEqual(len(table(results / "series.csv")["time"]), 5)
        self.assertIn("red cells were counted", "".join(summary(results)["warnings"]))

    def refuse(self, code, *fragments, **changes):
        text = CASE
        for before, after in changes.values():
            self.assertIn(before, text)
            text = text.replace(before, after)
        results = self.folder / "results"
        self.assert_refused(
            self.hemoscale("run", self.write_case(text), "--results", results), code, *fragments
        )
        shutil.rmtree(results, ignore_errors=True)

    def test_what_does_not_fit_is_refused(self):
        self.refuse(2, "micro.flow.inlet", "no opening \"entry\"", a=('"inlet"', '"entry"'))
        self.refuse(2, "micro.flow.outlets", "named twice", a=("upper, lower", "upper, upper"))
        self.refuse(2, "micro.time_step", "micro.flow.overhang", a=('"10 us"', '"1 ms"'))
        self.refuse(2, "micro.flow.inlet", "none can enter", a=('overhang', 'cell_free_layer = "40 um"\noverhang'))

    @unittest.skipUnless(shutil.which("mpirun"), "mpirun is not installed")
    def test_several_processes_are_refused(self):
        command = ["mpirun", "-np", "2", "--oversubscribe", "--bind-to", "none"]
        if os.geteuid() == 0:
            command.append("--allow-run-as-root")
        result = subprocess.run(
            [*command, PROGRAM, "run", str(self.write_case(CASE))], capture_output=True, text=True, check=False
        )
        self.assertNotEqual(result.returncode, 0)
        self.assertEqual(result.stderr.count("runs on one process, but 2 were started"), 1, result.stderr)


if __name__ == "__main__":
    unittest.main()
