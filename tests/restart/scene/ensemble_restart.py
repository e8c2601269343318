"""An ensemble on vectors that is continued ends with the same bits, whatever its integrator and laws."""

import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from ensemble_case import CHANNEL, INTEGRATORS, EnsembleTest, with_micro  # noqa: E402


class EnsembleRestart(EnsembleTest):
    def same_after_restart(self, text):
        case = self.write_case(text)
        whole = self.folder / "whole"
        parts = self.folder / "parts"
        self.run_case(case, "--results", whole)
        self.run_case(case, "--results", parts, "--set", 'micro.duration="2 ms"')
        self.run_case(case, "--results", parts, "--restart")
        for name in ("series.csv", "red-cells.csv", "concentration.csv", "profile.csv"):
            self.assertEqual((whole / name).read_bytes(), (parts / name).read_bytes(), name)

    def test_every_integrator(self):
        for name, more in INTEGRATORS.items():
            with self.subTest(name):
                self.same_after_restart(with_micro(CHANNEL, f'integrator = "{name}"', more))

    def test_a_random_walk(self):
        self.same_after_restart(with_micro(CHANNEL, "migration.shear_diffusion = 0.1", 'list_skin = "0.5 um"'))

    def test_with_platelets(self):
        self.same_after_restart(with_micro(CHANNEL, "platelets.per_cell = 0.5"))


if __name__ == "__main__":
    unittest.main()
