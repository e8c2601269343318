"""Runs on 1, 2 and 3 ranks give the same law to the bit; a failure on one rank ends all of them."""

import os
import pathlib
import shutil
import subprocess
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from command_line import PROGRAM, CommandLineTest, figures  # noqa: E402

CASE = """
[case]
name = "ranks"
[fluid]
hematocrit = 0.3
[macro.channel]
height = "60 um"
mean_velocity = "2 mm/s"
[sampling]
across = 3
closest_to_axis = 0.4
[coupling]
maximum_passes = 3
[micro]
cells = 6
nodes = 24
contact.stiffness = "4 Pa"
contact.rest_distance = "0.7 um"
contact.cutoff = "1 um"
[micro.run]
warm_up_strain = 1
minimum_strain = 2
maximum_strain = 3
[output]
trajectory = false
"""


def mpirun(ranks, *arguments):
    command = ["mpirun", "-np", str(ranks), "--oversubscribe", "--bind-to", "none", "--mca", "mpi_yield_when_idle", "1"]
    if os.geteuid() == 0:
        command.append("--allow-run-as-root")
    return subprocess.run(
        [*command, PROGRAM, *map(str, arguments)], capture_output=True, text=True, timeout=200, check=False
    )


@unittest.skipUnless(shutil.which("mpirun") or os.environ.get("REQUIRE_MPI"), "mpirun is not installed")
class Ranks(CommandLineTest):
    def test_same_bits_on_any_number_of_ranks(self):
        case = self.write_case(CASE)
        for ranks in (1, 2, 3):
            result = mpirun(ranks, "run", case, "--results", self.folder / str(ranks))
            self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        for ranks in ("2", "3"):
            self.assertEqual(figures(self.folder / "1"), figures(self.folder / ranks))
            for name in ("law.csv", "samples.csv", "series.csv"):
                one, other = (self.folder / n / name for n in ("1", ranks))
                self.assertEqual(one.read_bytes(), other.read_bytes(), name)

    def test_failing_micro_run_ends_all_ranks_with_one_message(self):
        # Forced far beyond the explicit limit.
        case = self.write_case(CASE.replace("nodes = 24", 'nodes = 24\ntime_step = "0.2 ms"'))
        result = mpirun(2, "run", case, "--force")
        self.assertNotEqual(result.returncode, 0)
        self.assertEqual(result.stderr.count("hemoscale: "), 1, result.stderr)
        self.assertIn("rank ", result.stderr)

    def test_bad_case_gives_one_message(self):
        case = self.write_case(CASE.replace("hematocrit = 0.3", "hematocrit = 3"))
        result = mpirun(2, "run", case)
        self.assertNotEqual(result.returncode, 0)
        self.assertEqual(result.stderr.count("fluid.hematocrit"), 1, result.stderr)

    def test_micro_scene_refuses_several_ranks(self):
        case = self.write_case(
            CASE.split("[macro.channel]")[0]
            + '[scene]\nkind = "micro"\n[micro]\nshear_rate = "10 1/s"\nduration = "1 ms"\noutput_interval = "1 ms"\n'
        )
        result = mpirun(2, "run", case)
        self.assertNotEqual(result.returncode, 0)
        self.assertIn("without mpirun", result.stderr)


if __name__ == "__main__":
    unittest.main()
