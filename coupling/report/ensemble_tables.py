"""What the tables of an ensemble of cells hold."""

import numpy as np

from picture import BLUE, GREEN, ORANGE, RED

# Of the cells of the first kind, the second, ...
COLOURS = [RED, BLUE, GREEN, ORANGE]


def exact(table, name):
    """The column of that name, or none."""
    return table.columns[table.names.index(name)] if name in table.names else None


class Kinds:
    """The kinds of cells of a folder: names, prefixes of their quantities, numbers of cells."""

    def __init__(self, folder):
        self.series = folder.table("series.csv")
        mark = "orientational order"
        self.prefixes = [n[: -len(mark)] for n in self.series.names if n.endswith(mark)]
        self.names = [prefix.rstrip(": ") or "red cells" for prefix in self.prefixes]

    def column(self, kind, name):
        return exact(self.series, self.prefixes[kind] + name)

    def first_cells(self):
        """Numbers of the first cell of each kind in a trajectory, whose kinds follow each other."""
        counts = [int(self.column(kind, "cells")[0]) for kind in range(len(self.names))]
        return np.cumsum([0] + counts)


def is_ensemble(folder):
    table = folder.table("series.csv")
    return table is not None and len(table) > 0 and "orientational order" in table.names


def concentration(folder, name):
    """Times, places of the bins and area fractions of a concentration table."""
    table = folder.table(name)
    start = "area fraction at y = "
    if table is None or len(table) == 0:
        return None
    chosen = [n for n, column in enumerate(table.names) if column.startswith(start)]
    places = np.array([float(table.names[n][len(start) :].split()[0]) for n in chosen])
    return table["time"], places, table.columns[chosen]
