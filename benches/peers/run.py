#!/usr/bin/env python3
"""Minimum separation distance: other tools on the curves of this repository, side by side with knotproof.

    run.py [CURVE...] [--generator PATH] [--knotproof PATH] [--limit SECONDS] [--peers NAMES] [--output FILE]

Each measurement runs in a process of its own, one after the other: one that fails, crashes or takes longer than the limit
becomes a remark in the table. The time is that of the search alone, from the exact pieces in the peer's own form to the list
of double normals: the median of up to five runs, of one when it takes more than five seconds.
"""

import argparse
import importlib
import importlib.metadata
import json
import os
import platform
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from decimal import Decimal, localcontext
from fractions import Fraction
from pathlib import Path

PEERS = {
    "numpy": ("numpy, vectorised Newton, 9×9 seeds", "numpy"),
    "scipy": ("scipy.optimize.root, 9×9 seeds", "scipy"),
    "occt": ("OCCT GeomAPI_ExtremaCurveCurve", "cadquery-ocp-novtk"),
    "codac": ("Codac, interval branch and bound", "codac"),
    "flint": ("python-flint, resultant and arb", "python-flint"),
}

HERE = Path(__file__).resolve().parent
CURVES = [HERE.parent.parent / "certs/curves" / f"{name}.json" for name in ("mp06-figure-1", "trefoil-24", "degree-8")]
GENERATED = [("closed-polygon", 200, 1), ("calpha", 2000, 1)]

# Shortest double normal and number of double normals, by elimination at 60 digits and by interval branch and bound.
KNOWN = {
    "mp06-figure-1": ("0.442675170376606599444313276103389848818803923854", 16),
    "trefoil-24": ("1.08104019152920999916790730541445728617376226712", 12),
    "degree-8": ("0.740919277985580490309213004908719582449494285", 3),
}
RUNS = 5
LONG = 5.0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("curves", nargs="*", type=Path, help="curve/1 files (default: three of the repository)")
    parser.add_argument("--generator", type=Path, help="the `generate` example: adds a closed and a C-alpha-like chain")
    parser.add_argument("--knotproof", type=Path, help="the knotproof binary, measured beside the peers")
    parser.add_argument("--limit", type=float, default=60.0, help="seconds for one run (default 60)")
    parser.add_argument("--peers", default=",".join(PEERS), help="which peers, in this order (default: all)")
    parser.add_argument("--output", type=Path, help="also write the tables to this file")
    parser.add_argument("--single", metavar="PEER", help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.limit <= 0:
        parser.error("--limit must be positive")
    if arguments.single:
        print(json.dumps(single(arguments.single, arguments.curves[0], arguments.limit)))
        return
    names = [name for name in arguments.peers.split(",") if name]
    unknown = [name for name in names if name not in PEERS]
    if unknown:
        parser.error(f"unknown peer {unknown[0]}, expected some of {','.join(PEERS)}")
    with tempfile.TemporaryDirectory(prefix="peers-") as directory:
        curves = list(arguments.curves or CURVES)
        if arguments.generator:
            curves += generated(arguments.generator, Path(directory))
        results = []
        for curve in curves:
            for name in names:
                results.append((curve.stem, PEERS[name][0], measured(name, curve, arguments.limit)))
                progress(*results[-1])
            if arguments.knotproof:
                for label, result in ours(arguments.knotproof, curve, Path(directory), arguments.limit):
                    results.append((curve.stem, label, result))
                    progress(*results[-1])
    text = report(results, names, arguments.limit)
    print(text)
    if arguments.output:
        arguments.output.write_text(text + "\n", encoding="utf-8")


def generated(generator, directory):
    """The generated chains, written to `directory`."""
    paths = []
    for kind, pieces, seed in GENERATED:
        path = directory / f"{kind}-{pieces}.json"
        subprocess.run([generator, kind, str(pieces), str(seed), path], check=True)
        paths.append(path)
    return paths


def single(name, path, limit):
    """One peer on one curve, in this process; the alarm ends the process when the first run takes too long."""
    import curve

    chain = curve.load(path)
    peer = importlib.import_module(f"peer_{name}")
    prepared = peer.prepare(chain)
    signal.signal(signal.SIGALRM, signal.SIG_DFL)
    signal.setitimer(signal.ITIMER_REAL, limit)
    times = []
    while len(times) < RUNS and sum(times) <= LONG:
        start = time.perf_counter()
        found = peer.find(chain, prepared)
        times.append(time.perf_counter() - start)
        signal.setitimer(signal.ITIMER_REAL, 0)
    distinct = found.distinct()
    sigma = distinct[0][0] if distinct else None
    if sigma is not None:
        sigma = repr(float(sigma)) if name != "flint" else sigma.str(30, radius=False)
    return {
        "seconds": statistics.median(times),
        "sigma": sigma,
        "normals": len(distinct),
        "note": "; ".join(filter(None, [getattr(found, "note", ""), f"pieces paired: {found.pairs}"])),
    }


def measured(name, path, limit):
    """The result of `single` in a process of its own, or a remark."""
    command = [sys.executable, str(HERE / "run.py"), str(path), "--single", name, "--limit", str(limit)]
    environment = dict(os.environ, OMP_NUM_THREADS="1", OPENBLAS_NUM_THREADS="1")
    process = subprocess.run(command, capture_output=True, text=True, env=environment, check=False)
    if process.returncode == -signal.SIGALRM:
        return {"note": f"more than {limit:g} s"}
    if process.returncode != 0:
        last = (process.stderr.strip().splitlines() or [f"ended with {process.returncode}"])[-1]
        return {"note": last.replace("|", "/")[:160], "failed": True}
    return json.loads(process.stdout.splitlines()[-1])


def ours(binary, path, directory, limit):
    """Rows for `certify msd` and `check`: time of the whole process, and what the tool says of itself."""
    certificate = directory / f"{path.stem}.cert"
    certificate.unlink(missing_ok=True)
    command = [str(binary), "certify", "msd", str(path), "--json", "-o", str(certificate)]
    certify = timed(command, limit)
    if "seconds" in certify and certify["code"] in (0, 3):
        try:
            said = json.loads(certify["output"])
            statement = said.get("statement", said)
            certify["sigma"] = square_root(statement.get("lower_squared"))
            certify["note"] += f"; {float(said['seconds']) * 1000:.3g} ms by its own clock"
            certificate.stat()
        except (ValueError, KeyError, AttributeError, TypeError, OSError) as error:
            # A time without the result it stands for would be worth nothing.
            certify = {"note": f"{certify['note']}, but no result: {error!r}".replace("|", "/")[:160], "failed": True}
    yield "knotproof certify msd (whole process)", certify
    if "seconds" in certify:
        check = timed([str(binary), "check", str(certificate)], limit)
        check["note"] += f"; certificate of {certificate.stat().st_size} bytes"
        yield "knotproof check (whole process)", check


def timed(command, limit):
    """Median time of a command, its exit code and output."""
    times = []
    while len(times) < RUNS and sum(times) <= LONG:
        start = time.perf_counter()
        try:
            process = subprocess.run(command, capture_output=True, text=True, timeout=limit, check=False)
        except subprocess.TimeoutExpired:
            return {"note": f"more than {limit:g} s"}
        except OSError as error:
            return {"note": str(error), "failed": True}
        times.append(time.perf_counter() - start)
        if process.returncode not in (0, 3):
            last = (process.stderr.strip().splitlines() or [""])[-1]
            return {"note": f"exit code {process.returncode}: {last}".replace("|", "/")[:160], "failed": True}
    return {
        "seconds": statistics.median(times),
        "code": process.returncode,
        "output": process.stdout,
        "note": f"exit code {process.returncode}",
    }


def square_root(square):
    """√ of an exact rational, 30 digits rounded towards 0, as a lower bound is; None when there is no number."""
    if square is None or square == "inf":
        return None
    value = Fraction(square)
    with localcontext() as context:
        context.prec = 60
        root = (Decimal(value.numerator) / Decimal(value.denominator)).sqrt()
        context.prec = 30
        context.rounding = "ROUND_FLOOR"
        return str(+root)


def agreement(sigma, reference):
    """How many significant digits two decimals share, as far as the shorter one goes."""
    a, b = Fraction(sigma), Fraction(reference)
    most = min(len(text.replace(".", "").lstrip("0")) for text in (sigma, reference))
    digits = 0
    while digits < most and abs(a - b) * 2 * 10 ** (digits + 1) <= 10 * abs(b):
        digits += 1
    return digits


def cell(result):
    """A time for the table."""
    if "seconds" not in result:
        return "failed" if result.get("failed") else "—"
    seconds = result["seconds"]
    return f"{seconds * 1000:.3g} ms" if seconds < 0.9995 else f"{seconds:.3g} s"


def progress(curve, label, result):
    """One line on standard error for each measurement."""
    print(f"{curve}: {label}: {cell(result)} ({result['note']})", file=sys.stderr, flush=True)


def report(results, names, limit):
    """Both tables and what they were measured with, in Markdown."""
    curves = list(dict.fromkeys(curve for curve, _, _ in results))
    labels = list(dict.fromkeys(label for _, label, _ in results))
    times = {(curve, label): cell(result) for curve, label, result in results}
    lines = ["| tool | " + " | ".join(curves) + " |", "| --- |" + " --- |" * len(curves)]
    for label in labels:
        lines.append(f"| {label} | " + " | ".join(times.get((curve, label), "") for curve in curves) + " |")
    references = {curve: known[0] for curve, known in KNOWN.items()}
    for curve, label, result in results:
        if label == PEERS["flint"][0] and result.get("sigma"):
            references.setdefault(curve, result["sigma"])
    lines += ["", "| curve | tool | time | σ | digits | double normals | remarks |", "| --- | --- | --- | --- | --- | --- | --- |"]
    for curve, label, result in results:
        sigma, digits = result.get("sigma"), ""
        if sigma and curve in references:
            digits = str(agreement(sigma, references[curve]))
        normals = str(result.get("normals", ""))
        if normals and curve in KNOWN:
            normals += f" of {KNOWN[curve][1]}"
        lines.append(f"| {curve} | {label} | {cell(result)} | {sigma or ''} | {digits} | {normals} | {result['note']} |")
    lines += [
        "",
        f"One run at most {limit:g} s (— beyond). Digits: significant digits that agree with the known value, on generated"
        " chains with the value found by elimination. On chains of more than 32 pieces the double normals counted are those"
        " of the pairs of pieces whose boxes are closer than σ.",
        "",
        f"{machine()}, {os.cpu_count()} cores, Python {platform.python_version()}, "
        + ", ".join(version(PEERS[name][1]) for name in names)
        + ".",
    ]
    return "\n".join(lines)


def version(distribution):
    """Name and version of an installed package."""
    try:
        return f"{distribution} {importlib.metadata.version(distribution)}"
    except importlib.metadata.PackageNotFoundError:
        return f"{distribution} not installed"


def machine():
    """The processor, as far as the system tells."""
    try:
        with open("/proc/cpuinfo", encoding="utf-8") as file:
            models = (line.split(":", 1)[1].strip() for line in file if line.startswith("model name"))
            return next(models, platform.machine())
    except OSError:
        return platform.machine()


if __name__ == "__main__":
    main()
