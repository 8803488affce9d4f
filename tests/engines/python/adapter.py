"""What all adapters share: reads cases.json, lets an engine answer them, writes results.json.

The engine runs in a child process, so that a crash or an endless loop costs one case: it counts as refused.
"""

import json
import math
import os
import select
import signal
import sys
import warnings

SECONDS = 5


class NotOffered(Exception):
    """The engine has no such operation."""


def numbers(values):
    """Numbers as JSON has them; others by their names."""
    return [number(value) for value in values]


def number(value):
    value = float(value)
    if math.isfinite(value):
        return value
    return "NaN" if math.isnan(value) else "Infinity" if value > 0 else "-Infinity"


def curve(degree, knots, points, weights=None):
    """A curve as results have it."""
    made = {"degree": int(degree), "knots": numbers(knots), "points": [numbers(point) for point in points]}
    if weights is not None:
        made["weights"] = numbers(weights)
    return made


def domain(asked):
    return asked["knots"][asked["degree"]], asked["knots"][-asked["degree"] - 1]


def is_bezier(asked):
    order = asked["degree"] + 1
    return len(asked["points"]) == order and asked["knots"] == [0] * order + [1] * order


def polynomial(asked):
    """The curve, for engines that have no weights."""
    if "weights" in asked:
        raise NotOffered
    return asked


def answer(engine, case):
    result = {"id": case["id"]}
    operation = getattr(engine, case["operation"], None)
    try:
        if operation is None:
            raise NotOffered
        result |= operation(case["curve"], case)
        result["status"] = "ok"
    except NotOffered:
        result["status"] = "not_offered"
    except Exception as error:  # whatever the engine raises is a refusal
        result = {"id": case["id"], "status": "refused", "message": f"{type(error).__name__}: {error}"[:200]}
    return result


def start(engine, cases):
    """A child that writes one line for each case; its id and the end of the pipe to read from."""
    reading, writing = os.pipe()
    child = os.fork()
    if child:
        os.close(writing)
        return child, reading
    os.close(reading)
    with os.fdopen(writing, "w") as pipe:
        for case in cases:
            pipe.write(json.dumps(answer(engine, case), allow_nan=False) + "\n")
            pipe.flush()
    os._exit(0)


def run(engine, cases):
    results = []
    while len(results) < len(cases):
        child, pipe = start(engine, cases[len(results):])
        buffer, why = b"", None
        while why is None and len(results) < len(cases):
            if not select.select([pipe], [], [], SECONDS)[0]:
                os.kill(child, signal.SIGKILL)
                why = f"no answer within {SECONDS} s"
                break
            read = os.read(pipe, 1 << 16)
            *lines, buffer = (buffer + read).split(b"\n")
            results += [json.loads(line) for line in lines]
            if not read:
                why = "the process ended"
        os.close(pipe)
        status = os.waitpid(child, 0)[1]
        if why and len(results) < len(cases):
            if os.WIFSIGNALED(status) and why == "the process ended":
                why += f" by signal {os.WTERMSIG(status)}"
            results.append({"id": cases[len(results)]["id"], "status": "refused", "message": why})
    return results


def main(name, engine):
    warnings.simplefilter("ignore")
    asked, written = sys.argv[1:]
    with open(asked) as file:
        cases = json.load(file)["cases"]
    results = {"knotproof": "results/1", "engine": name, "results": run(engine, cases)}
    with open(written, "w") as file:
        json.dump(results, file, allow_nan=False)
