"""The tables of cells and of the flow around them, as arrays in micrometres."""

import glob
import os
import sys

import numpy as np

MICRO = 1e6


def closed(ring):
    return np.vstack([ring, ring[:1]])


def centroid(ring):
    """Centroid of the area of a polygon."""
    x, y = (ring - ring[0]).T
    sectors = x * np.roll(y, -1) - y * np.roll(x, -1)
    moments = [(sectors * (v + np.roll(v, -1))).sum() / 3 for v in (x, y)]
    return ring[0] + np.array(moments) / sectors.sum()


class Frames:
    """cells.csv: times [s], and for each time and cell its nodes [µm] and their tension [N/m]."""

    def __init__(self, table):
        order = np.lexsort((table["node"], table["cell"], table["time"]))
        time, cell = table["time"][order], table["cell"][order]
        points = MICRO * np.column_stack([table["x"], table["y"]])[order]
        velocities = np.column_stack([table["u"], table["v"]])[order]
        tension = table["tension"][order]
        self.times = np.unique(time)
        self.cells = np.unique(cell)
        starts = np.flatnonzero((np.diff(time) != 0) | (np.diff(cell) != 0)) + 1
        self.rings = self.by_frame(points, starts)
        self.velocities = self.by_frame(velocities, starts)
        self.tensions = self.by_frame(tension, starts)

    def by_frame(self, values, starts):
        pieces = np.split(values, starts)
        if len(pieces) != len(self.times) * len(self.cells):
            raise ValueError("not every cell is there at every time")
        count = len(self.cells)
        return [pieces[k * count : (k + 1) * count] for k in range(len(self.times))]

    def travel(self):
        """Way of the first cell [µm]."""
        return np.linalg.norm(centroid(self.rings[-1][0]) - centroid(self.rings[0][0]))

    def size(self):
        """Largest extent of the first cell [µm]."""
        return max(np.ptp(rings[0], axis=0).max() for rings in self.rings)

    def travels(self):
        return self.travel() > self.size()

    def apart(self):
        """As many frames as possible, evenly far apart, whose cells do not hide each other."""
        boxes = [[(r.min(axis=0), r.max(axis=0)) for r in rings] for rings in self.rings]

        def overlap(a, b):
            return any(
                (low < other_high + 0.5).all() and (other_low < high + 0.5).all()
                for low, high in boxes[a]
                for other_low, other_high in boxes[b]
            )

        places = np.array([centroid(rings[0]) for rings in self.rings])
        way = np.concatenate([[0], np.linalg.norm(np.diff(places, axis=0), axis=1).cumsum()])
        for count in range(12, 2, -1):
            wanted = np.linspace(0, way[-1], count)
            chosen = [int(np.abs(way - place).argmin()) for place in wanted]
            if not any(overlap(a, b) for k, a in enumerate(chosen) for b in chosen[:k]):
                return chosen
        return [0, len(self.times) - 1]


def read_frames(folder):
    table = folder.table("cells.csv")
    if table is None or len(table) == 0:
        return None
    names = ("time", "cell", "node", "x", "y", "u", "v", "tension")
    try:
        if not table.has(*names):
            raise ValueError("a column is missing of " + ", ".join(names))
        return Frames(table)
    except ValueError as error:
        sys.exit(f"{os.path.join(folder.path, 'cells.csv')}: {error}; correct or remove the file")


class Grid:
    """flow.csv: coordinates [µm] and fields over (y, x), masked outside the fluid."""

    def __init__(self, table):
        self.x, column = np.unique(table["x"], return_inverse=True)
        self.y, row = np.unique(table["y"], return_inverse=True)
        if len(self.x) < 2 or len(self.y) < 2 or len(self.x) * len(self.y) != len(table):
            raise ValueError("the points are not those of a regular grid")
        self.fields = {}
        for name in ("u", "v", "p"):
            field = np.full((len(self.y), len(self.x)), np.nan)
            field[row, column] = table[name]
            self.fields[name] = np.ma.masked_invalid(field)
        # Even spacing to the last bit, as streamlines ask for.
        self.x = MICRO * np.linspace(self.x[0], self.x[-1], len(self.x))
        self.y = MICRO * np.linspace(self.y[0], self.y[-1], len(self.y))


def read_grid(folder):
    paths = sorted(glob.glob(os.path.join(folder.path, "flow*.csv")))
    if not paths:
        return None
    table = folder.table(os.path.basename(paths[-1]))
    try:
        if not table.has("x", "y", "u", "v", "p"):
            raise ValueError("a column is missing of x, y, u, v, p")
        return Grid(table)
    except ValueError as error:
        sys.exit(f"{paths[-1]}: {error}; correct or remove the file")
