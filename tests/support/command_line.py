"""Runs the program as a user does, on cases that a test writes.

The program is named by the environment variable HEMOSCALE, which CTest sets.
"""

import csv
import json
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

PROGRAM = os.environ.get("HEMOSCALE", "hemoscale")


class CommandLineTest(unittest.TestCase):
    """A test with a folder of its own that is removed afterwards."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="hemoscale-test-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)

    def write_case(self, text, name="case"):
        folder = self.folder / name
        folder.mkdir(exist_ok=True)
        (folder / "case.toml").write_text(text, encoding="utf-8")
        return folder

    def hemoscale(self, *arguments, environment=None, timeout=300):
        """Result of a run of the program: returncode, stdout, stderr."""
        return subprocess.run(
            [PROGRAM, *map(str, arguments)],
            capture_output=True,
            text=True,
            timeout=timeout,
            check=False,
            env={**os.environ, **(environment or {})},
        )

    def run_case(self, case, *arguments, **options):
        """A run that must succeed; returns its summary."""
        result = self.hemoscale("run", case, *arguments, **options)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return result

    def assert_refused(self, result, code, *fragments):
        """The program must have ended with this code and a message that holds every fragment."""
        self.assertEqual(result.returncode, code, result.stdout + result.stderr)
        for fragment in fragments:
            self.assertIn(fragment, result.stderr)
        for trace in ("terminate called", "Segmentation", "core dumped"):
            self.assertNotIn(trace, result.stderr)


def summary(results):
    return json.loads((pathlib.Path(results) / "summary.json").read_text(encoding="utf-8"))


def figures(results):
    """Figures of a summary by name."""
    found = summary(results)["figures"]
    if isinstance(found, dict):
        return {name: figure["value"] for name, figure in found.items()}
    return {figure["name"]: figure["value"] for figure in found}


def table(path):
    """Columns of a CSV file by the name in its header, unit removed."""
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    names = [name.split(" [")[0] for name in rows[0]]
    return {name: [float(row[k]) for row in rows[1:]] for k, name in enumerate(names)}
