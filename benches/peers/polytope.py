"""Times peers on systems of half-spaces; see polytope.sh. CPU milliseconds of one thread, the least of some runs.

CGAL and PPL are timed inside their process, after the rows are read; lrs and cddlib as a whole process.
"""

import pathlib
import resource
import subprocess
import sys
import tempfile
import time

SECONDS = 120
RUNS = 3


def read(path):
    """Dimension and rows n1 … nD c; the second line is a point of the interior."""
    lines = path.read_text().splitlines()
    dimension, count = map(int, lines[0].split())
    rows = [list(map(int, line.split())) for line in lines[2:]]
    assert len(rows) == count
    return dimension, rows


def least(run):
    """The least time of some runs, of one when it is long, and what the run gave; None when it fails."""
    best, result = None, None
    for _ in range(RUNS):
        found = run()
        if found is None:
            return best, result
        seconds, result = found
        best = seconds if best is None else min(best, seconds)
        if best > 2:
            break
    return best, result


def process(command, folder):
    """CPU seconds of a process and its standard output; None when it is missing, fails or takes too long."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=SECONDS, check=True)
    except (OSError, subprocess.SubprocessError):
        return None
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, done.stdout


def h_representation(path, dimension, rows):
    text = ["H-representation", "begin", f"{len(rows)} {dimension + 1} integer"]
    text += [" ".join(map(str, [row[-1], *row[:-1]])) for row in rows]
    path.write_text("\n".join([*text, "end", ""]))


def lrs(_path, dimension, rows):
    with tempfile.TemporaryDirectory() as folder:
        h_representation(pathlib.Path(folder, "system.ine"), dimension, rows)
        seconds, output = least(lambda: process(["lrs", "system.ine"], folder))
    if seconds is None:
        return None
    total = next(line for line in output.splitlines() if line.startswith("*Totals"))
    return seconds, int(total.split("vertices=")[1].split()[0])


def cddlib(_path, dimension, rows):
    with tempfile.TemporaryDirectory() as folder:
        h_representation(pathlib.Path(folder, "system.ine"), dimension, rows)
        seconds, _ = least(lambda: process(["scdd_gmp", "system.ine"], folder))
        if seconds is None:
            return None
        output = next(pathlib.Path(folder).glob("*.ext")).read_text()
    lines = output.split("begin")[1].split("end")[0].split("\n")[2:]
    return seconds, sum(line.split()[:1] == ["1"] for line in lines)


def ppl(_path, dimension, rows):
    try:
        from ppl import C_Polyhedron, Constraint_System, Variable
    except ImportError:
        return None
    variables = [Variable(i) for i in range(dimension)]
    system = Constraint_System()
    for row in rows:
        system.insert(sum(n * x for n, x in zip(row, variables)) + row[-1] >= 0)

    def run():
        start = time.process_time()
        generators = C_Polyhedron(system).minimized_generators()
        return time.process_time() - start, len(generators)

    return least(run)


def cgal(path, _dimension, _rows, column):
    found = process([path.parent / "polytope_cgal", path, str(RUNS)], path.parent)
    if found is None:
        return None
    numbers = found[1].split()
    return float(numbers[column]), int(numbers[0])


PEERS = {
    "CGAL, polytope alone": lambda *case: cgal(*case, 2),
    "CGAL, with exact measure": lambda *case: cgal(*case, 3),
    "PPL": ppl,
    "lrs": lrs,
    "cddlib": cddlib,
}


def main():
    folder = pathlib.Path(sys.argv[1])
    print("| system | rows | vertices | facets | knotproof, with enclosed measure |", " | ".join(PEERS), "|")
    print("| --- " * (5 + len(PEERS)) + "|")
    for line in (folder / "knotproof.tsv").read_text().splitlines():
        name, count, vertices, facets, own = line.split("\t")
        path = folder / f"{name}.rows"
        dimension, rows = read(path)
        cells = [name, count, vertices, facets, f"{float(own) * 1000:.2f}"]
        for peer in PEERS.values():
            found = peer(path, dimension, rows)
            if found is None:
                cells.append("—")
            else:
                remark = "" if found[1] == int(vertices) else f" ({found[1]} vertices)"
                cells.append(f"{found[0] * 1000:.3g}{remark}" if found[0] < 1 else f"{found[0] * 1000:.0f}{remark}")
        print("|", " | ".join(cells), "|", flush=True)


main()
