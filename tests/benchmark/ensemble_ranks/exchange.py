#!/usr/bin/env python3
"""Error of copies that are exchanged every K steps: distance of the nodes from those of one rank.

    exchange.py HEMOSCALE CASE [--ranks 2] [--intervals 1 2 5 10 20] [--set KEY=VALUE ...]

CASE is a case of an ensemble in a channel; it is run by one rank, then by several with copies that are
carried by the flow ("flow") and that stay ("frozen"), and by 2, 3 and 4 ranks with the program's own
choice of K. Only the standard library is needed.
"""
import argparse
import json
import os
import subprocess
import tempfile
from pathlib import Path


def run(options, results, ranks, *settings):
    command = [options.hemoscale, "run", options.case, "--results", str(results)]
    for each in [*options.set, "output.trajectory=false", *settings]:
        command += ["--set", each]
    if ranks > 1:
        command = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-np", str(ranks), *command]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                   env={**os.environ, "OMP_NUM_THREADS": "1"})
    summary = json.loads((results / "summary.json").read_text())
    return {f["name"]: f["value"] for f in summary["figures"]}


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("hemoscale")
    parser.add_argument("case")
    parser.add_argument("--ranks", type=int, default=2)
    parser.add_argument("--intervals", type=int, nargs="+", default=[1, 2, 5, 10, 20])
    parser.add_argument("--set", action="append", default=[])
    options = parser.parse_args()
    with tempfile.TemporaryDirectory() as scratch:
        scratch = Path(scratch)
        run(options, scratch / "one", 1, "output.nodes=true")
        reference = f"output.reference_nodes={scratch}/one/nodes.csv"
        error = "distance of the nodes from the reference"
        count = 0

        def distance(ranks, *settings):
            nonlocal count
            count += 1
            figures = run(options, scratch / f"run-{count}", ranks, reference, *settings)
            return figures[error], figures["steps between exchanges of copies"]

        print("K      flow [um]      frozen [um]")
        for interval in options.intervals:
            errors = [distance(options.ranks, f"micro.regions.exchange_interval={interval}",
                               f"micro.regions.copies={copies}")[0] for copies in ("flow", "frozen")]
            print(f"{interval:<6} {1e6 * errors[0]:<14.3e} {1e6 * errors[1]:.3e}", flush=True)
        for ranks in (2, 3, 4):
            found, interval = distance(ranks)
            print(f"{ranks} ranks, own choice K = {interval:.0f}: {1e6 * found:.3e} um", flush=True)


if __name__ == "__main__":
    main()
