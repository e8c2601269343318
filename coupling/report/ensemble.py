"""Pictures of an ensemble of cells in a given flow: where they are, and how that changes."""

import glob
import os

import matplotlib.pyplot as plt
import numpy as np

from cells import colour_bar
from ensemble_cells import MICRO, draw_cells_of
from ensemble_tables import COLOURS, Kinds, concentration, exact
from picture import BLUE, GREEN, GREY, ORANGE, RED, label, scaled

MAPS = ["Reds", "Blues", "Greens", "Oranges"]  # of the concentration of each kind


def draw_map(axis, times, places, fractions, kind, name):
    width = places[1] - places[0]
    edges = np.append(places - width / 2, places[-1] + width / 2)
    # A row holds from its output time on; the last one as long as the one before it.
    last = times[-1] - times[-2] if len(times) > 1 else 1
    mesh = axis.pcolormesh(
        np.append(times, times[-1] + last),
        edges,
        fractions,
        cmap=MAPS[kind],
        vmin=0,
        rasterized=True,
    )
    axis.set_ylabel("y [µm]")
    axis.grid(False)
    colour_bar(axis, mesh, f"Area fraction\nof {name} [-]")


def draw_distance(axis, time, kinds, kind):
    """How far from the axis of the channel the cells of a kind are."""
    mean = kinds.column(kind, "mean distance of the cells from the axis over half height")
    width = kinds.column(kind, "width of the concentration over that of a uniform one")
    name = kinds.names[kind]
    axis.plot(time, mean, color=COLOURS[kind], label=f"{name}: mean distance over half height")
    axis.plot(time, width / 2, "--", color=COLOURS[kind], label="half the relative width")
    axis.axhline(0.5, color=GREY, linewidth=0.8, linestyle=":")
    axis.annotate(
        "uniform",
        (1, 0.5),
        (3, 0),
        xycoords=("axes fraction", "data"),
        textcoords="offset points",
        fontsize=8,
        color=GREY,
        va="center",
    )
    axis.set_ylabel("Distance from\nthe axis [-]")


def draw_concentration(folder, kinds):
    maps = []
    for kind, name in enumerate(kinds.names):
        part = "" if kind == 0 else "-" + name.replace(" ", "-")
        found = concentration(folder, f"concentration{part}.csv")
        if found is not None:
            maps.append((kind, name, found))
    if not maps:
        return
    factor, unit = scaled(maps[0][2][0], "s")
    rows = 2 * len(maps) + 1
    figure, axes = plt.subplots(
        rows,
        1,
        figsize=(7.5, 4.3 * len(maps) + 2.0),
        sharex=True,
        gridspec_kw={"height_ratios": [2.4] * len(maps) + [1.7] * (len(maps) + 1)},
    )
    for axis, (kind, name, (times, places, fractions)) in zip(axes, maps):
        draw_map(axis, factor * times, places, fractions, kind, name)
    time = factor * kinds.series["time"]
    layer = axes[-1]
    for axis, (kind, name, _) in zip(axes[len(maps) :], maps):
        draw_distance(axis, time, kinds, kind)
    for name, style, text in (
        ("cell-free layer by the envelope", "-", "by the envelope"),
        ("cell-free layer by half the core fraction", "--", "by half the core's area fraction"),
    ):
        layer.plot(time, MICRO * kinds.column(0, name), style, color=RED, label=text)
    layer.set_ylim(bottom=0)
    layer.set_ylabel("Cell-free\nlayer [µm]")
    for axis in axes[len(maps) :]:
        axis.legend(fontsize=8, loc="lower left", bbox_to_anchor=(0, 0.98), ncol=2, borderaxespad=0)
    layer.set_xlabel(label("time", unit))
    layer.set_xlim(time[0], max(time[-1], time[0] + 1e-12))
    folder.save(figure, "ensemble-concentration.png")


def draw_profiles(folder, kinds):
    table = folder.table("profile.csv")
    if table is None or len(table) == 0:
        return
    y = MICRO * table["y"]
    figure, axes = plt.subplots(1, 4, figsize=(11, 3.9), sharey=True)
    factor, unit = scaled(exact(table, "flow velocity"), "m/s")
    axes[1].plot(
        factor * exact(table, "flow velocity"), y, "--", color=GREY, label="flow", zorder=3
    )
    stress = exact(table, "shear stress of the cells")
    stress_factor, stress_unit = scaled(stress, "Pa")
    for kind, name in enumerate(kinds.names):
        colour, prefix = COLOURS[kind], kinds.prefixes[kind]
        fraction = exact(table, prefix + "area fraction")
        if fraction is None:
            continue
        axes[0].plot(fraction, y, color=colour, label=name)
        velocity = exact(table, prefix + "cell velocity")
        axes[1].plot(factor * velocity, y, color=colour, label=name)
        shear = exact(table, prefix + "shear stress of the cells")
        axes[2].plot(stress_factor * shear, y, color=colour, label=name)
        order = exact(table, prefix + "order along the flow")
        axes[3].plot(order, y, color=colour, label=name)
    for axis in axes[:2]:
        axis.set_xlim(left=0)
    axes[3].set_xlim(-1.05, 1.05)
    axes[0].set_ylabel("y [µm]")
    for axis, text in zip(
        axes,
        (
            "Area fraction [-]",
            label("velocity", unit),
            label("shear stress of the cells", stress_unit),
            "Order along the flow [-]",
        ),
    ):
        axis.set_xlabel(text)
        axis.set_ylim(0, y[-1] + y[0])
    axes[1].legend(fontsize=8, loc="lower left", bbox_to_anchor=(0, 1), ncol=2, borderaxespad=0)
    folder.save(figure, "ensemble-profile.png")


RATES = [
    ("attraction", BLUE, "-"),
    ("repulsion", RED, "-"),
    ("walls", GREEN, "-"),
    ("other kinds", ORANGE, "--"),
    ("lift laws", GREY, "--"),
    ("the flow", GREY, ":"),
]
# Title of the axis, then (quantity, its short name) for each line.
PANELS = [
    ("Hematocrit [-]", [("tube hematocrit", "tube"), ("discharge hematocrit", "discharge")]),
    (
        "Shape and order [-]",
        [
            ("mean deformation", "deformation"),
            ("order along the flow", "order along the flow"),
            ("orientational order", "order"),
        ],
    ),
    (
        "Contacts of a cell [-]",
        [("share of cells in contact", "share in contact"), ("mean coordination", "coordination")],
    ),
    (
        "Largest strain [-]",
        [("largest area strain", "area"), ("largest perimeter strain", "perimeter")],
    ),
    (
        "Stress of the cells [Pa]",
        [("shear stress of the cells", "shear"), ("normal stress of the cells", "normal, across")],
    ),
]


def draw_rates(axis, kinds, time):
    """What changes the mean square distance of the cells from the axis."""
    total = 0
    for name, colour, style in RATES:
        rate = kinds.column(0, f"rate of the mean square distance by {name}")
        total = total + rate
        if np.any(rate != 0):
            axis.plot(time, 1e12 * rate, style, color=colour, label=name)
    axis.plot(time, 1e12 * total, color="black", linewidth=2, label="sum")
    axis.axhline(0, color=GREY, linewidth=0.8)
    axis.set_ylabel("Rate of the mean square\ndistance from the axis [µm²/s]")


def draw_series(folder, kinds):
    """The first kind alone; the tables hold the others."""
    series = kinds.series
    factor, unit = scaled(series["time"], "s")
    time = factor * series["time"]
    marker = "o" if len(time) == 1 else None
    panels = [
        (title, lines) for title, lines in PANELS if all(name in series.names for name, _ in lines)
    ]
    passages = [name for name in series.names if name.startswith("cell area through ")]
    if passages:
        lines = [(name, name[len("cell area through ") :]) for name in passages]
        panels.append(("Cell area passed [µm²]", lines))
    has_rates = "rate of the mean square distance by attraction" in series.names
    count = len(panels) + has_rates
    rows = -(-count // 2)
    size = (9.5, 2.5 * rows + 0.4)
    figure, axes = plt.subplots(rows, 2, figsize=size, squeeze=False, sharex=True)
    flat = list(axes.T.ravel())
    if has_rates:
        draw_rates(flat[0], kinds, time)
    for axis, (title, lines) in zip(flat[int(has_rates) :], panels):
        for (name, short), colour, style in zip(lines, COLOURS, ("-", "--", ":", "-.")):
            values = exact(series, name) * (1e12 if title.endswith("[µm²]") else 1)
            axis.plot(time, values, style, color=colour, marker=marker, label=short)
        axis.set_ylabel(title)
    for axis in flat[count:]:
        axis.set_visible(False)
    for axis in flat[:count]:
        axis.legend(fontsize=8, loc="lower left", bbox_to_anchor=(0, 0.98), ncol=4, borderaxespad=0)
    for axis in (flat[rows - 1], flat[count - 1]):
        axis.set_xlabel(label("time", unit))
        axis.tick_params(labelbottom=True)
    folder.save(figure, "ensemble-series.png")


def draw_ensemble(folder):
    kinds = Kinds(folder)
    for path in sorted(glob.glob(os.path.join(folder.path, "trajectory*.h5"))):
        draw_cells_of(folder, path, kinds)
    draw_concentration(folder, kinds)
    draw_profiles(folder, kinds)
    draw_series(folder, kinds)
