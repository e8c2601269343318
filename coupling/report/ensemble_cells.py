"""Pictures of the cells of an ensemble: all outlines at the start and at the end."""

import os

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import to_rgba
from matplotlib.patches import Patch, Rectangle

from cells import WALL, WIDTH, draw_walls, plain_axis
from ensemble_tables import COLOURS
from picture import GREY, scaled
from trajectories import open_trajectory

MICRO = 1e6  # in one unit
EXCERPT = 2.7  # heights, about what the figure shows of a long channel with its cells large enough
LONGEST = 25  # heights, beyond which the whole channel would be a line
# Inches around the axes of the cells.
LEFT, RIGHT, HEAD, ABOVE, BELOW, BELOW_WIDE = 0.7, 0.2, 0.4, 0.35, 0.6, 0.3


class Frames:
    """Outlines of all cells and the extent of the channel [µm]."""

    def __init__(self, file, walls):
        (particles,) = file["particles"].values()
        self.times = particles["position/time"][...]
        edges = MICRO * particles["box/edges"][...][:2]
        self.period = edges[0]
        self.lower, self.upper = np.zeros(2), edges
        boundary = particles["box"].attrs["boundary"]
        self.is_periodic = boundary[0] in (b"periodic", "periodic")
        if walls is not None:
            points = MICRO * np.column_stack([walls["x"], walls["y"]])
            self.lower, self.upper = points.min(axis=0), points.max(axis=0)
        if self.is_periodic:
            self.lower[0], self.upper[0] = 0, self.period
        self.length, self.height = self.upper - self.lower
        ids = particles["cell"][...]
        self.borders = np.flatnonzero(np.diff(ids)) + 1
        self.positions = particles["position/value"]

    def rings(self, frame):
        """Outlines, every image that reaches into the box, with the numbers of their cells."""
        rings, numbers = [], []
        for number, ring in enumerate(np.split(MICRO * self.positions[frame], self.borders)):
            columns = [0]
            if self.is_periodic:
                reach = ring[:, 0].min() // self.period, ring[:, 0].max() // self.period
                columns = range(int(reach[0]), int(reach[1]) + 1)
            for column in columns:
                rings.append(ring - [column * self.period, 0])
                numbers.append(number)
        return rings, np.array(numbers)


def draw_channel(axis, folder, frames, frame, firsts, part, line):
    """The cells of a frame between two places along the channel [µm]."""
    low, high = part
    rings, numbers = frames.rings(frame)
    reaches = np.array([(ring[:, 0].min(), ring[:, 0].max()) for ring in rings])
    seen = (reaches[:, 1] >= low) & (reaches[:, 0] <= high)
    for kind, colour in zip(range(len(firsts) - 1), COLOURS):
        chosen = seen & (numbers >= firsts[kind]) & (numbers < firsts[kind + 1])
        polygons = [rings[n] for n in np.flatnonzero(chosen)]
        face = to_rgba(colour, 0.45 if kind == 0 else 0.85)
        axis.add_collection(
            PolyCollection(polygons, facecolors=[face], edgecolors=colour, linewidths=line)
        )
    plain_axis(axis)
    axis.set_xlim(low, high)
    margin = 0.02 * frames.height
    axis.set_ylim(frames.lower[1] - margin, frames.upper[1] + margin)
    for side in ("top", "bottom"):
        axis.spines[side].set_visible(False)
    if folder.table("walls.csv") is not None:
        draw_walls(axis, folder)
        return
    for y in (0, frames.height):
        axis.axhline(y, color=WALL, linewidth=2.5)


def strips(frames):
    """What is shown of a channel: (low, high) in x, from wide to narrow."""
    ratio = frames.length / frames.height
    whole = (frames.lower[0], frames.upper[0])
    if ratio <= 1.35 * EXCERPT:
        return [whole]
    excerpt = (whole[0], whole[0] + EXCERPT * frames.height)
    return [whole, excerpt] if ratio <= LONGEST else [excerpt]


def draw_cells_of(folder, path, kinds):
    with open_trajectory(path) as file:
        frames = Frames(file, folder.table("walls.csv"))
        if len(frames.times) == 0 or frames.positions.shape[2] != 2:
            return
        firsts = kinds.first_cells()
        chosen = [0] if len(frames.times) == 1 else [0, len(frames.times) - 1]
        parts = strips(frames)
        # A short channel needs no wide figure.
        width = WIDTH if frames.length > 2 * frames.height else 6.5
        scale = 1.04 * (width - LEFT - RIGHT) * frames.height
        heights = [scale / (high - low) for low, high in parts]
        block = sum(heights) + ABOVE + BELOW + BELOW_WIDE * (len(parts) - 1)
        foot = 0.13 * len(folder.notes(width)) + 0.1
        total = HEAD + len(chosen) * block + foot
        figure = plt.figure(figsize=(width, total))
        factor, unit = scaled(frames.times[-1:], "s")
        place = total - HEAD
        for frame in chosen:
            place -= ABOVE
            for part, height in zip(parts, heights):
                place -= height
                share = [LEFT / width, place / total, 1 - (LEFT + RIGHT) / width, height / total]
                axis = figure.add_axes(share)
                is_whole = part == parts[0] and len(parts) > 1
                draw_channel(axis, folder, frames, frame, firsts, part, 0.25 if is_whole else 0.6)
                if part == parts[0]:
                    time = factor * frames.times[frame]
                    axis.set_title(f"t = {time:.4g} {unit}", fontsize=10, loc="left")
                    axis.set_title(
                        "flow \N{RIGHTWARDS ARROW}", fontsize=10, loc="right", color=GREY
                    )
                if is_whole:
                    axis.set_xlabel("")
                    mark_excerpt(axis, frames, parts[-1])
                place -= BELOW_WIDE if is_whole else BELOW
        if len(kinds.names) > 1:
            handles = [
                Patch(facecolor=colour, alpha=0.6, label=name)
                for colour, name in zip(COLOURS, kinds.names)
            ]
            figure.legend(handles=handles, loc="upper right", ncol=len(handles), fontsize=9)
    name = os.path.splitext(os.path.basename(path))[0].replace("trajectory", "ensemble-cells")
    folder.save(figure, name + ".png", fit=False)


def mark_excerpt(axis, frames, part):
    low, high = part
    axis.add_patch(
        Rectangle(
            (low, frames.lower[1]),
            high - low,
            frames.height,
            fill=False,
            color="black",
            linewidth=1.2,
            zorder=4,
        )
    )
