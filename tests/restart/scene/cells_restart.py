#!/usr/bin/python3
"""A run of cells in plasma that is continued from its checkpoint gives the bits of one in one go."""

import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from cell_case import CELLS, SHEAR  # noqa: E402
from command_line import CommandLineTest  # noqa: E402

IMMERSED = CELLS.replace('"implicit"', '"immersed"').replace(
    "nodes = 40", 'nodes = 40\nstretch_law = "linear"\nstretch_modulus = "1e-4 N/m"')


class Restart(CommandLineTest):
    def test_continues_with_the_same_bits(self):
        for name, text, half in (("channel", CELLS, "0.2 ms"), ("shear", SHEAR, "50 ms"),
                                 ("immersed", IMMERSED, "0.2 ms")):
            with self.subTest(name):
                case = self.write_case(text, name)
                whole, parts = self.folder / f"{name}-whole", self.folder / f"{name}-parts"
                self.run_case(case, "--results", whole)
                self.run_case(case, "--results", parts, "--set", f"micro.duration={half}")
                self.run_case(case, "--results", parts, "--restart")
                for file in ("series.csv", "cells.csv", "modes.csv", "flow.csv"):
                    self.assertEqual((whole / file).read_bytes(), (parts / file).read_bytes(), file)


if __name__ == "__main__":
    unittest.main()
