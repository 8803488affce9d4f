"""One peer on one curve, as `knotproof compare --peers` runs it: a JSON object on standard output.

The program puts three names before this text: SOURCES (the texts of the modules `curve`, `pairs` and `peer_…` by name), PEER and
CURVE (the text of a curve file). Bounds are exact: fractions, "inf", or none.
"""

import sys

# The working directory holds curves, not modules of this script.
sys.path = [place for place in sys.path if place]

import importlib.metadata
import json
import time
import types
from fractions import Fraction
from math import inf

DISTRIBUTIONS = {"codac": "codac", "flint": "python-flint"}


def main():
    try:
        modules = {name: module(name, text) for name, text in SOURCES.items()}
    except ImportError as error:
        return {"missing": error.name or str(error)}
    try:
        chain = modules["curve"].read(CURVE, "the curve")
    except ValueError as error:
        return {"refused": str(error)}
    peer = modules["peer_" + PEER]
    prepared = peer.prepare(chain)
    start = time.perf_counter()
    found = peer.find(chain, prepared)
    return {
        "seconds": time.perf_counter() - start,
        "lower": number(found.lower),
        "upper": None if found.upper == inf else number(found.upper),
        "normals": len(found.distinct()),
        "version": importlib.metadata.version(DISTRIBUTIONS[PEER]),
        "note": getattr(found, "note", ""),
    }


def module(name, text):
    made = types.ModuleType(name)
    sys.modules[name] = made
    exec(compile(text, name + ".py", "exec"), made.__dict__)
    return made


def number(value):
    return "inf" if value == inf else str(Fraction(value))


print(json.dumps(main()))
