#!/usr/bin/python3
"""The cases of single cells keep what their READMEs promise."""

import pathlib
import sys
import unittest

ROOT = pathlib.Path(__file__).parents[3]
sys.path.insert(0, str(ROOT / "tests" / "support"))
from command_line import CommandLineTest, figures, table  # noqa: E402


class Cells(CommandLineTest):
    def figures_of(self, name, *arguments):
        results = self.folder / "results"
        self.run_case(ROOT / "cases" / name, "--results", results, *arguments)
        return figures(results)

    def test_the_cell_becomes_a_parachute(self):
        found = self.figures_of("capillary-red-cell")
        self.assertLess(abs(found["cell 0: area error"]), 1e-6)
        self.assertLess(abs(found["cell 0: perimeter error"]), 1e-3)
        self.assertAlmostEqual(found["cell 0: velocity over mean speed"], 1.322, delta=0.003)
        self.assertGreater(found["cell 0: rear dimple depth"], 1e-6)
        way = table(self.folder / "results" / "series.csv")["cell 0: position along the flow"]
        self.assertGreater(way[-1] - way[0], 60e-6)

    def test_steady_parachute_of_the_reference(self):
        found = self.figures_of("capillary-red-cell", "--variant", "reference-1",
                                "--set", "micro.plasma.spacing=1 um")
        # reference/parachute.csv, alpha 0.70, Es 5e-5 N/m, Eb 2e-18 J
        self.assertAlmostEqual(found["cell 0: velocity over mean speed"] / 1.2336, 1, delta=0.005)
        self.assertAlmostEqual(found["cell 0: length"] * 1e6, 4.4588, delta=0.05)
        self.assertAlmostEqual(found["cell 0: width"] * 1e6, 6.6304, delta=0.05)
        self.assertAlmostEqual(found["cell 0: smallest gap"] * 1e6 / 1.6848, 1, delta=0.03)
        self.assertAlmostEqual(found["extra pressure drop"] / 0.26678, 1, delta=0.03)
        self.assertAlmostEqual(
            found["cell 0: settling time of velocity along the flow"] / 16.743e-3, 1, delta=0.1)

    def test_tank_treading(self):
        found = self.figures_of("shear-red-cell")
        # reference/shear.csv, alpha 0.70, Ca_b 1
        self.assertEqual(found["cell 0: tumbles"], 0)
        self.assertAlmostEqual(found["cell 0: inclination"] * 57.29578, 21.9907, delta=0.1)
        self.assertAlmostEqual(found["intrinsic viscosity"] / 1.50915, 1, delta=0.01)
        self.assertAlmostEqual(found["intrinsic normal stress difference"] / 2.32947, 1, delta=0.01)
        self.assertAlmostEqual(-found["cell 0: tank-treading rate"] / 32.163, 1, delta=0.01)

    def test_tumbling(self):
        found = self.figures_of("shear-red-cell", "--variant", "tumbling")
        self.assertEqual(found["cell 0: tumbles"], 1)
        self.assertGreater(found["cell 0: tumbling period"], 0)


if __name__ == "__main__":
    unittest.main()
