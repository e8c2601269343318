#!/usr/bin/python3
"""Cells in plasma that cannot be: every fault is named with its key, what is allowed and a remedy."""

import math
import pathlib
import sys
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parents[2] / "support"))
from cell_case import CELLS, SHEAR  # noqa: E402
from command_line import CommandLineTest, summary  # noqa: E402

def changed(text, *pairs):
    for old, new in pairs:
        assert old in text, old
        text = text.replace(old, new)
    return text


class BadCells(CommandLineTest):
    def refused(self, text, *fragments):
        self.assert_refused(self.hemoscale("check", self.write_case(text)), 2, *fragments)

    def test_the_case_itself_is_good(self):
        for text in (CELLS, SHEAR):
            result = self.hemoscale("check", self.write_case(text))
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertIn("Ca_b", result.stdout)

    def test_cells_that_overlap(self):
        text = changed(CELLS, ("nodes = 40", 'nodes = 40\ncount = 2\ndistance = "1 um"'))
        self.refused(text, "micro.cell.x", "cells 0 and 1 overlap")

    def test_cell_that_touches_a_wall(self):
        self.refused(changed(CELLS, ('x = "15 um"', 'x = "15 um"\ny = "6 um"')), "micro.cell.y",
                     "wall")

    def test_cell_outside_the_channel(self):
        self.refused(changed(CELLS, ('x = "15 um"', 'x = "15 um"\ny = "30 um"')), "micro.cell.y", "cell 0", "beyond a wall")

    def test_cell_in_the_inlet(self):
        self.refused(changed(CELLS, ('x = "15 um"', 'x = "1 um"')), "opening")

    def test_too_few_nodes(self):
        self.refused(changed(CELLS, ("nodes = 40", "nodes = 7")), "micro.cell.nodes", "16 to 1000")

    def test_negative_moduli_all_at_once(self):
        text = changed(
            CELLS,
            ("nodes = 40", 'nodes = 40\nbending_modulus = "-1e-19 J"\nstretch_law = "linear"\n'
             'stretch_modulus = "-1 N/m"\narea_law = "penalty"\narea_modulus = "-3 Pa"'))
        self.refused(text, "micro.cell.bending_modulus", "micro.cell.stretch_modulus",
                     "micro.cell.area_modulus", "3 faults")

    def test_modulus_without_its_law(self):
        self.refused(changed(CELLS, ("nodes = 40", 'nodes = 40\nstretch_modulus = "1 N/m"')),
                     "micro.cell.stretch_modulus", "stretch_law")

    def outline_of(self, angles):
        """A case whose outline is read from a table beside it."""
        case = self.write_case(changed(CELLS, ("nodes = 40", 'outline = "table"\n'
                                               'outline_table = "outline.csv"')))
        points = [(3e-6 * math.cos(a), 1.5e-6 * math.sin(k * a)) for a, k in angles]
        text = "x [m],y [m]\n" + "".join(f"{x!r},{y!r}\n" for x, y in points)
        (case / "outline.csv").write_text(text, encoding="utf-8")
        return case

    def test_outline_from_a_table(self):
        turns = [2 * math.pi * i / 40 for i in range(40)]
        good = self.outline_of([(a, 1) for a in turns])
        self.run_case(good)
        crossing = self.outline_of([(a + 0.05, 2) for a in turns])
        self.assert_refused(self.hemoscale("check", crossing), 2, "micro.cell.outline_table",
                            "outline.csv", "segment")
        clockwise = self.outline_of([(-a, 1) for a in turns])
        self.assert_refused(self.hemoscale("check", clockwise), 2, "clockwise")
        short = self.outline_of([(a, 1) for a in turns[::5]])
        self.assert_refused(self.hemoscale("check", short), 2, "8 rows", "at least 16")
        (good / "outline.csv").unlink()
        self.assert_refused(self.hemoscale("check", good), 3, "outline.csv")

    def test_reduced_area_beyond_contact(self):
        self.refused(changed(CELLS, ("nodes = 40", "nodes = 40\nreduced_area = 0.2")),
                     "micro.cell.reduced_area", "0.28")

    def test_several_cells_without_a_distance(self):
        self.refused(changed(CELLS, ("nodes = 40", "nodes = 40\ncount = 2")),
                     "micro.cell.distance", "is missing")

    def test_centres_that_are_not_one_for_each_cell(self):
        text = changed(CELLS, ('x = "15 um"', 'count = 2\ncentres = [["15 um", "5 um", "0 m"]]'))
        self.refused(text, "micro.cell.centres", "1 points for 2 cells")

    def test_explicit_couplings_refuse_what_they_cannot_hold(self):
        text = changed(CELLS, ('"implicit"', '"immersed"'))
        self.refused(text, "inextensible", "implicit")
        text = changed(text, ("nodes = 40", 'nodes = 40\nstretch_law = "linear"\n'
                              'stretch_modulus = "1e-4 N/m"\nviscosity_ratio = 5'))
        self.refused(text, "viscosity")

    def test_explicit_step_beyond_its_limit(self):
        text = changed(CELLS, ('"implicit"', '"immersed"\ntime_step = "0.1 ms"'),
                       ("nodes = 40", 'nodes = 40\nstretch_law = "linear"\n'
                        'stretch_modulus = "1e-2 N/m"'))
        self.refused(text, "micro.plasma.time_step", "exceeds", "--force")

    def test_direct_needs_the_particle_method(self):
        self.refused(changed(CELLS, ('"implicit"', '"direct"')), "micro.plasma.membranes",
                     "scheme")

    def test_unbounded_shear_needs_implicit_cells(self):
        self.refused(changed(SHEAR, ('"implicit"', '"immersed"')), "micro.plasma.membranes",
                     "implicit")
        bare = changed(SHEAR, ('membranes = "implicit"\n', ""))
        bare = bare[: bare.index("[micro.cell]")]
        self.refused(bare, "micro.plasma.flow", "membranes")

    def test_unsteady_plasma_is_not_for_implicit_cells(self):
        text = changed(CELLS, ('speed = "10 mm/s"', 'speed = "10 mm/s"\ninertia = "unsteady"'))
        result = self.hemoscale("run", self.write_case(text))
        self.assert_refused(result, 2, "quasi-steady")

    def test_several_processes_are_refused_by_name(self):
        self.refused(changed(CELLS, ("nodes = 40", "nodes = 40\ncells = 3")), "micro.cell.cells")

    def test_a_membrane_without_bound_is_warned_of_with_its_number(self):
        text = changed(CELLS, ("nodes = 40", 'nodes = 40\nstretch_law = "linear"\n'
                               'stretch_modulus = "5e-6 N/m"'))
        case = self.write_case(text)
        self.assertIn("Ca_s = 2", self.hemoscale("check", case).stdout.replace("Ca_s 2", "Ca_s = 2"))
        self.run_case(case)
        warnings = " ".join(summary(case / "results")["warnings"])
        self.assertIn("without bound", warnings)

    def test_thin_films_are_warned_of(self):
        text = changed(CELLS, ('x = "15 um"', 'x = "15 um"\ny = "5.4 um"'))
        case = self.write_case(text)
        self.run_case(case)
        self.assertIn("lubrication", " ".join(summary(case / "results")["warnings"]))

    def test_a_cell_that_reaches_the_outlet_ends_the_run_with_its_results(self):
        text = changed(CELLS, ('duration = "0.4 ms"', 'duration = "4 ms"'))
        case = self.write_case(text)
        result = self.hemoscale("run", case)
        self.assert_refused(result, 4, "step", "time", "cell 0", "opening")
        self.assertTrue(summary(case / "results")["outcome"].startswith("stopped"))


if __name__ == "__main__":
    unittest.main()
