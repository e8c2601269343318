"""What a user can get wrong in a plasma case is refused with its place, its value and a remedy."""

import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from command_line import CommandLineTest, summary  # noqa: E402
from plasma_case import PLASMA  # noqa: E402



class PlasmaBadInput(CommandLineTest):
    def refuse(self, *settings, fragments, case=PLASMA):
        arguments = [part for setting in settings for part in ("--set", setting)]
        self.assert_refused(self.hemoscale("check", self.write_case(case), *arguments), 2, *fragments)

    def test_good_case_is_good(self):
        result = self.hemoscale("check", self.write_case(PLASMA))
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertIn("Reynolds number 0.1", result.stdout)

    def test_missing_and_superfluous_keys_are_listed_together(self):
        self.refuse(
            "micro.plasma.flow=cylinder", "micro.plasma.gravity=1",
            fragments=["micro.plasma.radius: is missing; the flow \"cylinder\" needs it",
                       "micro.plasma.gravity: has no meaning for the flow \"cylinder\"", "2 faults"],
        )

    def test_choices_that_a_method_cannot_take(self):
        self.refuse(
            "micro.plasma.scheme=paper", "micro.plasma.motion=eulerian", "micro.plasma.coupling=coupled",
            "micro.plasma.stabilisation=10",
            fragments=["micro.plasma.motion: \"eulerian\" is not for the operators mps, cmps and gc",
                       "it takes chorin, incremental", "micro.plasma.stabilisation: has no meaning", "3 faults"],
        )
        self.refuse("micro.plasma.source=pnd",
                    fragments=["\"pnd\" is not for the operators lsmps2; it takes divergence"])

    def test_choices_that_exclude_each_other(self):
        self.refuse("micro.plasma.inertia=quasi-steady", "micro.plasma.coupling=incremental",
                    fragments=["quasi-steady flow needs the coupled solver"])
        self.refuse("micro.plasma.shifting=concentration", fragments=["resting nodes need no shifting"])

    def test_flows_of_one_method_alone(self):
        self.refuse("micro.plasma.flow=shear-box", "micro.plasma.scheme=repaired", "micro.plasma.rate=1",
                    fragments=["is resolved by the operators lsmps2 alone"])

    def test_domain_too_small_for_its_spacing(self):
        self.refuse("micro.plasma.spacing=4 um", fragments=["fewer than four spacings"])

    def test_values_out_of_range(self):
        self.refuse("micro.plasma.disorder=0.5", "micro.plasma.kernel_ratio=1",
                    fragments=["micro.plasma.disorder", "micro.plasma.kernel_ratio", "2 faults"])

    def test_unknown_key(self):
        self.refuse(case=PLASMA.replace("[output]", "spaceing = 1\n[output]"), fragments=["spaceing", "micro.plasma.spacing"])

    def test_coupled_scene(self):
        self.refuse(case=PLASMA.replace('kind = "micro"', 'kind = "coupled"').replace('duration = "20 us"', "").replace(
            'output_interval = "10 us"', "") + '[macro.channel]\nheight = "10 um"\nmean_velocity = "1 mm/s"\n',
                    fragments=["micro.model: \"plasma\" is a scene of its own"])

    def test_steps_beyond_a_limit(self):
        explicit = ("micro.plasma.viscosity=explicit", "micro.plasma.coupling=incremental",
                    "micro.plasma.time_scheme=euler", "micro.plasma.time_step=2 us")
        self.refuse(*explicit, fragments=["micro.plasma.time_step: viscous limit: 2e-06 s exceeds", "--force"])
        self.refuse("micro.plasma.time_step=0.1 ms", fragments=["advective limit", "reduce the time step"])
        self.refuse("micro.plasma.scheme=paper", "micro.plasma.time_step=2 us", fragments=["viscous limit"])

    def test_forced_run_tells_how_it_failed_and_keeps_what_it_has(self):
        case = self.write_case(PLASMA.replace('"20 us"', '"1 ms"'))
        results = self.folder / "results"
        settings = [part for setting in (
            "micro.plasma.viscosity=explicit", "micro.plasma.coupling=incremental", "micro.plasma.disorder=0.1",
            "micro.plasma.time_scheme=euler", "micro.plasma.time_step=1.5 us") for part in ("--set", setting)]
        result = self.hemoscale("run", case, "--force", "--results", results, *settings)
        self.assert_refused(result, 4, "step ", "viscous limit")
        self.assertIn("stopped: step", summary(results)["outcome"])
        for name in ("particles.csv", "series.csv"):
            self.assertGreater((results / name).stat().st_size, 100)
        self.assertTrue(list(results.glob("checkpoint-*.h5")))


if __name__ == "__main__":
    unittest.main()
