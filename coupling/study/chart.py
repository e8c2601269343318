#!/usr/bin/python3
"""Draws the tables that `hemoscale chart` leaves in the results of a study.

    chart.py chart FOLDER --title NAME --error COLUMN [--refinement COLUMN]
    chart.py map FOLDER --title NAME --boundary "KEY [UNIT]" [--along COLUMN] [--prediction NAME]

chart    chart.csv, orders.csv: error against CPU time with the runs that no other run beats, and
         error against the refinement axis with reference slopes                      chart.png
map      map.csv: stability boundary with its bracket, and the predicted limit        map.png

COLUMN is a name in the header of the table. Needs the Debian packages python3-matplotlib and
python3-numpy.
"""

import argparse
import csv
import os
import re
import sys

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np
except ImportError as missing:
    sys.exit(f"{missing}; install python3-matplotlib and python3-numpy")

# Colours of Okabe and Ito (2008), which colour-blind readers tell apart; markers differ too.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"]
MARKERS = ["o", "s", "^", "D", "v", "P", "X", "<", ">", "*"]
GREY = "#777777"
PREFIXES = {-12: "p", -9: "n", -6: "µ", -3: "m", 0: "", 3: "k", 6: "M", 9: "G"}

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
    """A table of texts and numbers; a cell that is empty is no number."""

    def __init__(self, path):
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        if not rows:
            sys.exit(f"{path}: there is no header")
        self.path, self.header, self.rows = path, rows[0], rows[1:]

    def texts(self, name):
        if name not in self.header:
            sys.exit(f"{self.path}: there is no column '{name}'")
        return [row[self.header.index(name)] for row in self.rows]

    def numbers(self, name):
        return np.array([to_number(text) for text in self.texts(name)])

    def starting(self, start):
        """The first column whose name begins so."""
        return next(name for name in self.header if name.startswith(start))


def to_number(text):
    try:
        return float(text)
    except ValueError:
        return np.nan


def split_unit(column):
    match = re.fullmatch(r"(.+) \[(.+)\]", column)
    return (match[1], match[2]) if match else (column, "-")


def axis_label(name, unit, prefix=""):
    if " " not in name:  # a key of the case: its last word says enough
        name = name.split(".")[-1]
    name = name.replace("_", " ")
    name = name[:1].upper() + name[1:]
    return name if unit == "-" else f"{name} [{prefix}{unit.replace('Pa s', 'Pa·s')}]"


def scaled(values, unit):
    """Factor and prefix in which values of an SI unit have few digits."""
    finite = np.abs(values[np.isfinite(values)])
    finite = finite[finite > 0]
    if unit not in ("m", "m/s", "s", "Pa", "Pa s", "N/m") or not finite.size:
        return 1.0, ""
    power = int(3 * np.floor(np.log10(finite.max() * 1.0001) / 3))
    power = min(max(power, -12), 9)
    return 10.0**-power, PREFIXES[power]


def plain_logarithmic(axis):
    """Numbers as 0.2, 1, 50 instead of powers of ten, and enough of them, where an axis is short."""
    for which, (low, high) in ((axis.xaxis, axis.get_xlim()), (axis.yaxis, axis.get_ylim())):
        if which.get_scale() != "log" or not 0 < low < high:
            continue
        decades = np.log10(high / low)
        if decades > 3.5 or low < 1e-3 or high > 1e4:
            continue
        which.set_major_formatter(matplotlib.ticker.FuncFormatter(lambda x, _: f"{x:.10g}"))
        if decades > 1.7:
            continue
        for digits in ([1, 2, 5], [1, 2, 3, 4, 6, 8], list(np.arange(1, 10, 0.5)), list(np.arange(1, 10, 0.1))):
            values = [d * 10.0**k for k in range(-4, 5) for d in digits]
            values = [value for value in values if low <= value <= high]
            if len(values) >= 3:
                break
        which.set_major_locator(matplotlib.ticker.FixedLocator(values))
        which.set_minor_locator(matplotlib.ticker.NullLocator())


def style(number):
    return {
        "color": COLOURS[number % len(COLOURS)],
        "marker": MARKERS[number % len(MARKERS)],
        "markersize": 6,
        "linestyle": ["-", "--", "-."][number // len(COLOURS) % 3],
    }


def save(figure, path):
    aside = path + ".part"
    figure.savefig(aside, dpi=150, format="png")
    os.replace(aside, path)
    print(path)


def order_text(orders, curve):
    """Such as "order 1.98 ± 0.03" of a curve; empty if it has none."""
    if orders is None:
        return ""
    for name, order, error in zip(
        orders.texts("curve"), orders.numbers("order [-]"), orders.numbers("standard error [-]")
    ):
        if name == curve and np.isfinite(order):
            return f"order {order:.2f}" + (f" ± {error:.2f}" if np.isfinite(error) else "")
    return ""


def reference_slopes(axis, refinement, error, orders):
    """Dotted lines of the whole orders next to the observed ones, in the lower corner."""
    usable = np.isfinite(refinement) & np.isfinite(error) & (error > 0)
    if orders is None or usable.sum() < 2:
        return
    observed = orders.numbers("order [-]")
    whole = sorted({int(round(p)) for p in observed[np.isfinite(observed)] if 0.5 <= p <= 8})
    low, high = refinement[usable].min(), refinement[usable].max()
    if low == high:
        return
    # An axis that grows with refinement (a number of nodes) falls to the right.
    values = refinement[usable]
    sign = -1 if values[-1] > values[0] else 1
    h = np.array([low, high])
    middle = np.sqrt(low * high)
    centre = np.exp(np.mean(np.log(error[usable])))
    limits = axis.get_ylim()
    for p in whole:
        line = 0.35 * centre * (h / middle) ** (sign * p)
        axis.plot(h, line, ":", color=GREY, linewidth=1.2, zorder=1)
        end = 0 if sign > 0 else 1
        axis.annotate(
            f"order {p}",
            (h[end], line[end]),
            xytext=(4 if end == 0 else -4, -3),
            textcoords="offset points",
            ha="left" if end == 0 else "right",
            va="top",
            fontsize=8,
            color=GREY,
        )
    axis.set_ylim(min(limits[0], axis.get_ylim()[0]), max(limits[1], axis.get_ylim()[1]))


def draw_chart(arguments):
    table = Table(os.path.join(arguments.folder, "chart.csv"))
    orders_path = os.path.join(arguments.folder, "orders.csv")
    orders = Table(orders_path) if arguments.refinement and os.path.exists(orders_path) else None
    curve = np.array(table.texts("curve"))
    status = np.array(table.texts("status"))
    front = np.array(table.texts("on front")) == "yes"
    error, cpu = table.numbers(arguments.error), table.numbers("cpu time [s]")
    refinement = table.numbers(arguments.refinement) if arguments.refinement else None
    names = list(dict.fromkeys(curve))
    shown = np.isfinite(error) & (error > 0)

    panels = 2 if refinement is not None else 1
    rows = int(np.ceil(len(names) / 2)) + 1
    height = 4.4 + 0.22 * rows
    figure, axes = plt.subplots(1, panels, figsize=(5.4 * panels, height), sharey=True, squeeze=False)
    time_axis = axes[0][0]
    handles = []
    if refinement is not None:
        key, refinement_unit = split_unit(arguments.refinement)
        factor, prefix = scaled(refinement, refinement_unit)
    for number, name in enumerate(names):
        of_curve = curve == name
        use = of_curve & shown
        label = name or "runs"
        if order_text(orders, name):
            label += ": " + order_text(orders, name)
        for what in ("failed", "timed out"):
            count = int((of_curve & (status == what)).sum())
            if count:
                label += f" ({count} {what})"
        (handle,) = time_axis.plot(cpu[use], error[use], label=label, **style(number))
        handles.append(handle)
        if refinement is not None:
            axes[0][1].plot(refinement[use] * factor, error[use], **style(number))
    best = np.flatnonzero(front & shown)
    best = best[np.argsort(cpu[best])]
    (handle,) = time_axis.plot(
        cpu[best],
        error[best],
        "o-",
        color=GREY,
        alpha=0.45,
        linewidth=6,
        markersize=13,
        zorder=0,
        solid_capstyle="round",
        label="best: no run is both faster and more exact",
    )
    handles.append(handle)
    for axis in axes[0]:
        axis.set_xscale("log")
        axis.set_yscale("log")
    time_axis.set_xlabel("CPU time of the run [s]")
    name, unit = split_unit(arguments.error)
    if name.startswith("error of ") and "error" in name[len("error of ") :]:
        name = name[len("error of ") :]  # the figure is an error itself
    time_axis.set_ylabel(axis_label(name, unit))
    if refinement is not None:
        axes[0][1].set_xlabel(axis_label(key, refinement_unit, prefix))
        reference_slopes(axes[0][1], refinement * factor, error, orders)
    for axis in axes[0]:
        plain_logarithmic(axis)
    if not shown.any():
        time_axis.text(0.5, 0.5, "no run has an error", transform=time_axis.transAxes, ha="center")
    figure.suptitle(arguments.title, x=0.01, ha="left", fontweight="bold")
    figure.tight_layout(rect=(0, 0.22 * rows / height, 1, 1))
    figure.legend(handles=handles, loc="lower left", bbox_to_anchor=(0.02, 0.01), ncol=2, fontsize=9)
    save(figure, os.path.join(arguments.folder, "chart.png"))


def draw_map(arguments):
    table = Table(os.path.join(arguments.folder, "map.csv"))
    key, unit = split_unit(arguments.boundary)
    curve = np.array(table.texts("curve"))
    outcome = np.array(table.texts("outcome"))
    boundary = table.numbers(table.starting("boundary ["))
    stable = table.numbers(table.starting("stable ["))
    unstable = table.numbers(table.starting("unstable ["))
    predicted = table.numbers(table.starting("predicted ["))
    names = list(dict.fromkeys(curve))
    factor, prefix = scaled(np.concatenate([boundary, predicted]), unit)

    ticks = None
    if arguments.along:
        along = table.numbers(arguments.along)
        along_label = axis_label(*split_unit(arguments.along))
        if np.isnan(along).any():  # words
            ticks = list(dict.fromkeys(table.texts(arguments.along)))
            along = np.array([ticks.index(text) for text in table.texts(arguments.along)], float)
        else:
            along_factor, along_prefix = scaled(along, split_unit(arguments.along)[1])
            along = along * along_factor
            along_label = axis_label(*split_unit(arguments.along), prefix=along_prefix)
    else:
        ticks, along_label = [name or "runs" for name in names], ""
        along = np.array([names.index(name) for name in curve], float)

    rows = int(np.ceil((len(names) + 2) / 2))
    height = 4.2 + 0.24 * rows
    figure, axis = plt.subplots(figsize=(6.4, height))
    for number, name in enumerate(names):
        use = (curve == name) & (outcome == "found")
        order = np.flatnonzero(use)[np.argsort(along[use])]
        look = style(number)
        bracket = np.sort(np.array([stable[order], unstable[order]]), axis=0)
        axis.errorbar(
            along[order],
            boundary[order] * factor,
            yerr=np.abs(bracket - boundary[order]) * factor,
            capsize=3,
            label=name or "found boundary",
            **{**look, "linestyle": look["linestyle"] if arguments.along and not ticks else "none"},
        )
        order = np.flatnonzero(curve == name)[np.argsort(along[curve == name])]
        if np.isfinite(predicted[order]).any():
            axis.plot(
                along[order],
                predicted[order] * factor,
                "--" if arguments.along and not ticks else "_",
                markersize=24,
                markeredgewidth=2,
                color=look["color"],
                alpha=0.6,
            )
        for what, ends, marker in (
            ("stable at the unstable end", unstable, "^"),
            ("unstable at the stable end", stable, "v"),
        ):
            chosen = (curve == name) & (outcome == what)
            if chosen.any():
                axis.plot(
                    along[chosen], ends[chosen] * factor, marker, color=look["color"], fillstyle="none",
                    markersize=9, label=(name + ": " if name else "") + what,
                )
    axis.set_yscale("log")
    if ticks is None and (along > 0).all() and along.max() > 10 * along.min():
        axis.set_xscale("log")
    if ticks is not None:
        axis.set_xticks(range(len(ticks)), ticks)
        axis.set_xlim(-0.6, len(ticks) - 0.4)
    axis.set_xlabel(along_label)
    axis.set_ylabel(axis_label(key, unit, prefix))
    low, high = axis.get_ylim()
    axis.set_ylim(low / 1.15, high * 1.15)
    if len(names) == 1 and ticks is None and np.isfinite(boundary).sum() > 1:
        use = np.flatnonzero(np.isfinite(boundary))
        use = use[np.argsort(along[use])]
        grows = unstable[use[0]] > stable[use[0]]
        low, high = axis.get_ylim()
        sides = [("stable", low if grows else high), ("unstable", high if grows else low)]
        for (what, edge), colour in zip(sides, ("#009E73", "#D55E00")):
            axis.fill_between(
                along[use], boundary[use] * factor, edge, color=colour, alpha=0.08, linewidth=0, label=what
            )
        axis.set_ylim(low, high)
    plain_logarithmic(axis)
    handles, labels = axis.get_legend_handles_labels()
    if np.isfinite(predicted).any():
        handles.append(matplotlib.lines.Line2D([], [], linestyle="--", color=GREY))
        labels.append("predicted: " + arguments.prediction)
    figure.suptitle(arguments.title, x=0.01, ha="left", fontweight="bold")
    figure.tight_layout(rect=(0, 0.24 * rows / height, 1, 1))
    figure.legend(handles, labels, loc="lower left", bbox_to_anchor=(0.02, 0.0), ncol=2, fontsize=9)
    save(figure, os.path.join(arguments.folder, "map.png"))


def main():
    parser = argparse.ArgumentParser(description="Draws the tables of a study.")
    commands = parser.add_subparsers(dest="command", required=True)
    chart = commands.add_parser("chart")
    stability = commands.add_parser("map")
    for command in (chart, stability):
        command.add_argument("folder")
        command.add_argument("--title", default="")
    chart.add_argument("--error", required=True)
    chart.add_argument("--refinement")
    stability.add_argument("--boundary", required=True)
    stability.add_argument("--along")
    stability.add_argument("--prediction", default="")
    arguments = parser.parse_args()
    if arguments.command == "chart":
        draw_chart(arguments)
    else:
        draw_map(arguments)


if __name__ == "__main__":
    main()
