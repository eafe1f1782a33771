"""The commands `impact ensemble` and `impact convergence`: how far to trust an impact."""

import json
from typing import Any

import solvers
from solvers import SceneError
from solvers.studies.convergence import Convergence, convergence
from solvers.studies.ensemble import Ensemble, ensemble

from .interrupts import interruptible
from .sweep import shown
from .words import family, named, text


def number(option: str, given: str, kind: type = float) -> Any:
    """The number that an option was given. Raises SceneError naming it."""
    try:
        return kind(given)
    except ValueError:
        raise SceneError(option, given, text("wanted.any-whole" if kind is int else "wanted.any-number")) from None


def print_ensemble(scene: solvers.Scene, runs: str, spread: str, key: str | None, seed: str, as_json: bool) -> int:
    """Print the spread of every figure as a table, or the whole ensemble in JSON."""
    counts = number("--runs", runs, int), number("--seed", seed, int)
    try:
        with interruptible() as interrupted:
            largest = number("--spread", spread)
            found = ensemble(scene, runs=counts[0], spread=largest, key=key, seed=counts[1], cancel=interrupted)
    except SceneError as refused:
        if interrupted():
            raise KeyboardInterrupt from None  # too few runs to show anything
        if refused.key in ("runs", "spread", "key", "seed"):
            raise SceneError(f"--{refused.key}", refused.value, refused.reason) from None
        raise
    print(json.dumps(found.table(), indent=1, allow_nan=False) if as_json else ensemble_table(scene, found))
    return 130 if interrupted() else 0


def ensemble_table(scene: solvers.Scene, found: Ensemble) -> str:
    columns = {"unperturbed": 14, "lowest": 14, "median": 14, "highest": 14, "half-range": 12, "sensitivity": 13}
    columns["amplified"] = 11
    heads = family("ensemble.head")
    head = "".join(f"{heads[name]:>{width}}" for name, width in columns.items())
    runs = {"runs": found.perturbations.size, "method": found.method["name"], "key": found.key}
    spread, seconds = 100.0 * float(abs(found.perturbations).max()), found.wall_time
    lines = [
        scene.title or text("report.scene"),
        "  " + text("ensemble.runs", spread=spread, seconds=seconds, **runs),
        "",
        f"  {'':24}{head}  {heads['verdict']}",
    ]
    for row in found.spread:
        name = named("quantity", row.quantity) + (f" [{row.unit}]" if row.unit else "")
        cells: list[Any] = [
            (row.unperturbed, 12, ".6g"), (row.lowest, 12, ".6g"), (row.median, 12, ".6g"), (row.highest, 12, ".6g"),
            (100.0 * row.half_range, 8, ".2g"), (row.sensitivity, 13, "+.3g"), (row.amplification, 9, ".2g"),
        ]  # fmt: skip
        values = "  ".join(shown(value, form).rjust(size) for value, size, form in cells[:4])
        rest = f"{shown(*cells[4][::2]):>8} %" + shown(*cells[5][::2]).rjust(13) + shown(*cells[6][::2]).rjust(11)
        lines.append(f"  {name:24}  {values}  {rest}  {row.verdict}")
    return "\n".join([*lines, "", str(found.summary), *(text("report.note", note=note) for note in found.notes)])


def print_convergence(scene: solvers.Scene, lists: dict[str, str | None], as_json: bool) -> int:
    """Print a column for each level, and what they show, or all of it in JSON; `lists` by option, as written."""
    named, _ = solvers.read_method(scene.method, scene)
    own = {"modes", "elements"} & set(named.table()) and lists["elements"] is None
    values: dict[str, Any] = {
        option: [
            number(f"--{option}", part, int if option in ("modes", "elements") else float)
            for part in written.split(",")
        ]
        for option, written in lists.items()
        if written is not None
    }
    try:
        found = convergence(scene, method=named if own else None, **values)
    except SceneError as refused:
        if refused.key in lists:
            raise SceneError(f"--{refused.key}", refused.value, refused.reason) from None
        raise
    print(json.dumps(found.table(), indent=1, allow_nan=False) if as_json else convergence_table(scene, found))
    return 0


def convergence_table(scene: solvers.Scene, found: Convergence) -> str:
    names = [named("quantity", name) + (f" [{unit}]" if unit else "") for name, unit in found.units.items()]
    width = max(map(len, names))
    by = text("convergence.by", method=found.method, seconds=found.wall_time)
    beside = found.reference_values or {}
    heads = [f"{count:>14g}" for count in found.counts] + ([f"{found.reference:>14}"] if found.reference else [])
    lines = [scene.title or text("report.scene"), f"  {by}", ""]
    lines.append(f"  {named('convergence.kind', found.kind):{width}}" + "".join(heads))
    for name, (key, values) in zip(names, found.values.items(), strict=True):
        known = [f"{beside[key]:>14.7g}" if key in beside else f"{'-':>14}"] if found.reference else []
        lines.append(f"  {name:{width}}" + "".join([*(f"{value:>14.7g}" for value in values), *known]))
    return "\n".join([*lines, "", *(f"  {told}" for told in found.table()["told"].values())])
