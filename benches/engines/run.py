#!/usr/bin/env python3
"""All engines side by side: runs the Rust benchmark, peers.py and peers.mjs, and prints one table.

    run.py [--table FILE] [--criterion DIRECTORY] [--without-rust]

`run.sh` installs what is needed first and calls this.
"""

import argparse
import json
import os
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
COLUMNS = {
    "point cubic": "point, plane cubic Bézier",
    "point origin": "the same through the origin",
    "point circle": "point, rational quadratic circle",
    "point mp06": "point, MP06's curve",
    "point long": "point, space cubic of 100 spans",
    "batch cubic": "100,000 points, plane cubic",
    "batch mp06": "100,000 points, MP06's curve",
    "insertion mp06": "knot into MP06's curve",
    "insertion long": "knot into 100 spans",
    "msd mp06": "MSD of MP06's curve",
}


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--table", type=Path, help="also write the table to this file")
    parser.add_argument("--criterion", type=Path, required=True, help="criterion's folder in the target folder")
    parser.add_argument("--without-rust", action="store_true", help="take the Rust times of the run before")
    arguments = parser.parse_args()
    if not arguments.without_rust:
        subprocess.run(["cargo", "bench", "--bench", "engines"], cwd=HERE, check=True)
    columns = rust(arguments.criterion)
    environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    for command in ([sys.executable, HERE / "peers.py"], ["node", HERE / "peers.mjs"]):
        output = subprocess.run(command, check=True, env=environment, stdout=subprocess.PIPE, text=True).stdout
        for column, times in json.loads(output.splitlines()[-1]).items():
            columns.setdefault(column, {}).update(times)
    text = table(columns)
    print(text)
    if arguments.table:
        arguments.table.write_text(text + "\n", encoding="utf-8")


def rust(criterion):
    """The least times of criterion's samples, in seconds, of what is counted."""
    columns = {}
    for file in criterion.glob("*/*/new/sample.json"):
        benchmark = json.loads((file.parent / "benchmark.json").read_text())
        per = (benchmark.get("throughput") or {}).get("Elements", 1)
        samples = json.loads(file.read_text())
        least = min(time / count for time, count in zip(samples["times"], samples["iters"]))
        columns.setdefault(benchmark["group_id"], {})[benchmark["function_id"]] = least * 1e-9 / per
    return columns


def table(columns):
    """Engines down, operations across; the fastest of a column in bold."""
    engines = []
    for times in columns.values():
        engines += [engine for engine in times if engine not in engines]
    engines.sort(key=lambda engine: (not engine.startswith("knotproof"), engine))
    shown = [column for column in COLUMNS if column in columns]
    lines = ["| engine | " + " | ".join(COLUMNS[column] for column in shown) + " |", "| --- |" + " ---: |" * len(shown)]
    for engine in engines:
        cells = []
        for column in shown:
            time = columns[column].get(engine)
            text = "" if time is None else words(time)
            cells.append(f"**{text}**" if time == min(columns[column].values()) else text)
        lines.append(f"| {engine} | " + " | ".join(cells) + " |")
    return "\n".join(lines)


def words(seconds):
    for unit, size in (("s", 1.0), ("ms", 1e-3), ("µs", 1e-6)):
        if seconds >= size:
            return f"{seconds / size:.3g} {unit}"
    return f"{seconds * 1e9:.3g} ns"


main()
