"""Stored tables that were measured with other code than today's, measured anew: make tables

The constants of cost, the trade-offs of the shipped scenes and the map of regimes: minutes, as each part says while it
is measured. Stopped half-way it goes on where it was. python -m bench.tables --check only lists what is out of date.
"""

import argparse
import json
import re
import sys
import tomllib
from pathlib import Path

import solvers
from solvers.accuracy.cost_model import stored_costs
from solvers.accuracy.measured_code import changed
from solvers.accuracy.refinement import ladders
from solvers.accuracy.store import SHIPPED, scene_key
from solvers.regimes.tables import how_measured

from . import automatic, measure_regimes, tradeoffs

ROOT = Path(__file__).parents[1]


def stale() -> dict[str, list[str]]:
    """By table: what of its code has changed since it was measured, or that there is none."""
    found = {"costs.json": changed(stored_costs().get("code"))}
    for scene, called in tradeoffs.impacts_of(solvers.scene_names()).values():
        if ladders(scene):
            found[f"tradeoffs: {called[0]}"] = tradeoffs.outdated(SHIPPED / f"{scene_key(scene)}.json", scene)
    found["regimes.npz"] = changed(json.loads(how_measured()).get("code"))
    return {table: reasons for table, reasons in found.items() if reasons}


def releases(changelog: str, version: str) -> bool:
    """Whether these sources are a release: nothing is *Unreleased*, and the newest entry is that of their version."""
    parts = re.split(r"^## +(.*)$", changelog, flags=re.MULTILINE)[1:]
    entries = list(zip(parts[::2], parts[1::2], strict=True))
    if entries and entries[0][0].strip() == "Unreleased":
        (_, unreleased), *entries = entries
        if unreleased.strip():
            return False
    return bool(entries) and entries[0][0].split()[0] == version


def is_a_release() -> bool:
    """Whether the sources here are one."""
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    return releases((ROOT / "CHANGELOG.md").read_text(encoding="utf-8"), project["version"])


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--check", action="store_true", help="only list them; exit code 1 if there are any")
    only_check = parser.parse_args().check
    found = stale()
    for table, reasons in found.items():
        print(f"{table}: out of date ({', '.join(reasons)})")
    if only_check or not found:
        print(f"{len(found)} tables out of date" if found else "All tables are up to date.")
        return 1 if found else 0
    if "costs.json" in found:
        automatic.fit_costs()
    if any(table.startswith("tradeoffs") for table in found):
        tradeoffs.measure()
    if "regimes.npz" in found:
        measure_regimes.store()
    return 0


if __name__ == "__main__":
    sys.exit(main())
