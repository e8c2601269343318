"""Pictures of a vessel through which cells pass: where they are, and how they divide."""

import glob
import os

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import to_rgba
from matplotlib.patches import Patch

from cells import WIDTH, draw_walls, plain_axis
from ensemble_tables import COLOURS, exact
from picture import BLUE, GREEN, GREY, ORANGE, label, scaled
from trajectories import open_trajectory

MICRO = 1e6  # in one unit
# Inches around the axes of the cells.
LEFT, RIGHT, HEAD, ABOVE, BELOW = 0.8, 0.2, 0.45, 0.3, 0.55
MARK = "cells between the openings"
SHARE = "cell share of "
OUTLETS = [BLUE, ORANGE, GREEN]  # colours, with styles for more of them than colours
STYLES = ["-", "--", "-."]


def is_feed(folder):
    table = folder.table("series.csv")
    return table is not None and len(table) > 0 and MARK in table.names


class FeedTables:
    """Kinds of cells and outlets of a folder."""

    def __init__(self, folder):
        self.series = folder.table("series.csv")
        self.prefixes = [n[: -len(MARK)] for n in self.series.names if n.endswith(MARK)]
        self.names = [prefix.rstrip(": ") or "red cells" for prefix in self.prefixes]
        self.outlets = [n[len(SHARE) :] for n in self.series.names if n.startswith(SHARE)]

    def column(self, kind, name):
        return exact(self.series, self.prefixes[kind] + name)

    def style(self, outlet):
        return {"color": OUTLETS[outlet % 3], "linestyle": STYLES[outlet // 3 % 3]}


def read_rings(path):
    """Time [s] of a file of one frame, and outlines [µm]."""
    with open_trajectory(path) as file:
        (particles,) = file["particles"].values()
        borders = np.flatnonzero(np.diff(particles["cell"][...])) + 1
        time = particles["position/time"][0]
        return time, np.split(MICRO * particles["position/value"][0], borders)


def draw_rings(axis, folder, tables, path):
    time, rings = read_rings(path)
    row = np.abs(tables.series["time"] - time).argmin()
    first = 0
    for kind, colour in zip(range(len(tables.names)), COLOURS):
        end = first + int(tables.column(kind, "cells")[row])
        face = to_rgba(colour, 0.45 if kind == 0 else 0.85)
        axis.add_collection(
            PolyCollection(rings[first:end], facecolors=[face], edgecolors=colour, linewidths=0.5)
        )
        first = end
    draw_walls(axis, folder)
    plain_axis(axis)
    factor, unit = scaled(np.array([time]), "s")
    axis.set_title(f"t = {factor * time:.4g} {unit}", fontsize=10, loc="left")
    for side in axis.spines.values():
        side.set_visible(False)


def draw_frames(folder, tables):
    """An output halfway through the filling of the vessel, if there is one, and the last."""
    paths = sorted(glob.glob(os.path.join(folder.path, "frames", "cells-*.h5")))
    walls = folder.table("walls.csv")
    if not paths or walls is None or len(walls) == 0:
        return
    cells = tables.column(0, "cells")
    half = int((cells > 0.5 * cells.max()).argmax())
    earlier = [path for path in paths if int(path[-9:-3]) <= half and path != paths[-1]]
    chosen = earlier[-1:] + paths[-1:]
    points = MICRO * np.column_stack([walls["x"], walls["y"]])
    low, high = points.min(axis=0) - 3, points.max(axis=0) + 3
    height = (WIDTH - LEFT - RIGHT) * (high[1] - low[1]) / (high[0] - low[0])
    block = ABOVE + height + BELOW
    total = HEAD + block * len(chosen) + 0.13 * len(folder.notes(WIDTH)) + 0.1
    figure = plt.figure(figsize=(WIDTH, total))
    for n, path in enumerate(chosen):
        bottom = total - HEAD - (n + 1) * block + BELOW
        axis = figure.add_axes(
            [LEFT / WIDTH, bottom / total, 1 - (LEFT + RIGHT) / WIDTH, height / total]
        )
        draw_rings(axis, folder, tables, path)
        axis.set_xlim(low[0], high[0])
        axis.set_ylim(low[1], high[1])
    if len(tables.names) > 1:
        handles = [
            Patch(facecolor=colour, alpha=0.6, label=name)
            for colour, name in zip(COLOURS, tables.names)
        ]
        figure.legend(handles=handles, loc="upper right", ncol=len(handles), fontsize=9)
    folder.save(figure, "ensemble-cells.png", fit=False)


def beside(axis, text, y, colour):
    """Names a horizontal line at its right end."""
    axis.annotate(
        text,
        (1, y),
        (4, 0),
        xycoords=("axes fraction", "data"),
        textcoords="offset points",
        fontsize=8,
        color=colour,
        va="center",
    )


def draw_filling(axis, tables, time, kind):
    axis.plot(time, tables.column(kind, "tube hematocrit"), color=COLOURS[kind])
    axis.set_ylim(bottom=0)
    axis.set_ylabel("Tube\nhematocrit [-]")


def draw_left(axis, tables, time, kind):
    for n, outlet in enumerate(tables.outlets):
        axis.plot(time, tables.column(kind, "left through " + outlet), **tables.style(n))
    axis.set_ylim(bottom=0)
    axis.set_ylabel("Cells that\nleft [-]")


def draw_share(axis, tables, time, kind):
    """Cumulative shares of cells, and those of the flow, which do not change."""
    for n, outlet in enumerate(tables.outlets):
        style = tables.style(n)
        share = tables.column(kind, SHARE + outlet)
        if np.isfinite(share).sum() < 3:  # no line to be seen
            style["marker"], style["clip_on"] = ".", False
        axis.plot(time, share, **style)
        flow = exact(tables.series, "flow share of " + outlet)[-1]
        axis.axhline(flow, color=style["color"], linewidth=1, linestyle=":")
        beside(axis, "flow", flow, style["color"])
    axis.set_ylim(0, 1)
    axis.set_ylabel("Share of\nan outlet [-]")


def draw_shares(folder, tables):
    factor, unit = scaled(tables.series["time"], "s")
    time = factor * tables.series["time"]
    kinds = len(tables.names)
    figure, axes = plt.subplots(3, kinds, figsize=(6.5 * kinds, 7), squeeze=False, sharex=True)
    since = folder.figures.get("time from which cells are counted", 0)
    for kind, column in enumerate(axes.T):
        draw_filling(column[0], tables, time, kind)
        draw_left(column[1], tables, time, kind)
        draw_share(column[2], tables, time, kind)
        column[0].set_title(tables.names[kind].capitalize(), fontsize=10, loc="left")
        for axis in column:
            axis.axvspan(time[0], factor * since, color=GREY, alpha=0.12, linewidth=0)
        column[2].set_xlabel(label("time", unit))
        column[2].set_xlim(time[0], max(time[-1], time[0] + 1e-12))
    handles = [
        plt.Line2D([], [], label=outlet, **tables.style(n))
        for n, outlet in enumerate(tables.outlets)
    ]
    if since > 0:
        handles.append(Patch(facecolor=GREY, alpha=0.12, label="filling, not counted"))
    for axis in axes[1]:
        axis.legend(
            handles=handles, fontsize=8, loc="lower left", bbox_to_anchor=(0, 0.98), ncol=4
        )
    folder.save(figure, "ensemble-shares.png")


def draw_feed(folder):
    tables = FeedTables(folder)
    draw_frames(folder, tables)
    draw_shares(folder, tables)
