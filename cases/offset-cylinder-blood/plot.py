"""Draws the viscosity around the cylinder, and the law behind it.

    plot.py RESULTS

Reads the fields that OpenFOAM wrote (ASCII), law.csv and samples.csv of the coupled run. Writes
RESULTS/offset-cylinder-blood.png and RESULTS/figures.json; exits with 1 if the viscosity in the mesh
is not that of the law.
"""

import csv
import json
import pathlib
import re
import sys

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
from matplotlib.colors import LogNorm  # noqa: E402
from matplotlib.ticker import ScalarFormatter  # noqa: E402
from matplotlib.tri import Triangulation  # noqa: E402

LENGTH = 0.25e-3  # [m] of 1 in the tutorial, as in case.toml
TIME = 25e-3  # [s]
DENSITY = 1050.0  # [kg/m^3]
VISCOSITY = DENSITY * LENGTH**2 / TIME  # [Pa s] of 1


def read_field(path):
    """Cell values of a field: one row per cell."""
    text = path.read_text(encoding="ascii")
    found = re.search(r"internalField\s+nonuniform\s+List<\w+>\s*(\d+)\s*\((.*?)\n\)\s*;", text, re.S)
    if not found:
        raise SystemExit(f"{path}: no ASCII list of cell values")
    numbers = found.group(2).replace("(", " ").replace(")", " ").split()
    return np.array(numbers, dtype=float).reshape(int(found.group(1)), -1)


def read_table(path):
    """Columns of a CSV file by their names without unit."""
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    values = np.array([[float(v) for v in row] for row in rows[1:]]).reshape(len(rows) - 1, -1)
    return {name.split(" [")[0]: values[:, k] for k, name in enumerate(rows[0])}


def read_case(folder):
    """Centres, shear rate and viscosity of the cells at the last time, in the tutorial's units."""
    times = [p for p in folder.iterdir() if p.is_dir() and re.fullmatch(r"[0-9.]+", p.name)]
    last = max(times, key=lambda p: float(p.name))
    gradient = read_field(last / "grad(U)").reshape(-1, 3, 3)
    deformation = (gradient + gradient.transpose(0, 2, 1)) / 2
    return {
        "time": float(last.name),
        "x": read_field(last / "C")[:, :2],
        "shear rate": np.sqrt(2 * (deformation**2).sum(axis=(1, 2))),
        "nu": read_field(last / "nu")[:, 0],
        "speed": np.linalg.norm(read_field(last / "U"), axis=1),
    }


def mesh_of(x):
    """Triangles between cell centres, without those inside the cylinder (radius 1)."""
    triangles = Triangulation(x[:, 0], x[:, 1])
    centre = x[triangles.triangles].mean(axis=1)
    triangles.set_mask(np.hypot(centre[:, 0], centre[:, 1]) < 1.0)
    return triangles


def main(results):
    results = pathlib.Path(results)
    ours = read_case(results / "openfoam")
    law = read_table(results / "coupled" / "law.csv")
    samples = read_table(results / "coupled" / "samples.csv")
    stock = read_case(results / "stock") if (results / "stock").is_dir() else None

    mu = ours["nu"] * VISCOSITY
    rate = ours["shear rate"] / TIME
    # The solver evaluates the law at the beginning of a step, with the flow of the step before.
    expected = np.exp(np.interp(np.log(rate), np.log(law["shear rate"]), np.log(law["viscosity"])))
    deviation = np.median(np.abs(mu / expected - 1))
    figures = {
        "time [s]": ours["time"] * TIME,
        "lowest viscosity [mPa s]": mu.min() * 1e3,
        "highest viscosity [mPa s]": mu.max() * 1e3,
        "lowest shear rate [1/s]": rate.min(),
        "highest shear rate [1/s]": rate.max(),
        "highest velocity [mm/s]": ours["speed"].max() * LENGTH / TIME * 1e3,
        "median deviation of the field from the law [-]": deviation,
    }
    if stock is not None:
        figures["lowest viscosity of the stock run [tutorial's units]"] = stock["nu"].min()
        figures["highest viscosity of the stock run [tutorial's units]"] = stock["nu"].max()
        figures["lowest viscosity of the coupled run [tutorial's units]"] = ours["nu"].min()
        figures["highest viscosity of the coupled run [tutorial's units]"] = ours["nu"].max()
        figures["largest change of velocity against the stock run [inlet velocity]"] = (
            np.abs(ours["speed"] - stock["speed"]).max()
        )
    (results / "figures.json").write_text(json.dumps(figures, indent=2) + "\n", encoding="utf-8")
    for name, value in figures.items():
        print(f"{name:68s} {value:.4g}")

    figure, (field, curve) = plt.subplots(
        1, 2, figsize=(13, 4.4), gridspec_kw={"width_ratios": [2.1, 1]}, constrained_layout=True
    )
    millimetres = ours["x"] * LENGTH * 1e3
    triangles = mesh_of(ours["x"])
    shown = Triangulation(millimetres[:, 0], millimetres[:, 1], triangles.triangles, triangles.mask)
    low, high = mu.min() * 1e3, mu.max() * 1e3
    scale = LogNorm(low, high) if high > 3 * low else None  # else linear colours
    image = field.tripcolor(shown, mu * 1e3, norm=scale, cmap="viridis", shading="gouraud")
    field.add_patch(plt.Circle((0, 0), LENGTH * 1e3, color="0.75"))
    field.set_aspect("equal")
    field.set(xlabel="x [mm]", ylabel="y [mm]", title="viscosity that the cells make [mPa s]")
    figure.colorbar(image, ax=field, shrink=0.8)

    curve.loglog(rate, mu * 1e3, ".", color="0.6", markersize=2, label="cells of the mesh")
    curve.loglog(law["shear rate"], law["viscosity"] * 1e3, "-", color="#0072B2", label="law")
    error = samples["standard error"] if "standard error" in samples else None
    curve.errorbar(
        samples["shear rate"], samples["viscosity"] * 1e3,
        yerr=None if error is None else 2 * error * 1e3,
        fmt="o", color="#D55E00", markersize=4, label="micro runs (two standard errors)",
    )
    curve.set(xlabel="shear rate [1/s]", ylabel="viscosity [mPa s]", title="law")
    curve.legend(fontsize=8, loc="center right")
    curve.yaxis.set_major_formatter(ScalarFormatter())
    curve.yaxis.set_minor_formatter(ScalarFormatter())
    figure.savefig(results / "offset-cylinder-blood.png", dpi=130)
    print(f"picture: {results / 'offset-cylinder-blood.png'}")
    if deviation > 0.02:
        raise SystemExit(f"the viscosity in the mesh deviates from the law by {deviation:.3g}")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    main(sys.argv[1])
