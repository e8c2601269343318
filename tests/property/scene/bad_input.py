"""Every kind of bad input ends with one clear message and a non-zero status, and nothing is lost."""

import pathlib
import re
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from command_line import CommandLineTest, figures  # noqa: E402

GOOD = """[case]
name = "good"
[fluid]
hematocrit = 0.3
[macro.channel]
height = "60 um"
mean_velocity = "2 mm/s"
[sampling]
across = 2
closest_to_axis = 0.5
[coupling]
maximum_passes = 2
[micro]
model = "synthetic"
[micro.run]
maximum_strain = 50
"""

ENSEMBLE = """[case]
name = "ensemble"
[scene]
kind = "micro"
[fluid]
hematocrit = 0.2
[micro]
cells = 4
nodes = 24
shear_rate = "100 1/s"
duration = "2 ms"
output_interval = "1 ms"
contact.stiffness = "4 Pa"
contact.rest_distance = "0.7 um"
contact.cutoff = "1 um"
"""


class BadInput(CommandLineTest):
    def check(self, text, *fragments, code=2):
        self.assert_refused(self.hemoscale("check", self.write_case(text)), code, *fragments)

    def test_good_case_passes(self):
        result = self.hemoscale("check", self.write_case(GOOD))
        self.assertEqual(result.returncode, 0, result.stderr)

    def test_cases_in_one_folder_do_not_share_results(self):
        folder = self.write_case(GOOD)
        (folder / "other.toml").write_text(ENSEMBLE, encoding="utf-8")
        self.run_case(folder / "other.toml")
        self.assertTrue((folder / "results" / "other" / "summary.json").exists())
        self.assertFalse((folder / "results" / "summary.json").exists())

    def test_unknown_key_names_the_nearest(self):
        self.check(GOOD.replace("mean_velocity", "mean_velocty"), "mean_velocty", "mean_velocity", "case.toml:7")

    def test_wrong_unit(self):
        self.check(GOOD.replace('"60 um"', '"60 s"'), "macro.channel.height", "60 s", "case.toml:6")

    def test_unknown_unit(self):
        self.check(GOOD.replace('"60 um"', '"60 furlongz"'), "macro.channel.height", "furlongz")

    def test_value_out_of_range(self):
        self.check(GOOD.replace("hematocrit = 0.3", "hematocrit = 1.3"), "fluid.hematocrit", "1.3", "0.75")

    def test_all_faults_at_once(self):
        text = GOOD.replace("hematocrit = 0.3", "hematocrit = 1.3").replace('"60 um"', '"60 s"')
        text = text.replace("across", "acros")
        self.check(text, "fluid.hematocrit", "macro.channel.height", "sampling.acros")

    def test_syntax_error_has_a_place(self):
        self.check(GOOD.replace("[fluid]", "[fluid"), "case.toml:3")

    def test_missing_required_key(self):
        self.check(GOOD.replace("hematocrit = 0.3\n", ""), "fluid.hematocrit")

    def test_missing_file(self):
        self.assert_refused(self.hemoscale("check", self.folder / "nowhere"), 2, "nowhere", "case.toml")

    def test_folder_that_is_no_case(self):
        (self.folder / "empty").mkdir()
        self.assert_refused(self.hemoscale("run", self.folder / "empty"), 2, "case.toml", "controlDict")

    def test_unknown_variant(self):
        case = self.write_case(GOOD + '[variant.fast]\n[variant.slow]\n')
        self.assert_refused(self.hemoscale("check", case, "--variant", "quick"), 2, "quick", "fast", "slow")

    def test_openfoam_case_that_is_none(self):
        case = self.write_case(
            re.sub(r"\[macro.channel\]\n.*\n.*\n", '[macro]\nmodel = "openfoam"\nopenfoam.case = "missing"\n', GOOD)
            + ""
        )
        text = (case / "case.toml").read_text().replace("across = 2\nclosest_to_axis = 0.5", "points = [[0, 0, 0]]")
        (case / "case.toml").write_text(text)
        self.assert_refused(self.hemoscale("run", case), 2, "macro.openfoam.case", "controlDict")

    def test_plug_in_that_does_not_load(self):
        case = self.write_case(
            GOOD.replace("[macro.channel]", "[macro]").replace(
                'height = "60 um"\nmean_velocity = "2 mm/s"', 'model = "openfoam"\nopenfoam.case = "."'
            ).replace("across = 2\nclosest_to_axis = 0.5", "points = [[0, 0, 0]]")
        )
        broken = self.folder / "libhemoscale_openfoam.so"
        broken.write_text("not a library")
        result = self.hemoscale("run", case, environment={"HEMOSCALE_OPENFOAM_LIBRARY": str(broken)})
        self.assert_refused(result, 3, str(broken))

    def test_time_step_beyond_the_limit_is_refused_and_forced_run_reports_how_it_fails(self):
        text = ENSEMBLE.replace("nodes = 24", 'nodes = 24\ntime_step = "1 ms"')
        self.check(text, "micro.time_step", "limit", "case.toml")
        result = self.hemoscale("run", self.write_case(text.replace("2 ms", "400 ms"), "forced"), "--force")
        self.assert_refused(result, 4, "step", "cell", "node")

    def test_checkpoint_of_another_case(self):
        case = self.write_case(GOOD)
        self.run_case(case)
        other = self.write_case(GOOD.replace("hematocrit = 0.3", "hematocrit = 0.35"))
        result = self.hemoscale("run", other, "--restart")
        self.assert_refused(result, 3, "fluid.hematocrit", "0.3", "0.35")

    def test_earlier_results_are_kept(self):
        case = self.write_case(GOOD)
        self.run_case(case)
        before = figures(case / "results")
        self.run_case(case)
        self.assertEqual(before, figures(case / "results.1"))

    def test_results_that_cannot_be_written(self):
        case = self.write_case(GOOD)
        result = self.hemoscale("run", case, "--results", "/proc/hemoscale")
        self.assert_refused(result, 3, "/proc/hemoscale")

    def test_micro_scene_under_several_processes(self):
        case = self.write_case(GOOD.replace("[case]", "[scene]\nkind = \"nonsense\"\n[case]"))
        self.assert_refused(self.hemoscale("check", case), 2, "scene.kind", "nonsense", "coupled", "micro")


if __name__ == "__main__":
    unittest.main()
