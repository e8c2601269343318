"""Twelve cells in a small channel, on vectors: a run of a fraction of a second that tests change."""

from command_line import CommandLineTest, figures

CHANNEL = """[case]
name = "channel"
[scene]
kind = "micro"
[fluid]
hematocrit = 0.3
[micro]
model = "ensemble"
domain = "channel"
cells = 12
nodes = 40
mean_velocity = "20 um/s"
duration = "4 ms"
output_interval = "2 ms"
[micro.channel]
height = "30 um"
[micro.packing]
kind = "lattice"
[micro.contact]
rest_distance = "0.5 um"
[output]
trajectory = false
"""

INTEGRATORS = {
    "explicit": "",
    "chebyshev": "chebyshev.stages = 6\n",
    "inertial": 'inertia.cell_mass = "2e-8 kg/m"\ndrag.momentum = "1e-3 kg/m^2"\nprecision = "double"\n',
    "linearly-implicit": "",
    "constant-operator": "",
    "constant-operator-2": "",
}


def with_micro(text, *lines):
    """The case with more lines in its section micro."""
    return text.replace('model = "ensemble"\n', 'model = "ensemble"\n' + "\n".join(lines) + "\n")


def lasting(text, duration, interval):
    return text.replace('"4 ms"', f'"{duration}"').replace('"2 ms"', f'"{interval}"')


class EnsembleTest(CommandLineTest):
    def accepted(self, text, *arguments):
        result = self.hemoscale("check", self.write_case(text), *arguments)
        self.assertEqual(result.returncode, 0, result.stderr)
        return result.stdout

    def refused(self, text, *fragments, faults=1):
        result = self.hemoscale("check", self.write_case(text))
        self.assert_refused(result, 2, *fragments)
        self.assertIn(f"{faults} fault", result.stderr)
        return result

    def run_figures(self, text, *arguments):
        case = self.write_case(text)
        self.run_case(case, "--results", self.folder / "results", *arguments)
        return figures(self.folder / "results")
