#!/usr/bin/python3
"""Draws what a results folder holds, as PNG files in the same folder.

    plot.py RESULTS

profile.csv      velocity and viscosity across the channel, against the reference       profile.png
law.csv          viscosity law with its confidence band, samples.csv with error bars    law.png
series.csv       a coupled run: convergence of the passes (or passes.csv)               convergence.png
                 otherwise: every column over the first one                             series.png
trajectory*.h5   cells in the first and in the last frame                               cells*.png
cells.csv        outlines over time, the last one enlarged                              cell-shapes.png
flow*.csv        pressure and streamlines around the cells                              cell-flow.png
series.csv       with columns of cells: speed, length, gap, angle, steady state         cell-series.png
series.csv       of an ensemble in a given flow, with the tables beside it:             ensemble-*.png
                 cells at start and end, concentration over time, profiles, series

What is absent is not drawn. Needs the Debian packages python3-matplotlib, python3-numpy and, for
trajectories, python3-h5py-mpi (or python3-h5py).
"""

import glob
import os
import re
import sys
import textwrap

# Where the scripts lie may not be writable, and is no place for compiled copies.
sys.dont_write_bytecode = True

import matplotlib
import matplotlib.pyplot as plt
import numpy as np

from cell_series import draw_cell_series
from cells import draw_cell_flow, draw_cell_shapes
from ensemble import draw_ensemble
from ensemble_tables import is_ensemble
from feed import draw_feed, is_feed
from picture import BLUE, GREEN, GREY, ORANGE, RED, Folder, label, scaled
from trajectories import open_trajectory


def draw_profile(folder):
    table = folder.table("profile.csv")
    if table is None or len(table) == 0:
        return
    quantities = [n for n in range(1, len(table.names)) if not table.names[n].startswith("reference")]
    figure, axes = plt.subplots(
        1, len(quantities), figsize=(3.3 * len(quantities), 3.8), sharey=True, squeeze=False
    )
    height_factor, height_unit = scaled(table.columns[0], table.units[0])
    height = table.columns[0] * height_factor
    for axis, n in zip(axes[0], quantities):
        factor, unit = scaled(table.columns[n], table.units[n])
        axis.plot(table.columns[n] * factor, height, color=BLUE, label="this run")
        reference = table.index("reference " + table.names[n])
        if reference is not None and np.isfinite(table.columns[reference]).any():
            axis.plot(
                table.columns[reference] * factor, height, "--", color=RED, label="reference"
            )
            axis.legend(loc="best")
        axis.set_xlabel(label(table.names[n], unit))
        if np.nanmin(table.columns[n]) >= 0:
            axis.set_xlim(left=0)
    axes[0][0].set_ylabel(label(table.names[0], height_unit))
    folder.save(figure, "profile.png")


def draw_law(folder):
    law, samples = folder.table("law.csv"), folder.table("samples.csv")
    if law is None and samples is None:
        return
    figure, axis = plt.subplots(figsize=(5.5, 5))
    source = law if law is not None else samples
    factor, unit = scaled(source["viscosity"], source.unit("viscosity"))
    if law is not None:
        axis.plot(law["shear rate"], law["viscosity"] * factor, color=BLUE, label="law")
        if law.has("lower", "upper"):
            axis.fill_between(
                law["shear rate"],
                law["lower"] * factor,
                law["upper"] * factor,
                color=BLUE,
                alpha=0.2,
                linewidth=0,
                label="95 % band",
            )
    if samples is not None and len(samples):
        # The passes before the last one are where the loop came from; the last is what it found.
        last = np.ones(len(samples), bool)
        if samples.has("pass"):
            last = samples["pass"] == samples["pass"].max()
        groups = [(~last, ORANGE, "s", "samples of earlier passes"), (last, RED, "o", "samples")]
        for chosen, colour, marker, name in groups:
            if not chosen.any():
                continue
            axis.errorbar(
                samples["shear rate"][chosen],
                samples["viscosity"][chosen] * factor,
                yerr=2 * samples["standard error"][chosen] * factor,
                fmt=marker,
                color=colour,
                markersize=4,
                capsize=2,
                linewidth=1,
                label=name + " ± 2 standard errors",
            )
    axis.set_xscale("log")
    axis.set_xlabel(label("shear rate", source.unit("shear rate")))
    axis.set_ylabel(label("viscosity", unit))
    axis.legend(loc="lower left", bbox_to_anchor=(0, 1), fontsize=9)
    folder.save(figure, "law.png")


def draw_convergence(folder, table):
    has_relaxation = table.has("relaxation")
    figure, axes = plt.subplots(
        1 + has_relaxation,
        1,
        figsize=(5.5, 3.4 + 1.4 * has_relaxation),
        sharex=True,
        squeeze=False,
        gridspec_kw={"height_ratios": [2.5, 1][: 1 + has_relaxation]},
    )
    styles = [(BLUE, "o-"), (GREY, "s--"), (GREEN, "^:")]
    names = [n for n, name in enumerate(table.names) if name.startswith("change")]
    for n, (colour, style) in zip(names, styles):
        values = np.where(table.columns[n] > 0, table.columns[n], np.nan)
        axes[0][0].plot(
            table["pass"], values, style, color=colour, markersize=4, label=label(table.names[n], "")
        )
    axes[0][0].set_yscale("log")
    axes[0][0].set_ylabel("Change between passes [-]")
    if len(names) > 1:
        axes[0][0].legend(loc="best")
    if has_relaxation:
        axes[1][0].plot(table["pass"], table["relaxation"], "D-", color=ORANGE, markersize=4)
        axes[1][0].set_ylabel("Relaxation\nfactor [-]")
        axes[1][0].set_ylim(0, 1.15 * max(table["relaxation"].max(), 1e-3))
    axes[-1][0].set_xlabel("Pass")
    axes[-1][0].xaxis.set_major_locator(matplotlib.ticker.MaxNLocator(integer=True))
    folder.save(figure, "convergence.png")


def draw_series(folder):
    for name in ("passes.csv", "series.csv"):
        table = folder.table(name)
        if table is not None and len(table) and table.has("pass", "change"):
            draw_convergence(folder, table)
            return
    if table is None or len(table) == 0:
        return
    # Of many cells the first stands for all; draw_cell_series shows the others.
    shown = [n for n, name in enumerate(table.names) if n and not re.match(r"cell [1-9]\d*:", name)]
    count = len(shown)
    figure, axes = plt.subplots(count, 1, figsize=(6, 1.2 + 1.7 * count), sharex=True, squeeze=False)
    factor, unit = scaled(table.columns[0], table.units[0])
    for axis, n in zip(axes[:, 0], shown):
        value_factor, value_unit = scaled(table.columns[n], table.units[n])
        axis.plot(table.columns[0] * factor, table.columns[n] * value_factor, color=BLUE)
        axis.set_ylabel(textwrap.fill(label(table.names[n], value_unit), 22), fontsize=8)
    axes[-1][0].set_xlabel(label(table.names[0], unit))
    folder.save(figure, "series.png")


def draw_frame(axis, file, frame):
    (particles,) = file["particles"].values()
    # Lengths in micrometres.
    positions = particles["position/value"][frame] * 1e6
    length, height = particles["box/edges"][...] * 1e6
    cells = particles["cell"][...]
    periodic = [kind in (b"periodic", "periodic") for kind in particles["box"].attrs["boundary"]]
    offset = file["observables/box_offset/value"][frame] * 1e6
    for cell in range(cells.max() + 1):
        ring = positions[cells == cell]
        # Every image that reaches into the box; the upper image of a sheared box is displaced.
        rows = range(-1, 2) if periodic[1] else [0]
        for row in rows:
            shifted = ring + [row * offset, row * height]
            if shifted[:, 1].max() < 0 or shifted[:, 1].min() > height:
                continue
            first = int(np.floor(shifted[:, 0].min() / length)) if periodic[0] else 0
            last = int(np.floor(shifted[:, 0].max() / length)) if periodic[0] else 0
            for column in range(first, last + 1):
                image = shifted - [column * length, 0]
                axis.fill(
                    image[:, 0], image[:, 1], facecolor=RED, alpha=0.35, edgecolor=RED, linewidth=0.7
                )
    free = positions[cells < 0]
    axis.plot(free[:, 0], free[:, 1], ".", color=BLUE, markersize=1)
    axis.set_xlim(0, length)
    axis.set_ylim(0, height)
    axis.set_aspect("equal")
    axis.grid(False)
    for side in axis.spines.values():
        side.set_visible(True)
    factor, unit = scaled(particles["position/time"][frame : frame + 1], "s")
    axis.set_title(f"t = {particles['position/time'][frame] * factor:.4g} {unit}", fontsize=10)
    axis.set_xlabel("x [µm]")
    axis.set_ylabel("y [µm]")


def draw_cells(folder):
    for path in sorted(glob.glob(os.path.join(folder.path, "trajectory*.h5"))):
        with open_trajectory(path) as file:
            (particles,) = file["particles"].values()
            frames = particles["position/step"].shape[0]
            length, height = particles["box/edges"][...][:2]
            if frames == 0 or particles["position/value"].shape[2] != 2:
                continue
            chosen = [0] if frames == 1 else [0, frames - 1]
            # Wide boxes one above the other, others side by side.
            is_wide = length > 2 * height
            width = 9 if is_wide else 4.5
            panel = width * height / length + 0.9
            rows, columns = (len(chosen), 1) if is_wide else (1, len(chosen))
            figure, axes = plt.subplots(
                rows, columns, figsize=(width * columns, panel * rows + 0.4), squeeze=False
            )
            for axis, frame in zip(axes.ravel(), chosen):
                draw_frame(axis, file, frame)
        name = os.path.splitext(os.path.basename(path))[0].replace("trajectory", "cells")
        folder.save(figure, name + ".png")


def main():
    if len(sys.argv) != 2 or not os.path.isdir(sys.argv[1]):
        sys.exit("usage: plot.py RESULTS\nRESULTS is the folder of results of a run")
    folder = Folder(sys.argv[1])
    if is_ensemble(folder):
        draw_ensemble(folder)
        return
    if is_feed(folder):
        draw_feed(folder)
        return
    draw_profile(folder)
    draw_law(folder)
    draw_series(folder)
    draw_cells(folder)
    draw_cell_shapes(folder)
    draw_cell_flow(folder)
    draw_cell_series(folder)


if __name__ == "__main__":
    main()
