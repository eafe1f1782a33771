"""A study in a few lines: how far its figures reach and where, what was refused, and what is to be known."""

import json
from collections.abc import Callable, Iterable, Mapping
from typing import Any

import numpy as np

from .words import listed, shown, text

WORDS = ("refused", "reason", "notes")
NOT_SOLVED = "not-solved"


def summary(found: Any) -> dict[str, Any]:
    """Of a Dataset of `solvers.study`, as plain tables: numbers of points; refusals and notes by code; the lowest and
    the highest value of each figure, with the values of the keys there."""
    refused = found.refused.values.ravel()
    codes, first, counts = np.unique(refused.astype(str), return_index=True, return_counts=True)
    by_code = {code: (int(where), int(count)) for code, where, count in zip(codes, first, counts, strict=True)}
    solved = by_code.pop("", (0, 0))[1]
    waiting = by_code.pop(NOT_SOLVED, (0, 0))[1]
    reasons = found.reason.values.ravel()
    notes: dict[str, int] = {}
    for said in found.notes.values.ravel().tolist():
        for code in said.split():
            notes[code] = notes.get(code, 0) + 1
    return {
        "points": refused.size,
        "solved": solved,
        "refused": refused.size - solved - waiting,
        "waiting": waiting,
        "figures": reaches(
            ((str(name), each.attrs.get("units", ""), each.values.ravel()) for name, each in found.data_vars.items()),
            lambda where: _at(found, where),
        ),
        "refusals": [
            {"code": code, "points": count, "at": _at(found, where), "reason": str(reasons[where])}
            for code, (where, count) in sorted(by_code.items(), key=lambda each: -each[1][1])
        ],
        "notes": dict(sorted(notes.items(), key=lambda each: -each[1])),
        "sentences": json.loads(
            found.attrs.get("sentences", "{}")
        ),  # by code, the sentence of the first point that has it
    }


def reaches(columns: Iterable[tuple[str, str, np.ndarray]], at: Callable[[int], Mapping[str, Any]]) -> dict[str, Any]:
    """Of columns as name, unit and values, without those that have none: the lowest and the highest value, and `at`
    what they are."""
    found: dict[str, Any] = {}
    for name, unit, values in columns:
        if name not in WORDS and not np.isnan(values).all():
            ends = {"lowest": int(np.nanargmin(values)), "highest": int(np.nanargmax(values))}
            reach = {end: {"value": float(values[where]), "at": at(where)} for end, where in ends.items()}
            found[name] = {"unit": unit} | reach
    return found


def _at(found: Any, point: int) -> dict[str, Any]:
    """The values of all keys at a point."""
    sizes = found.refused.shape
    places = dict(zip(found.refused.dims, np.unravel_index(point, sizes), strict=True))
    return {
        str(key): np.asarray(array.values[places[array.dims[0]]]).item()
        for key, array in found.coords.items()
        if key != "point"
    }


def rows(found: Any) -> list[dict[str, Any]]:
    """A table for each point: its keys, its figures (None where there is none), and words."""
    columns = {name: array.values.ravel() for name, array in found.data_vars.items()}
    return [
        _at(found, point) | {str(name): _plain(values[point]) for name, values in columns.items()}
        for point in range(found.refused.size)
    ]


def _plain(value: Any) -> Any:
    value = np.asarray(value).item()
    return None if isinstance(value, float) and not np.isfinite(value) else value


def lines(found: Any, known: dict[str, Any]) -> str:
    """What `summary` knows, to read."""
    sizes = " x ".join(f"{name} {size}" for name, size in found.sizes.items())
    counts = {name: known[name] for name in ("points", "solved", "refused", "waiting")}
    said = [text("study.points", sizes=sizes, **counts)]
    said += _reach_lines(known["figures"])
    said += [""] if known["refusals"] or known["notes"] else []
    for each in known["refusals"]:
        said.append("  " + text("study.refused", points=each["points"], at=_said(each["at"]), reason=each["reason"]))
    for code, count in known["notes"].items():
        said.append("  " + text("study.noted", code=code, points=count, first=known["sentences"].get(code, "-")))
    return "\n".join(said)


def figures(found: Any) -> str:
    """Of `Figures`, or other columns: how far each figure reaches."""
    return "\n".join([figures_head(found), *_reach_lines(figures_reach(found))])


def figures_head(found: Any) -> str:
    """How many scenes there are, and what they differ by."""
    return text("study.scenes", scenes=len(found), keys=listed(found.varied) if found.varied else "none")


def figures_reach(found: Any) -> dict[str, Any]:
    """As `reaches`; `at` the values that scenes differ by, or else the number of the scene."""
    columns = ((name, found.kinds[name], values) for name, values in found.columns.items())
    varied = found.varied or {"scene": np.arange(len(found))}
    return reaches(columns, lambda row: {key: values[row].item() for key, values in varied.items()})


def reach_cells(each: Mapping[str, Any]) -> list[tuple[str, str]]:
    """Lowest and highest value of a figure, and where they are; once for what is the same throughout."""
    low, high = each["lowest"], each["highest"]
    if low["value"] == high["value"]:
        return [(shown(low["value"], ".6g"), text("study.everywhere"))]
    return [(shown(end["value"], ".6g"), text("study.at", at=_said(end["at"]))) for end in (low, high)]


def _reach_lines(known: Mapping[str, Any]) -> list[str]:
    names = {name: f"{name} [{each['unit']}]" if each["unit"] else name for name, each in known.items()}
    wide = max([0, *map(len, names.values())])
    head = [""] if names else []
    return head + [
        f"  {'' if n else names[name]:{wide}}  {value:>12}  {at}"
        for name, each in known.items()
        for n, (value, at) in enumerate(reach_cells(each))
    ]


def _said(at: Mapping[str, Any]) -> str:
    return ", ".join(
        f"{key}={value:.6g}" if isinstance(value, float) else f"{key}={value}" for key, value in at.items()
    )
