"""Time series of cells: velocity, length, gap, inclination, with the time of the steady state."""

import re

import matplotlib.pyplot as plt
import numpy as np

from picture import BLUE, GREEN, GREY, ORANGE, RED, label, scaled

# Quantities of cells in the order of the panels: name, what is done to it, how it is called.
QUANTITIES = (
    ("velocity along the flow", "ratio", "Velocity over mean"),
    ("length", "", "Length along the flow"),
    ("smallest gap", "", "Smallest gap"),
    ("extra pressure drop", "", "Extra pressure drop"),
    ("inclination", "degrees", "Inclination"),
    ("deformation", "", "Deformation"),
    ("tank-treading rate", "", "Tank-treading rate"),
    ("intrinsic viscosity", "", "Intrinsic viscosity"),
)

# What a cell in unbounded shear does not do.
STAYS = ("velocity along the flow",)


def quantity_of(folder, table, column, treatment, text):
    """Values of a column and the label of its axis."""
    values, unit = table.columns[column], table.units[column]
    if treatment == "degrees" and unit == "rad":
        return np.degrees(values), f"{text} [°]"
    mean = folder.figures.get("mean speed", 0)
    if treatment == "ratio" and mean:
        return values / mean, f"{text} [-]"
    factor, unit = scaled(values, unit)
    return factor * values, label("velocity along the flow" if treatment == "ratio" else text, unit)


def series_panels(table):
    """For each quantity that is there: how it is drawn, and its columns by cell."""
    panels = []
    for name, treatment, text in QUANTITIES:
        if name in STAYS and table.has("strain"):
            continue
        columns = {}
        for number, column in enumerate(table.names):
            match = re.fullmatch(r"cell (\d+): (.+)", column)
            if not np.isfinite(table.columns[number]).any():
                continue
            if (match and match[2] == name) or column == name:
                columns[int(match[1]) if match else -1] = number
        if columns:
            panels.append((name, treatment, text, columns))
    return panels


def mark_settling(axis, folder, name, cells, time, along, unit):
    """A line where the last of the cells has become steady."""
    settled = [folder.figures.get(f"cell {cell}: settling time of {name}", np.nan) for cell in cells]
    if not settled or not np.isfinite(settled).all():
        return
    place = np.interp(max(settled), time, along)
    axis.axvline(place, color=GREEN, linestyle=":", linewidth=1.4)
    axis.annotate(
        f"steady from {place:.3g} {unit}".rstrip(),
        (place, 0),
        (4, 4),
        xycoords=("data", "axes fraction"),
        textcoords="offset points",
        color=GREEN,
        fontsize=8,
    )


def draw_cell_series(folder):
    table = folder.table("series.csv")
    if table is None or len(table) == 0 or not table.has("time"):
        return
    panels = series_panels(table)
    if not any(cell >= 0 for panel in panels for cell in panel[3]):
        return
    along = "strain" if table.has("strain") else "time"
    factor, unit = scaled(table[along], table.unit(along))
    x = factor * table[along]
    columns = 1 if len(panels) == 1 else 2
    rows = -(-len(panels) // columns)
    figure, axes = plt.subplots(
        rows, columns, figsize=(4.5 * columns, 2.3 * rows + 0.9), sharex=True, squeeze=False
    )
    colours = (BLUE, ORANGE, RED, GREEN, GREY)
    for axis, (name, treatment, text, by_cell) in zip(axes.ravel(), panels):
        for cell, column in sorted(by_cell.items()):
            values, caption = quantity_of(folder, table, column, treatment, text)
            is_one = len(by_cell) == 1
            colour = BLUE if is_one else colours[cell % len(colours)]
            style = "-" if cell < len(colours) else "--"
            axis.plot(x, values, style, color=colour, label=None if is_one else f"cell {cell}")
        axis.set_ylabel(caption, fontsize=9)
        axis.margins(x=0.02, y=0.12)
        # Figures of many digits hide the curve behind an offset that is hard to read.
        axis.ticklabel_format(axis="y", useOffset=False)
        mark_settling(axis, folder, name, [c for c in by_cell if c >= 0], table["time"], x, unit)
        if len(by_cell) > 1 and axis is axes[0][0]:
            # Above the axis: inside it would meet curves and marks.
            axis.legend(fontsize=8, ncol=5, loc="lower left", bbox_to_anchor=(0, 1))
    for axis in axes.ravel()[len(panels) :]:
        axis.set_visible(False)
    for column in range(columns):
        last = max(row for row in range(rows) if row * columns + column < len(panels))
        axes[last][column].tick_params(labelbottom=True)
        axes[last][column].set_xlabel(label(along, unit))
    folder.save(figure, "cell-series.png")
