"""Every mistake in a study ends with one clear message and a non-zero status, before anything is run
where it can be seen before."""

import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from command_line import CommandLineTest  # noqa: E402
from small_case import SMALL  # noqa: E402

STUDY = """[study]
name = "bad"
[error]
figure = "shear stress in the last interval"
[[sweep]]
key = "micro.cells"
values = [2, 3]
"""


class BadStudy(CommandLineTest):
    def refuse(self, study, code, *fragments, arguments=(), ran=False):
        case = self.write_case(SMALL)
        (case / "study.toml").write_text(study, encoding="utf-8")
        self.assert_refused(self.hemoscale("chart", case, *arguments), code, *fragments)
        runs = case / "results" / "bad" / "runs"
        self.assertEqual(runs.is_dir() and any(runs.iterdir()), ran)

    def test_unknown_key_of_a_study(self):
        self.refuse(STUDY.replace("[error]", "[eror]"), 2, "study.toml:3", "nearest is error")

    def test_unknown_key_of_the_case(self):
        self.refuse(STUDY.replace("micro.cells", "micro.cels"), 2, "study.toml:7:11", "micro.cels", "micro.cells")

    def test_all_faults_of_all_runs(self):
        study = STUDY.replace("[2, 3]", "[2, 0, -1]").replace("[error]", 'set = { "micro.nodes" = 2 }\n[error]')
        self.refuse(study, 2, "study.toml:3", "study.toml:8:14", "study.toml:8:17", "3 faults")

    def test_fault_of_the_case_itself(self):
        case = self.write_case(SMALL.replace("0.2", "1.2"))
        (case / "study.toml").write_text(STUDY, encoding="utf-8")
        self.assert_refused(self.hemoscale("chart", case), 2, "case.toml:6", "fluid.hematocrit", "1 fault")

    def test_syntax(self):
        self.refuse(STUDY.replace("[error]", "[error"), 2, "study.toml:3", "TOML")

    def test_no_study(self):
        self.assert_refused(self.hemoscale("chart", self.folder), 2, "study.toml")
        self.assert_refused(self.hemoscale("chart", self.folder / "absent.toml"), 2, "no such")

    def test_no_case(self):
        self.refuse(STUDY.replace("[error]", 'case = "nowhere"\n[error]'), 2, "nowhere", "case.toml")

    def test_chart_without_error_and_map_without_question(self):
        self.refuse('[study]\nname = "bad"\n', 2, "[error]")
        self.refuse(STUDY, 2, "[map]", arguments=["--map"])

    def test_unknown_figure_is_told_after_the_first_run(self):
        self.refuse(STUDY.replace("shear stress in", "shear stres in"), 2, "study.toml:4:10",
                    'nearest is "shear stress in the last interval"', ran=True)

    def test_prediction_in_another_unit(self):
        study = STUDY + (
            '[map]\nkey = "micro.time_step"\nstable = "1 us"\nunstable = "1 s"\npredicted = "steps"\n'
        )
        self.refuse(study, 2, "map.predicted", "is in -", arguments=["--map"], ran=True)

    def test_jobs_out_of_range(self):
        self.refuse(STUDY, 1, "--jobs", arguments=["--jobs", "0"])

    def test_run_that_ends_badly_ends_the_study_with_its_reason(self):
        # So many cells cannot be packed at random, which shows when the run begins, not before.
        study = STUDY.replace("[2, 3]", "[2, 3]\n[[sweep]]\nkey = \"fluid.hematocrit\"\nvalues = [0.749]")
        case = self.write_case(SMALL)
        (case / "study.toml").write_text(study, encoding="utf-8")
        result = self.hemoscale("chart", case)
        self.assert_refused(result, 3, "ended with exit code 2", "log", "finished runs are kept")

    def test_results_that_cannot_be_written(self):
        case = self.write_case(SMALL)
        (case / "study.toml").write_text(STUDY, encoding="utf-8")
        (case / "results").write_text("in the way")
        self.assert_refused(self.hemoscale("chart", case), 3, "results")

    def test_overrides_do_not_reach_a_solver_of_openfoam(self):
        case = self.write_case(
            '[case]\nname = "foam"\n[fluid]\nhematocrit = 0.3\n[macro]\nmodel = "openfoam"\n'
            'openfoam.case = "."\n[sampling]\npoints = [[0, 0, 0]]\n[micro]\nmodel = "synthetic"\n'
        )
        result = self.hemoscale("check", case, "--set", "fluid.hematocrit=0.2")
        self.assert_refused(result, 2, "--set fluid.hematocrit", "variant")

    def test_malformed_override(self):
        case = self.write_case(SMALL)
        self.assert_refused(self.hemoscale("run", case, "--set", "micro.cells"), 2, "KEY=VALUE")
        self.assert_refused(self.hemoscale("run", case, "--set"), 1, "--set")


if __name__ == "__main__":
    unittest.main()
