"""What the pictures of results share: their style, the tables and the folder they are made of."""

import csv
import json
import os
import re
import sys
import textwrap

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

# Colours of Okabe and Ito (2008), which colour-blind readers tell apart; line styles differ too.
BLUE, ORANGE, GREEN, RED, GREY = "#0072B2", "#E69F00", "#009E73", "#D55E00", "#666666"
PREFIXES = {-9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M"}

plt.rcParams.update(
    {
        "font.size": 10,
        "axes.grid": True,
        "grid.alpha": 0.3,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "legend.frameon": False,
        "lines.linewidth": 1.6,
    }
)


class Table:
    """A table of numbers with units in its header."""

    def __init__(self, path):
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        if not rows:
            raise ValueError("there is no header")
        self.names, self.units, self.columns = [], [], []
        for head in rows[0]:
            match = re.fullmatch(r"(.+) \[(.+)\]", head)
            if not match:
                raise ValueError(f"'{head}' is not of the form 'name [unit]'")
            self.names.append(match[1])
            self.units.append("" if match[2] == "-" else match[2])
        numbers = np.array([[float(text) for text in row] for row in rows[1:]])
        self.columns = numbers.reshape(-1, len(self.names)).T

    def __len__(self):
        return self.columns.shape[1]

    def index(self, start):
        """Number of the first column whose name begins with `start`; none if there is none."""
        start = start.replace("_", " ")
        for number, name in enumerate(self.names):
            if name.replace("_", " ").startswith(start):
                return number
        return None

    def has(self, *starts):
        return all(self.index(start) is not None for start in starts)

    def __getitem__(self, start):
        return self.columns[self.index(start)]

    def unit(self, start):
        return self.units[self.index(start)]


def scaled(values, unit):
    """Factor and unit in which values of an SI unit have few digits."""
    finite = np.abs(values[np.isfinite(values)])
    largest = finite.max() if finite.size else 0.0
    if unit not in ("m", "m/s", "s", "Pa", "Pa s") or largest == 0:
        return 1.0, unit
    power = int(3 * np.floor(np.log10(largest * 1.0001) / 3))
    power = min(max(power, -9), 6)
    return 10.0**-power, PREFIXES[power] + unit


def label(name, unit):
    name = name.replace("_", " ")
    if len(name) > 1:  # a symbol stays as it is
        name = name[:1].upper() + name[1:]
    return f"{name} [{unit.replace('Pa s', 'Pa·s')}]" if unit else name


class Folder:
    """A results folder and how pictures of it are signed."""

    def __init__(self, path):
        self.path = path
        self.title, self.statements, self.figures = "", [], {}
        try:
            with open(os.path.join(path, "summary.json"), encoding="utf-8") as file:
                summary = json.load(file)
            self.title, self.statements = summary["title"], summary["statements"]
            # A number that JSON does not know is null.
            self.figures = {
                figure["name"]: float("nan") if figure["value"] is None else figure["value"]
                for figure in summary["figures"]
            }
        except FileNotFoundError:
            pass

    def table(self, name):
        path = os.path.join(self.path, name)
        try:
            return Table(path)
        except FileNotFoundError:
            return None
        except ValueError as error:
            sys.exit(f"{path}: {error}; correct or remove the file")

    def notes(self, width):
        """What the results are not, as the lines below a figure of that width [inch]."""
        return textwrap.wrap("; ".join(self.statements), int(width * 17))

    def save(self, figure, name, fit=True):
        """Writes a figure with its title and notes; `fit` lets the axes fill what is left."""
        if self.title:
            figure.suptitle(self.title, x=0.01, ha="left", fontweight="bold")
        lines = self.notes(figure.get_figwidth())
        if fit:
            bottom = 0.13 * len(lines) / figure.get_figheight()
            top = 1 - (0.15 / figure.get_figheight() if self.title else 0)
            figure.tight_layout(rect=(0, bottom, 1, top))
        figure.text(0.01, 0.01, "\n".join(lines), fontsize=7, color=GREY)
        path = os.path.join(self.path, name)
        figure.savefig(path, dpi=150)
        plt.close(figure)
        print(path)
