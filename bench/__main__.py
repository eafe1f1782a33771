"""Run every benchmark, print the tables, store each with machine, date and commit in bench/results.json."""

import argparse
import json
import subprocess
from datetime import date
from pathlib import Path

from solvers.jit.shortcuts import shorten
from solvers.provenance import machine

from . import (
    automatic,
    beams,
    compiling,
    cost,
    drawing,
    elements,
    ensemble,
    estimates,
    impulses,
    kernels,
    machines,
    map,
    mechanisms,
    methods,
    page,
    peer_mechanisms,
    peers,
    random_chains,
    regime_sweep,
    regimes,
    shipped,
    startup,
    studies,
    sweep,
    tradeoffs,
    transverse,
    visitors,
    waves,
)
from .size import small

PARTS = {
    "startup": startup,
    "kernels": kernels,
    "beams": beams,
    "transverse": transverse,
    "elements": elements,
    "ensemble": ensemble,
    "impulses": impulses,
    "mechanisms": mechanisms,
    "methods": methods,
    "cost": cost,
    "drawing": drawing,
    "sweep": sweep,
    "studies": studies,
    "regimes": regimes,
    "regime-sweep": regime_sweep,
    "tradeoffs": tradeoffs,
    "shipped": shipped,
    "automatic": automatic,
    "estimates": estimates,
    "waves": waves,
    "compiling": compiling,
    "machines": machines,
    "random": random_chains,
    "peers": peers,
    "peer-mechanisms": peer_mechanisms,
    "page": page,
    "map": map,
    "visitors": visitors,
}

IF_ASKED = (
    "compiling",
    "machines",
    "regime-sweep",
    "random",
    "estimates",
)  # a minute of all cores; half an hour of one, each
RESULTS = Path(__file__).parent / "results.json"


def _commit() -> str:
    """Of these sources, with a plus where they have changed since."""
    call = ["git", "describe", "--always", "--dirty=+", "--exclude=*"]
    done = subprocess.run(call, cwd=RESULTS.parent, capture_output=True, text=True, check=False)
    return done.stdout.strip() or "unknown"


def written(stored: dict[str, dict[str, object]]) -> str:
    """As JSON, a figure a line."""
    parts = []
    for part, figures in stored.items():
        lines = (f"  {json.dumps(name)}: {json.dumps(value)}" for name, value in figures.items())
        parts.append(f" {json.dumps(part)}: {{\n" + ",\n".join(lines) + "\n }")
    return "{\n" + ",\n".join(parts) + "\n}\n"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--only", choices=list(PARTS), help=f"one part; default: all but {', '.join(IF_ASKED)}")
    parser.add_argument("--small", action="store_true", help="little of each, to see that it runs; nothing is stored")
    asked = parser.parse_args()
    shorten()
    parts = [asked.only] if asked.only else [part for part in PARTS if part not in IF_ASKED]
    if asked.small:
        with small():
            for part in parts:
                print(f"\n== {part}")
                PARTS[part].measure()
        return
    stored = json.loads(RESULTS.read_text()) if RESULTS.exists() else {}
    where = machine() | {"date": str(date.today()), "commit": _commit()}
    print("Measured with:", ", ".join(f"{key} {value}" for key, value in where.items()))
    for part in parts:
        print(f"\n== {part}")
        measured = PARTS[part].measure()
        if measured is not None:  # else what it needs is not installed, and what was stored stays
            stored[part] = {"measured": where} | measured
        RESULTS.write_text(written(stored), encoding="utf-8")
    print(f"\nStored in {RESULTS.relative_to(Path.cwd()) if RESULTS.is_relative_to(Path.cwd()) else RESULTS}")


if __name__ == "__main__":
    main()
