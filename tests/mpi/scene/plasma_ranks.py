"""A plasma on 1, 2 and 3 ranks is the same within the tolerance of the solvers."""

import os
import pathlib
import shutil
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from command_line import CommandLineTest, figures  # noqa: E402
from plasma_case import PLASMA  # noqa: E402
from ranks import mpirun  # noqa: E402

CASE = PLASMA.replace("periodic-channel", "open-channel").replace(
    'length = "20 um"', 'length = "30 um"\ndisorder = 0.1\ntime_step = "5 us"'
)


@unittest.skipUnless(shutil.which("mpirun") or os.environ.get("REQUIRE_MPI"), "mpirun is not installed")
class PlasmaRanks(CommandLineTest):
    def compare(self, tolerance, *settings):
        case = self.write_case(CASE)
        arguments = [part for setting in settings for part in ("--set", setting)]
        found = []
        for ranks in (1, 2, 3):
            results = self.folder / str(ranks)
            result = mpirun(ranks, "run", case, "--results", results, *arguments)
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
            found.append(figures(results))
        for name, value in found[0].items():
            for other in found[1:]:
                self.assertAlmostEqual(other[name], value, delta=tolerance * abs(value) + 1e-30, msg=name)

    def test_coupled_solver_gives_the_same_bits(self):
        self.compare(0)

    def test_projection_agrees_to_the_tolerance(self):
        self.compare(1e-6, "micro.plasma.coupling=incremental", "micro.plasma.inlet=parabolic")

    def test_moving_nodes_agree(self):
        self.compare(1e-6, "micro.plasma.scheme=moving", "micro.plasma.inlet=parabolic")

    def test_particle_method_says_that_it_runs_on_one(self):
        case = self.write_case(CASE.replace("disorder = 0.1", ""))
        result = mpirun(2, "run", case, "--results", self.folder / "r", "--set", "micro.plasma.scheme=paper",
                        "--set", "micro.plasma.time_step=0.05 us", "--set", "micro.plasma.relaxation=0.2")
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("runs on one process", result.stdout + result.stderr)


if __name__ == "__main__":
    unittest.main()
