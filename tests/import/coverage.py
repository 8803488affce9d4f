"""Certifies embedding and msd of every subpath of the files that fetch.sh fetched, and tabulates what came out."""

import collections
import concurrent.futures
import json
import pathlib
import subprocess
import sys
import tempfile
import time

PROGRAM, PARALLEL, EVERY = sys.argv[1], int(sys.argv[2]), int(sys.argv[3])
REAL = pathlib.Path("tests/import/real")
WIDTH = "1e-9"
SECONDS = 60
ICONS = 150
GLYPHS = 200


def run(*arguments):
    """The exit code and the JSON of one run; code -1 when it takes too long."""
    try:
        done = subprocess.run([PROGRAM, *arguments, "--json"], capture_output=True, text=True, timeout=SECONDS)
    except subprocess.TimeoutExpired:
        return -1, {"reason": f"more than {SECONDS} s"}
    if done.returncode == 2:
        return 2, {"reason": done.stderr.strip()}
    return done.returncode, json.loads(done.stdout)


def certify(curve):
    """What came of one curve: (certified?, how, reasons, seconds)."""
    start = time.time()
    path = curve["file"]
    code, found = run("certify", "embedding", path)
    embedding = {0: "embedded", 1: "meets itself"}.get(code)
    if code == 1:
        # The certificate of a crossing says σ = 0 too.
        return True, embedding, [], time.time() - start
    reasons = [] if embedding else [f"embedding: {found.get('reason', code)}"]
    code, found = run("certify", "msd", path, "--convention", "critical", "--rel-width", WIDTH, "--threads", "1")
    if code != 0:
        reasons.append(f"msd: {found.get('reason', code)}")
    return not reasons, embedding or "undecided", reasons, time.time() - start


def curves(files, folder, names=None):
    """All curves of the files, each written to a file of its own."""
    for k, file in enumerate(files):
        target = pathlib.Path(folder) / str(k)
        target.mkdir()
        select = [argument for name in names or [] for argument in ("--select", name)]
        code, found = run("import", str(file), "-o", str(target), *select)
        if code != 0:
            yield {"name": f"{file.name}", "file": None, "error": found["reason"]}
            continue
        for curve in found["curves"]:
            yield {**curve, "name": f"{file.name} {curve['name']}"}


def glyphs(font):
    """The names of the first glyphs with an outline."""
    _, found = run("import", str(font))
    names = list(dict.fromkeys(curve["name"].rpartition("/")[0] for curve in found["curves"]))
    return [name for name in names if name != ".notdef"][:GLYPHS]


def main():
    feather = sorted((REAL / "feather/dist/icons").glob("*.svg"))
    simple = sorted((REAL / "simple-icons/icons").glob("*.svg"))
    simple = simple[:: len(simple) // ICONS][:ICONS]
    font = REAL / "font/DejaVuSans.ttf"
    sets = [("feather-icons", feather, None), (f"{ICONS} simple-icons", simple, None)]
    sets.append((f"{GLYPHS} glyphs of DejaVu Sans", [font], glyphs(font)))
    if EVERY > 1:
        thin = lambda title, files, names: (f"{title}, every {EVERY}th", files if names else files[::EVERY], names and names[::EVERY])
        sets = [thin(*each) for each in sets]
    rows, remaining = [], []
    totals = collections.Counter()
    for title, files, names in sets:
        with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(PARALLEL) as pool:
            start = time.time()
            found = list(curves(files, folder, names))
            refused = [curve for curve in found if curve["file"] is None]
            found = [curve for curve in found if curve["file"] is not None]
            counts = collections.Counter()
            for curve, (certified, how, reasons, _) in zip(found, pool.map(certify, found)):
                counts["certified"] += certified
                counts[how] += 1
                if not certified:
                    remaining.append((title, curve["name"], "; ".join(reasons)))
            remaining += [(title, curve["name"], "not read: " + curve["error"]) for curve in refused]
            counts["subpaths"] = len(found) + len(refused)
            counts["seconds"] = round(time.time() - start)
            totals += counts
            rows.append((title, counts))
            print(f"{title}: done in {counts['seconds']} s", file=sys.stderr)
    rows.append(("all", totals))
    print("| files | subpaths | certified | share | embedded | meets itself | seconds |")
    print("| --- | ---: | ---: | ---: | ---: | ---: | ---: |")
    for title, counts in rows:
        share = 100 * counts["certified"] / max(1, counts["subpaths"])
        columns = [counts["subpaths"], counts["certified"], f"{share:.1f} %", counts["embedded"], counts["meets itself"]]
        print(f"| {title} | " + " | ".join(map(str, columns)) + f" | {counts['seconds']} |")
    print()
    for title, name, reason in remaining:
        print(f"- {title}: {name}: {reason}")


main()
