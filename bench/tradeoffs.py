"""Trade-offs of the shipped scenes, stored with the library: one for each impact, however many scenes show it.

All whose code has changed since:      make tables, or python -m bench --only tradeoffs
Of some scenes, whatever is stored:    python -m bench.tradeoffs NAME ...
Stopped half-way it goes on where it was. Times are of a processor, beside those of a calibration on the same machine:
tables from several machines go together.
"""

import argparse
import json
import tempfile
import time
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from statistics import median

import solvers
from solvers.accuracy.measured_code import changed
from solvers.accuracy.refinement import ladders, refusals
from solvers.accuracy.store import SHIPPED, pack, scene_key
from solvers.accuracy.three_solves import Times, measured

from .size import of
from .timing import row

SECONDS = 12.0  # of one scene, compiled
CALIBRATION_SECONDS = 0.3  # before and after each scene


def measure() -> dict[str, object]:
    """All tables that are out of date; of a small run one, which is not kept."""
    with tempfile.TemporaryDirectory() as elsewhere:
        return renew(*of(((), SHIPPED), (("fixed-rod",), Path(elsewhere))))


def renew(names: Sequence[str], folder: Path) -> dict[str, object]:
    """Every impact whose table is out of date, or those of the scenes named; what is stored of no scene any more is
    deleted.
    """
    folder.mkdir(exist_ok=True)
    impacts = impacts_of(names or solvers.scene_names())
    wanted, kept = [], set()
    for scene, called in impacts.values():
        path = folder / f"{scene_key(scene)}.json"
        if not ladders(scene):
            reasons = "; ".join(f"'{name}': {reason}" for name, reason in refusals(scene).items())
            print(f"  {called[0]}: left out, as no method can solve it ({reasons})")
            continue
        kept.add(path)
        if names or outdated(path, scene):
            wanted.append((scene, called, path))
    begun = time.monotonic()
    firsts = []
    for place, one in enumerate(wanted):
        firsts.append(_store(*one, f"{place + 1} of {len(wanted)}, {time.monotonic() - begun:.0f} s"))
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


def outdated(path: Path, scene: solvers.Scene) -> list[str]:
    """What of the code has changed since this table was measured, and methods that solve the scene now but did not, or
    no longer; "table", if there is none. Whatever machine it was measured on.
    """
    try:
        table = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return ["table"]
    own = {ladder.levels[0].NAME for ladder in ladders(scene)}
    known = {name for name in table.get("code") or () if name in solvers.METHODS}
    return sorted({*changed(table.get("code")), *(own ^ known)})


def _calibrated(*others: Times) -> Times:
    """The shortest of now and of others."""
    now = measured(CALIBRATION_SECONDS)
    return {kind: min(each[kind] for each in (now, *others)) for kind in now}


def _store(scene: solvers.Scene, called: Sequence[str], path: Path, progress: str) -> float:
    """Measure and write; time to the first point [s]."""
    for ladder in ladders(scene):
        ladder.levels[0].solve(scene)  # compiled
    seen: list[float] = []
    before = _calibrated()
    table = solvers.tradeoff(
        scene, fresh=True, seconds=of(SECONDS, 0.3), progress=lambda known: seen.append(known.seconds)
    )
    table = replace(table, calibration=_calibrated(before))
    text = json.dumps(pack(table.table()), allow_nan=False, separators=(",", ":")) + "\n"
    beside = path.with_suffix(".part")
    beside.write_text(text, encoding="utf-8")
    beside.replace(path)
    shared = f" and {len(called) - 1} more" if len(called) > 1 else ""
    print(f"  {progress}: {called[0]}{shared}: first point {seen[0]:.2g} s, {len(table.points)} points"
          f" {table.seconds:.3g} s, {len(text) / 1e3:.3g} kB, {table.reference.kind}", flush=True)  # fmt: skip
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
    parser.add_argument("names", nargs="*", metavar="NAME", help="built-in scenes; default: all out of date")
    parser.add_argument("--into", type=Path, default=SHIPPED, metavar="FOLDER", help="instead of the library's own")
    options = parser.parse_args()
    renew(options.names, options.into)
