"""Trade-offs of a few shipped scenes, stored with the library. To renew: python -m bench --only tradeoffs"""

import json

import solvers
from solvers.stored_tables import SHIPPED, scene_key

from .timing import row

SCENES = (
    "fixed-rod",
    "free-rod",
    "bronze-rod-steel-ball",
    "sphere-on-half-space",
    "two-equal-rods",
    "hammer-on-cantilever",
)


def measure() -> dict[str, object]:
    SHIPPED.mkdir(exist_ok=True)
    kept, found = set(), []
    for name in SCENES:
        scene = solvers.load(name)
        seen: list[float] = []
        table = solvers.tradeoff(scene, fresh=True, progress=lambda known, seen=seen: seen.append(known.seconds))
        path = SHIPPED / f"{scene_key(scene)}.json"
        path.write_text(json.dumps(table.table(), allow_nan=False) + "\n", encoding="utf-8")
        kept.add(path)
        found += [
            row(f"{name}: first point", seen[0], "s", "<= 1"),
            row(f"{name}: all {len(table.points)} points", table.seconds, "s", "<= 20"),
        ]
        for quantity in ("rebound", "peak-force"):
            best = [f"{point.label} ({1e3 * point.wall_time:.2g} ms)" for point in table.front(quantity)]
            print(f"    best for {quantity}: {', '.join(best)}")
    for path in set(SHIPPED.glob("*.json")) - kept:
        path.unlink()
    return dict(found)
