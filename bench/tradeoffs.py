"""Trade-offs of the shipped scenes, stored with the library: one for each impact, however many scenes show it.

All that are not stored yet for this machine and state of the library:  python -m bench --only tradeoffs
Of some scenes, whatever is stored:                                      python -m bench.tradeoffs NAME ...
Stopped half-way it goes on where it was. On a machine that does nothing else, as these are wall times.
"""

import argparse
import json
from collections.abc import Sequence
from pathlib import Path
from statistics import median

import solvers
from solvers.accuracy.refinement import ladders, refusals
from solvers.accuracy.store import SHIPPED, pack, scene_key
from solvers.provenance import machine, version

from .timing import row

SECONDS = 12.0  # of one scene, compiled


def measure(names: Sequence[str] = (), folder: Path = SHIPPED) -> dict[str, object]:
    """Every impact not stored yet, or those of the scenes named; what is stored of no scene any more is deleted."""
    folder.mkdir(exist_ok=True)
    impacts = impacts_of(names or solvers.scene_names())
    firsts, kept = [], set()
    for scene, called in impacts.values():
        path = folder / f"{scene_key(scene)}.json"
        if not ladders(scene):
            reasons = "; ".join(f"'{name}': {reason}" for name, reason in refusals(scene).items())
            print(f"  {called[0]}: left out, as no method can solve it ({reasons})")
            continue
        kept.add(path)
        if names or not already_stored(path):
            firsts.append(_store(scene, called, path))
    if not names:
        for path in set(folder.glob("*.json")) - kept:
            path.unlink()
    return _figures(sorted(kept), sum(len(called) for _, called in impacts.values()), firsts)


def impacts_of(names: Sequence[str]) -> dict[str, tuple[solvers.Scene, list[str]]]:
    """By key, one scene of all in which the same happens, and their names."""
    found: dict[str, tuple[solvers.Scene, list[str]]] = {}
    for name in names:
        scene = solvers.load(name)
        found.setdefault(scene_key(scene), (scene, []))[1].append(name)
    return found


def already_stored(path: Path) -> bool:
    """Whether this table has been measured on this machine and with these sources."""
    try:
        table = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return False
    return (table["machine"], table["version"]) == (machine(), version())


def _store(scene: solvers.Scene, called: Sequence[str], path: Path) -> float:
    """Measure and write; time to the first point [s]."""
    for ladder in ladders(scene):
        ladder.levels[0].solve(scene)  # compiled
    seen: list[float] = []
    table = solvers.tradeoff(scene, fresh=True, seconds=SECONDS, progress=lambda known: seen.append(known.seconds))
    text = json.dumps(pack(table.table()), allow_nan=False, separators=(",", ":")) + "\n"
    beside = path.with_suffix(".part")
    beside.write_text(text, encoding="utf-8")
    beside.replace(path)
    shared = f" and {len(called) - 1} more" if len(called) > 1 else ""
    print(f"  {called[0]}{shared}: first point {seen[0]:.2g} s, {len(table.points)} points {table.seconds:.3g} s,"
          f" {len(text) / 1e3:.3g} kB, {table.reference.kind}", flush=True)  # fmt: skip
    return seen[0]


def _figures(paths: Sequence[Path], scenes: int, firsts: Sequence[float]) -> dict[str, object]:
    tables = [json.loads(path.read_text(encoding="utf-8")) for path in paths]
    seconds = [table["seconds"] for table in tables]
    size = sum(path.stat().st_size for path in paths) / 1e6
    found = [
        row("scenes", scenes, ""),
        row("tables, one for all scenes in which the same happens", len(tables), ""),
        row("all points of one: median", median(seconds), "s"),
        row("all points of one: longest", max(seconds), "s", "<= 20"),
        row("all tables on disk", size, "MB", "<= 1"),
    ]
    if firsts:
        found.insert(2, row("first point of one: longest of those measured now", max(firsts), "s", "<= 1"))
    return dict(found)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", nargs="*", metavar="NAME", help="built-in scenes; default: all not stored yet")
    parser.add_argument("--into", type=Path, default=SHIPPED, metavar="FOLDER", help="instead of the library's own")
    options = parser.parse_args()
    measure(options.names, options.into)
