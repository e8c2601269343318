"""Every variant of cases/plasma-verification and cases/capillary-plasma keeps what its README promises."""

import pathlib
import sys
import unittest

ROOT = pathlib.Path(__file__).parents[3]
sys.path.insert(0, str(ROOT / "tests" / "support"))
from command_line import CommandLineTest, figures  # noqa: E402

VELOCITY = "relative L2 error of velocity"
PRESSURE = "relative L2 error of pressure"


class PlasmaVerification(CommandLineTest):
    case = ROOT / "cases" / "plasma-verification"

    def run_variant(self, variant, *changes):
        results = self.folder / variant
        settings = [part for change in changes for part in ("--set", change)]
        self.run_case(self.case, "--variant", variant, "--results", results, *settings)
        return figures(results)

    def assert_error(self, variant, bound, *changes, name=VELOCITY):
        error = self.run_variant(variant, *changes)[name]
        self.assertGreater(error, 0)
        self.assertLess(error, bound)

    def test_start_up(self):
        self.assert_error("start-up", 4e-3)

    def test_poiseuille(self):
        self.assert_error("poiseuille", 1e-10)

    def test_couette(self):
        self.assert_error("couette", 1e-3)

    def test_womersley(self):
        self.assert_error("womersley", 1e-2)

    def test_inlet(self):
        found = self.run_variant("inlet")
        self.assertLess(found[VELOCITY], 1e-5)
        self.assertAlmostEqual(found["flow rate downstream"] / 1e-7, 1, delta=1e-5)
        self.assertAlmostEqual(found["pressure drop"] / 72, 1, delta=1e-5)
        self.assertAlmostEqual(found["wall shear stress"] / 6, 1, delta=1e-4)

    def test_taylor_green(self):
        self.assert_error("taylor-green", 5e-3)

    def test_taylor_green_in_space(self):
        self.assert_error("taylor-green-3d", 0.06)

    def test_shear_box(self):
        self.assert_error("shear-box", 1e-4)

    def test_column(self):
        found = self.run_variant("column")
        self.assertLess(found[PRESSURE], 1e-10)
        self.assertLess(found[VELOCITY], 1e-10)

    def test_rotating_patch(self):
        found = self.run_variant("rotating-patch", "micro.duration=0.05")
        self.assertAlmostEqual(found["central pressure coefficient"], -0.147343, delta=0.003)
        self.assertAlmostEqual(found["kinetic energy over its start"], 1, delta=0.005)

    def test_cylinder(self):
        self.assertAlmostEqual(self.run_variant("cylinder")["drag coefficient"] / 27.895125, 1, delta=0.02)

    def test_shaped_channels_keep_their_flux(self):
        for variant in ("constriction", "bifurcation"):
            self.assertLess(self.run_variant(variant)["relative loss of flow rate"], 1e-4)

    def test_pipe(self):
        self.assert_error("pipe", 1e-9)


class CapillaryPlasma(CommandLineTest):
    case = ROOT / "cases" / "capillary-plasma"

    def test_default(self):
        self.run_case(self.case, "--results", self.folder / "r")
        found = figures(self.folder / "r")
        self.assertLess(found[VELOCITY], 1e-5)
        self.assertEqual(found["particles"], 3381)

    def test_channel_of_the_thrombus(self):
        self.run_case(self.case, "--variant", "thrombus-channel", "--results", self.folder / "r")
        self.assertLess(figures(self.folder / "r")[VELOCITY], 1e-4)

    def test_paper_begins(self):
        self.run_case(
            self.case, "--variant", "paper", "--results", self.folder / "r",
            "--set", "micro.duration=1 us", "--set", "micro.output_interval=1 us",
        )
        self.assertGreater(figures(self.folder / "r")["particles"], 4500)


if __name__ == "__main__":
    unittest.main()
