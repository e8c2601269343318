#!/usr/bin/env python3
"""What a step of an ensemble costs per node, beside LAMMPS with the same positions.

    compare.py BENCHMARK [--peer lmp] [--cells 120 1200 12000 120000] [--peer-cells 120 1200 12000]
               [--repetitions 3] [--folder FOLDER]

BENCHMARK is the program benchmark_ensemble_speed; without LAMMPS (Debian: package lammps) give
--peer "". Prints medians of the processor time per node and step in ns, the exponent of their growth
with the number of cells, and the bytes per node of the largest ensemble. Only the standard library is
needed. Say how loaded the machine was with every figure.
"""
import argparse
import math
import os
import resource
import statistics
import subprocess
import sys
from pathlib import Path

NODES = 100


def processor_time(command):
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def peer_cost(program, folder, cells):
    """Difference of two lengths of runs: what comes before the first step drops out."""
    data_cells = min(cells, 1200)
    steps = max(10, min(400, 120000 * 100 // (cells * NODES)))
    source = Path(__file__).resolve().parent / "peer.in"
    command = [program, "-in", str(source), "-log", "none", "-screen", "none",
               "-var", "data", str(folder / f"cells-{data_cells}.data"),
               "-var", "copies", str(cells // data_cells)]
    short = processor_time(command + ["-var", "steps", "5"])
    long = processor_time(command + ["-var", "steps", str(5 + steps)])
    return 1e9 * (long - short) / (steps * cells * NODES)


def exponent(costs):
    """Slope of ln(time of a step) over ln(cells)."""
    points = [(math.log(c), math.log(c * cost)) for c, cost in costs.items()]
    if len(points) < 2:
        return float("nan")
    x = statistics.mean(p[0] for p in points)
    y = statistics.mean(p[1] for p in points)
    return sum((a - x) * (b - y) for a, b in points) / sum((a - x) ** 2 for a, _ in points)


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("benchmark")
    parser.add_argument("--peer", default="lmp")
    parser.add_argument("--cells", type=int, nargs="+", default=[120, 1200, 12000, 120000])
    parser.add_argument("--peer-cells", type=int, nargs="+", default=[120, 1200, 12000])
    parser.add_argument("--repetitions", type=int, default=3)
    parser.add_argument("--folder", type=Path, default=Path("ensemble-speed"))
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    print(f"load of the machine at the start: {os.getloadavg()[0]:.2f}", file=sys.stderr)

    # {(scheme, precision): {cells: [ns]}}
    samples, memory = {}, {}
    for _ in range(options.repetitions):
        for cells in options.cells:
            output = subprocess.run([options.benchmark, str(options.folder), "1", str(cells)],
                                    check=True, text=True, stdout=subprocess.PIPE).stdout
            for line in output.split():
                scheme, precision, count, cost, size = line.split(",")
                key = (scheme, precision)
                samples.setdefault(key, {}).setdefault(int(count), []).append(float(cost))
                memory.setdefault(key, {})[int(count)] = float(size)
            if options.peer and cells in options.peer_cells:
                key = ("LAMMPS, explicit", "double")
                cost = peer_cost(options.peer, options.folder, cells)
                samples.setdefault(key, {}).setdefault(cells, []).append(cost)
    head = "".join(f"{c:>10} cells  " for c in options.cells)
    print(f"{'ns per node and step':32}{head} exponent")
    for key, by_cells in samples.items():
        medians = {c: statistics.median(v) for c, v in by_cells.items()}
        row = "".join(f"{medians[c]:10.2f} ({max(by_cells[c]) - min(by_cells[c]):4.2f})"
                      if c in medians else " " * 17 for c in options.cells)
        print(f"{', '.join(key):32}{row} {exponent(medians):7.3f}")
    print("In brackets: largest less smallest sample. Bytes per node of the largest ensemble: "
          + ", ".join(f"{k[0]} {k[1]} {v[max(v)]:.0f}" for k, v in memory.items()
                      if v[max(v)] > 0))
    print(f"load of the machine at the end: {os.getloadavg()[0]:.2f}", file=sys.stderr)


if __name__ == "__main__":
    main()
