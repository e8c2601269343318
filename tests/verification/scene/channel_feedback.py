"""cases/channel-feedback at reduced size: what its README promises, on both variants.

The cells are fewer and the averages shorter than in the case itself; the agreement of the velocity
with the quadrature of the final law does not depend on either, and the agreement of the variants is
a matter of the same random streams.
"""

import json
import os
import pathlib
import shutil
import subprocess
import sys
import unittest

ROOT = pathlib.Path(__file__).parents[3]
sys.path.insert(0, str(ROOT / "tests" / "support"))
from command_line import CommandLineTest, figures  # noqa: E402

REDUCED = """
[variant.NAME.micro]
cells = 6
nodes = 24
contact.stiffness = "4 Pa"
contact.rest_distance = "0.7 um"
contact.cutoff = "1 um"
membrane.stretch_modulus = "5e-6 N/m"
[variant.NAME.micro.run]
warm_up_strain = 2
minimum_strain = 5
maximum_strain = 20
relative_standard_error = 0.05
"""

HAS_PLUGIN = os.environ.get("HEMOSCALE_HAS_PLUGIN") == "1"


class ChannelFeedback(CommandLineTest):
    def setUp(self):
        super().setUp()
        self.case = self.folder / "channel-feedback"
        shutil.copytree(ROOT / "cases" / "channel-feedback", self.case, ignore=shutil.ignore_patterns("results*"))
        file = self.case / "case.toml"
        text = file.read_text(encoding="utf-8")
        text += "".join(REDUCED.replace("NAME", name) for name in ("analytic", "implicit", "one-way", "openfoam"))
        file.write_text(text, encoding="utf-8")

    def compare(self, *variants):
        for variant in variants:
            self.run_case(self.case, "--variant", variant)
        result = subprocess.run(
            ["/usr/bin/python3", self.case / "compare.py", self.case / "results", *variants],
            capture_output=True, text=True, check=False,
        )
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertGreater((self.case / "results" / "channel-feedback.png").stat().st_size, 10000)
        return json.loads((self.case / "results" / "comparison.json").read_text(encoding="utf-8"))

    def test_schemes_on_the_analytic_flow(self):
        report = self.compare("analytic", "implicit")
        for variant in ("analytic", "implicit"):
            self.assertTrue(report["variants"][variant]["converged"])
            lowest = report["variants"][variant]["lowest and highest viscosity [Pa s]"][0]
            self.assertGreater(lowest, 1.2e-3, "cells must make blood more viscous than plasma")

    def test_one_way_measures_but_does_not_feed_back(self):
        self.run_case(self.case, "--variant", "one-way")
        found = figures(self.case / "results" / "one-way")
        self.assertAlmostEqual(found["wall shear rate"], 200, places=3)
        self.assertGreaterEqual(found["micro runs"], 5)

    @unittest.skipUnless(HAS_PLUGIN or os.environ.get("REQUIRE_OPENFOAM"), "the OpenFOAM plug-in is not built")
    def test_openfoam_agrees_with_the_analytic_flow(self):
        report = self.compare("openfoam", "analytic")
        self.assertTrue(report["variants"]["openfoam"]["converged"])
        self.assertLess(report["worst deviation"], 0.005)


if __name__ == "__main__":
    unittest.main()
