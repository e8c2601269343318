"""A chart that is killed (SIGKILL) leaves nothing broken: started again, it keeps the runs that were
finished and makes the one that was interrupted anew."""

import pathlib
import signal
import subprocess
import sys
import time
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from command_line import PROGRAM, CommandLineTest  # noqa: E402
from small_case import SMALL  # noqa: E402

CASE = SMALL.replace("16 ms", "40 ms").replace("8 ms", "10 ms")

# The last run would take minutes; it is never finished.
STUDY = """[study]
name = "killed"
[error]
figure = "shear stress in the last interval"
[refine]
key = "micro.time_step"
values = ["4 us", "2 us", "LAST"]
"""


class KilledChart(CommandLineTest):
    def test_kill_and_start_again(self):
        case = self.write_case(CASE)
        study = case / "study.toml"
        runs = case / "results" / "killed" / "runs"
        study.write_text(STUDY.replace("LAST", "0.2 ns"), encoding="utf-8")
        with subprocess.Popen([PROGRAM, "chart", str(case)], stdout=subprocess.DEVNULL) as process:
            deadline = time.monotonic() + 60
            while time.monotonic() < deadline:
                begun = list(runs.glob("*0.2-ns*/results/series.csv"))
                if begun and process.poll() is None:
                    break
                time.sleep(0.01)
            self.assertIsNone(process.poll(), "the study ended before it could be killed")
            process.send_signal(signal.SIGKILL)
            process.wait()
        records = {path: path.read_bytes() for path in runs.glob("*/record.json")}
        self.assertEqual(len(records), 2)
        interrupted = next(runs.glob("*0.2-ns*"))
        self.assert_ends(str(interrupted))

        # The lock is free, finished runs are kept, the interrupted one is not taken for a result.
        listed = self.hemoscale("chart", case, "--list")
        self.assertEqual(listed.returncode, 0, listed.stderr)
        self.assertEqual(listed.stdout.count(": finished"), 2)
        self.assertEqual(listed.stdout.count(": to be run"), 1)
        study.write_text(STUDY.replace("LAST", "1 us"), encoding="utf-8")
        again = self.hemoscale("chart", case)
        self.assertIn(again.returncode, (0, 3), again.stderr)  # 3 without matplotlib
        self.assertEqual(again.stdout.count("(earlier run)"), 2)
        for path, content in records.items():
            self.assertEqual(path.read_bytes(), content)

    def assert_ends(self, argument):
        """The child process of the killed command must be gone soon."""
        deadline = time.monotonic() + 20
        while time.monotonic() < deadline:
            alive = False
            for entry in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
                try:
                    alive = alive or argument.encode() in entry.read_bytes()
                except OSError:
                    pass
            if not alive:
                return
            time.sleep(0.05)
        self.fail("the run outlived the command that started it")


if __name__ == "__main__":
    unittest.main()
