"""Compares the variants of channel-feedback with each other and with a quadrature of their laws.

    compare.py RESULTS VARIANT...

The quadrature is independent of the program: it reads law.csv alone and integrates the momentum
balance mu(g) g = |tau|, tau = G (H/2 - y), by the trapezoidal rule on a fine grid. Writes
RESULTS/comparison.json and RESULTS/channel-feedback.png; exits with 1 if a deviation exceeds what
the README of the case promises.
"""

import csv
import json
import pathlib
import sys

import matplotlib
import numpy as np

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

PROMISED = 0.005  # [-] largest deviation of velocities over the largest velocity
COLOURS = {"openfoam": "#D55E00", "analytic": "#0072B2", "implicit": "#009E73", "one-way": "#CC79A7"}


def read(path):
    """Columns of a CSV file by their names without unit."""
    with open(path, encoding="utf-8", newline="") as file:
        rows = list(csv.reader(file))
    values = np.array([[float(v) for v in row] for row in rows[1:]]).reshape(len(rows) - 1, -1)
    return {name.split(" [")[0]: values[:, k] for k, name in enumerate(rows[0])}


def quadrature(law, height, mean_velocity, count=20001):
    """Velocity at points across the channel under a law given as a table.

    height [m], mean_velocity [m/s]; returns y [m] and velocity [m/s].
    """
    rate = np.concatenate([[0.0], law["shear rate"]])
    stress = np.concatenate([[0.0], law["shear rate"] * law["viscosity"]])
    y = np.linspace(0.0, height / 2, count)

    def half(gradient):
        local = np.interp(gradient * (height / 2 - y), stress, rate)
        step = y[1] - y[0]
        return np.concatenate([[0.0], np.cumsum((local[1:] + local[:-1]) * step / 2)])

    low, high = 1e-12, stress[-1] / (height / 2)
    for _ in range(200):
        gradient = np.sqrt(low * high)
        velocity = half(gradient)
        mean = np.trapz(velocity, y) / (height / 2)
        low, high = (gradient, high) if mean < mean_velocity else (low, gradient)
    return np.concatenate([y, height - y[-2::-1]]), np.concatenate([velocity, velocity[-2::-1]])


def main(results, variants):
    results = pathlib.Path(results)
    profiles = {v: read(results / v / "profile.csv") for v in variants}
    laws = {v: read(results / v / "law.csv") for v in variants}
    samples = {v: read(results / v / "samples.csv") for v in variants}
    passes = {v: read(results / v / "series.csv") for v in variants}
    settings = {
        v: json.loads((results / v / "summary.json").read_text(encoding="utf-8")) for v in variants
    }

    height = 100e-6  # [m] of case.toml
    mean = 3.3333333333e-3  # [m/s] of case.toml
    report = {"promised": PROMISED, "variants": {}}
    worst = 0.0
    exact = {}
    for v in variants:
        y, u = quadrature(laws[v], height, mean)
        exact[v] = (y, u)
        deviation = np.max(np.abs(profiles[v]["velocity"] - np.interp(profiles[v]["y"], y, u)))
        report["variants"][v] = {
            "deviation from quadrature over largest velocity": deviation / np.max(u),
            "largest velocity [m/s]": float(np.max(profiles[v]["velocity"])),
            "passes": len(passes[v]["pass"]),
            "converged": bool(passes[v]["converged"][-1]),
            "micro runs": int(np.sum(passes[v]["micro runs"])),
            "lowest and highest viscosity [Pa s]": [
                float(passes[v]["lowest viscosity"][-1]),
                float(passes[v]["highest viscosity"][-1]),
            ],
            "program": settings[v].get("version"),
        }
        worst = max(worst, deviation / np.max(u))
    first = variants[0]
    for v in variants[1:]:
        if "one-way" in (v, first):
            continue
        other = np.interp(profiles[v]["y"], profiles[first]["y"], profiles[first]["velocity"])
        inside = (profiles[v]["y"] >= profiles[first]["y"][0]) & (profiles[v]["y"] <= profiles[first]["y"][-1])
        deviation = np.max(np.abs(profiles[v]["velocity"] - other)[inside]) / np.max(other)
        report["variants"][v][f"deviation from {first} over largest velocity"] = deviation
        worst = max(worst, deviation)
    report["worst deviation"] = worst
    report["within promise"] = bool(worst <= PROMISED)
    (results / "comparison.json").write_text(json.dumps(report, indent=2) + "\n", encoding="utf-8")
    print(json.dumps(report, indent=2))
    draw(results / "channel-feedback.png", variants, profiles, laws, samples, passes, exact, height, mean)
    return 0 if report["within promise"] else 1


def draw(path, variants, profiles, laws, samples, passes, exact, height, mean):
    figure, axes = plt.subplots(2, 2, figsize=(11, 8), constrained_layout=True)
    velocity, law, viscosity, change = axes.flat
    y = np.linspace(0, height, 200)
    velocity.plot(1e3 * 6 * mean * y * (height - y) / height**2, 1e6 * y, ":", color="0.5", label="plasma alone (parabola)")
    for v in variants:
        colour = COLOURS.get(v, "k")
        velocity.plot(1e3 * profiles[v]["velocity"][::6], 1e6 * profiles[v]["y"][::6], "o", ms=4, mfc="none", color=colour, label=v)
        velocity.plot(1e3 * exact[v][1], 1e6 * exact[v][0], "-", lw=1, color=colour, label=f"quadrature of its law ({v})")
        inside = laws[v]["inside the sampled range"] > 0
        law.plot(laws[v]["shear rate"], 1e3 * laws[v]["viscosity"], "-", color=colour, label=f"law, {v}")
        law.fill_between(
            laws[v]["shear rate"][inside],
            1e3 * laws[v]["lower end of 95 % band"][inside],
            1e3 * laws[v]["upper end of 95 % band"][inside],
            color=colour, alpha=0.15, lw=0,
        )
        law.errorbar(
            samples[v]["shear rate"], 1e3 * samples[v]["viscosity"], 1.96e3 * samples[v]["standard error"],
            fmt="o", ms=4, mfc="none", capsize=3, color=colour,
        )
        viscosity.plot(1e3 * profiles[v]["viscosity"], 1e6 * profiles[v]["y"], "-", color=colour, label=v)
        change.semilogy(passes[v]["pass"], np.maximum(passes[v]["change of log viscosity"], 1e-6), "o-", color=colour, label=v)
    velocity.set(xlabel="velocity [mm/s]", ylabel="y [um]", title="Velocity")
    law.set(xlabel="shear rate [1/s]", ylabel="viscosity [mPa s], two-dimensional", xscale="log", title="Law: samples with 95 % bars, simultaneous 95 % band")
    viscosity.set(xlabel="viscosity [mPa s]", ylabel="y [um]", title="Viscosity across the channel")
    change.set(xlabel="pass", ylabel="rms change of log viscosity [-]", title="Convergence of the coupled loop")
    change.xaxis.get_major_locator().set_params(integer=True)
    for axis in axes.flat:
        axis.legend(fontsize=8)
        axis.grid(alpha=0.3)
    figure.savefig(path, dpi=130)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))
