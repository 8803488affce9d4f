#!/usr/bin/env python3
"""Second, independent checker of knotproof certificates (`certificate/1`): command line and document.

Written from docs/FORMAT.md alone; Python 3.11 or newer, standard library only.  The section numbers (§) in the
comments of all modules are those of FORMAT.md.  All arithmetic is exact.
"""

import argparse
import hashlib
import json
import os
import re
import sys

import curvature
import deviation
import domain
import embedding
import motion
import msd
import thickness
import values
from curve import curve_block, read_chain
from document import BinaryReader, Reject, anything, expect, natural, parse_json, record, text, variant

# modules with STATEMENT, evidence_of, check and sentence
CLAIMS = {"msd": msd, "domain": domain, "embedding": embedding, "curvature": curvature,
          "thickness": thickness, "deviation": deviation, "motion": motion, "values": values}
MAX_HEADER = 16_777_216
MAX_JSON_BYTES = (1 << 30) - 1
MAGIC = b"KNOTCRT1"
HASH = re.compile(r"[0-9a-f]{64}")

DOCUMENT = record({"knotproof": text("certificate/1"), "tool": text(), "curve": anything, "curve_sha256": text(),
                   "statement": variant("claim", {name: claim.STATEMENT for name, claim in CLAIMS.items()}),
                   "evidence": anything}, {"name": text(), "snapped_joints": natural(0)})


def read_document(data):
    """The JSON document, and the reader of what follows it (None in the JSON form); see §7."""
    if data[:8] != MAGIC:
        expect(len(data) <= MAX_JSON_BYTES, "certificate", f"at most {MAX_JSON_BYTES} bytes of JSON", len(data))
        return parse_json(data, "certificate"), None
    reader = BinaryReader(data)
    reader.take(8, "magic")
    length = int.from_bytes(reader.take(4, "header length"), "little")
    expect(length <= MAX_HEADER, "header", f"at most {MAX_HEADER} bytes", length)
    return parse_json(reader.take(length, "header"), "header"), reader


def check_certificate(data, wanted_hash=None):
    """The statement of an accepted certificate, with its `curve_sha256` and the claim's figures; else raises Reject."""
    document, binary = read_document(data)
    found = DOCUMENT(document, "certificate")
    statement, claim = found["statement"], CLAIMS[found["statement"]["claim"]]
    evidence = claim.evidence_of(statement)(found["evidence"], "evidence")

    if binary is None:
        block = BinaryReader(curve_block(found["curve"]))
    else:
        text("binary")(found["curve"], "curve")
        block = binary
    chain = read_chain(block)
    found_hash = hashlib.sha256(chain.block).hexdigest()
    stated_hash = found["curve_sha256"]
    expect(HASH.fullmatch(stated_hash), "curve_sha256", "64 lower-case hexadecimal digits", stated_hash)
    expect(stated_hash == found_hash, "curve_sha256", found_hash, stated_hash)
    expect(wanted_hash in (None, found_hash), "the certificate is about another curve", wanted_hash, found_hash)

    figures = claim.check(chain, statement, evidence, binary)
    expect(block.left() == 0, f"byte {block.at}", "no bytes left over", block.left())
    return {**document["statement"], "curve_sha256": found_hash, **figures}


# ---------------------------------------------------------------- command line


def examine(path, wanted_hash):
    """Verdict and the fields of the report for one file."""
    try:
        with open(path, "rb") as stream:
            size = os.fstat(stream.fileno()).st_size
            if stream.peek(8)[:8] != MAGIC:
                expect(size <= MAX_JSON_BYTES, "certificate", f"at most {MAX_JSON_BYTES} bytes of JSON", size)
            data = stream.read()
        return "accepted", {"statement": check_certificate(data, wanted_hash)}
    except OSError as error:
        return "unreadable", {"reason": str(error)}
    except Reject as error:
        return "rejected", {"reason": str(error)}
    except (MemoryError, RecursionError, OverflowError) as error:
        return "rejected", {"reason": f"the limits of this machine do not suffice: {error!r}"}


def main(arguments=None):
    parser = argparse.ArgumentParser(description="Check knotproof certificates (JSON or binary form).",
                                     epilog="Exit code: 0 all accepted, 1 any rejected, 2 unreadable file or usage.",
                                     allow_abbrev=False)
    parser.add_argument("files", nargs="+", metavar="CERT")
    parser.add_argument("--curve-sha256", metavar="HEX", help="the curve it must be about")
    parser.add_argument("--json", action="store_true", help="print one JSON object for each file")
    parser.add_argument("--quiet", action="store_true", help="print nothing; the exit code tells")
    options = parser.parse_args(arguments)
    if options.curve_sha256 is not None and not HASH.fullmatch(options.curve_sha256):
        parser.error("--curve-sha256: expected 64 lower-case hexadecimal digits")
    if hasattr(sys.stdout, "reconfigure"):
        sys.stdout.reconfigure(encoding="utf-8", errors="backslashreplace")
    verdicts = set()
    for path in options.files:
        verdict, report = examine(path, options.curve_sha256)
        verdicts.add(verdict)
        if options.json and not options.quiet:
            print(json.dumps({"file": path, "verdict": verdict, **report}))
        elif not options.quiet:
            statement = report.get("statement")
            words = CLAIMS[statement["claim"]].sentence(statement) if statement else report["reason"]
            print(f"{verdict}: {path}: {words}")
    return 1 if "rejected" in verdicts else 2 if "unreadable" in verdicts else 0


if __name__ == "__main__":
    sys.exit(main())
