"""A run that is killed (SIGKILL) and continued ends with the same figures, to the last bit."""

import pathlib
import signal
import subprocess
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from command_line import PROGRAM, CommandLineTest, figures, table  # noqa: E402

COUPLED = """
[case]
name = "killed"
seed = 5
[fluid]
hematocrit = 0.3
[macro.channel]
height = "60 um"
mean_velocity = "2 mm/s"
[sampling]
across = 3
closest_to_axis = 0.4
distinct_ratio = 1.02
[coupling]
memory = "latest"
maximum_passes = 6
tolerance = 1e-9
[micro]
cells = 6
nodes = 24
contact.stiffness = "4 Pa"
contact.rest_distance = "0.7 um"
contact.cutoff = "1 um"
[micro.run]
warm_up_strain = 1
minimum_strain = 3
maximum_strain = 6
relative_standard_error = 1e-6
[output]
trajectory_interval = 1
"""

MICRO = """
[case]
name = "killed-micro"
[scene]
kind = "micro"
[fluid]
hematocrit = 0.3
[micro]
cells = 8
nodes = 24
shear_rate = "100 1/s"
duration = "4 s"
output_interval = "50 ms"
contact.stiffness = "4 Pa"
contact.rest_distance = "0.7 um"
contact.cutoff = "1 um"
[output]
checkpoint_interval = "0.05 s"
"""


class KillAndRestart(CommandLineTest):
    def kill_when(self, case, results, is_time):
        """Starts a run and kills it as soon as is_time(); it must not have ended by itself."""
        with subprocess.Popen(
            [PROGRAM, "run", str(case), "--results", str(results)],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        ) as process:
            deadline = time.monotonic() + 100
            while not is_time() and process.poll() is None and time.monotonic() < deadline:
                time.sleep(0.005)
            process.send_signal(signal.SIGKILL)
            return process.wait()

    def check(self, text, checkpoints_before_kill):
        case = self.write_case(text)
        whole = self.folder / "whole"
        broken = self.folder / "broken"
        self.run_case(case, "--results", whole)
        status = self.kill_when(
            case,
            broken,
            lambda: len(list(broken.glob("checkpoint-*.h5"))) >= checkpoints_before_kill
            if broken.is_dir()
            else False,
        )
        self.assertEqual(status, -signal.SIGKILL, "the run ended before it could be killed")
        self.assertFalse((broken / "summary.json").exists())
        self.run_case(case, "--results", broken, "--restart")
        self.assertEqual(figures(whole), figures(broken))
        self.assertEqual(table(whole / "series.csv"), table(broken / "series.csv"))

    def test_coupled(self):
        self.check(COUPLED, 2)

    def test_micro_scene(self):
        self.check(MICRO, 2)

    def test_restart_without_checkpoint_is_refused(self):
        case = self.write_case(MICRO)
        result = self.hemoscale("run", case, "--results", self.folder / "none", "--restart")
        self.assert_refused(result, 3, "no checkpoint", "--restart")


if __name__ == "__main__":
    unittest.main()
