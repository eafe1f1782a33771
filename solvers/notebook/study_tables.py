"""A study in a few lines: how far its figures reach and where, what was refused, and what is to be known."""

import json
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

import numpy as np

from .regions import NOT_SOLVED, WORDS, blocks_of
from .words import listed, shown, text

STRETCH = 1_000_000  # points that are looked at at once


def summary(found: Any) -> dict[str, Any]:
    """Of a Dataset of `solvers.study`, as plain tables: numbers of points; refusals and notes by code; the lowest and
    the highest value of each figure, with the values of the keys there. It is read a stretch at a time."""
    points, solved = found.refused.size, 0
    by_code: dict[str, tuple[int, int]] = {}  # the first point, and how many there are
    notes: dict[str, tuple[int, int]] = {}
    for first, refused in _stretches(found.refused):
        there = np.flatnonzero(refused != "")
        solved += refused.size - there.size
        for code, where, count in _counted(refused[there]):
            before = by_code.get(code, (first + int(there[where]), 0))
            by_code[code] = before[0], before[1] + count
    for first, said in _stretches(found.notes):
        there = np.flatnonzero(said != "")
        for codes, where, count in _counted(said[there]):
            for code in codes.split():
                before = notes.get(code, (points, 0))
                notes[code] = min(before[0], first + int(there[where])), before[1] + count
    waiting = by_code.pop(NOT_SOLVED, (0, 0))[1]
    noted = sorted(notes.items(), key=lambda each: (-each[1][1], each[0]))
    return {
        "points": points,
        "solved": solved,
        "refused": points - solved - waiting,
        "waiting": waiting,
        "figures": reaches(
            ((str(name), each.attrs.get("units", ""), _stretches(each)) for name, each in found.data_vars.items()),
            lambda where: at(found, where),
        ),
        "refusals": [
            {"code": code, "points": count, "at": at(found, where), "reason": _value(found.reason, where)}
            for code, (where, count) in sorted(by_code.items(), key=lambda each: (-each[1][1], each[0]))
        ],
        "notes": {code: count for code, (_, count) in noted},
        "noted_at": {code: at(found, where) for code, (where, _) in noted},  # the first point that has it
        "sentences": json.loads(
            found.attrs.get("sentences", "{}")
        ),  # by code, the sentence of the first point that has it
    }


def reaches(
    columns: Iterable[tuple[str, str, Iterable[tuple[int, np.ndarray]]]], at: Callable[[int], Mapping[str, Any]]
) -> dict[str, Any]:
    """The lowest and the highest value of each figure, with what `at` says of the points where they are; columns: name,
    unit, and values by stretches, each with the number of its first point."""
    found: dict[str, Any] = {}
    for name, unit, stretches in columns:
        if name in WORDS:
            continue
        low, high = (np.inf, -1), (-np.inf, -1)  # with their points
        for first, values in stretches:
            if not np.isnan(values).all():
                where = int(np.nanargmin(values)), int(np.nanargmax(values))
                low = min(low, (float(values[where[0]]), first + where[0]))
                high = max(high, (float(values[where[1]]), first + where[1]), key=lambda each: each[0])
        if low[1] >= 0:
            ends = {"lowest": low, "highest": high}
            reach = {end: {"value": value, "at": at(where)} for end, (value, where) in ends.items()}
            found[name] = {"unit": unit} | reach
    return found


def _stretches(array: Any) -> Iterator[tuple[int, np.ndarray]]:
    """The values of an array, flat, with the number of their first point: so many as are held at once."""
    for span in (blocks := blocks_of(array.shape, STRETCH)):
        yield span[0], np.asarray(array.variable[blocks.region(span)].values).ravel()


def _counted(words: np.ndarray) -> Iterator[tuple[str, int, int]]:
    """Each word, the place where it is first, and how often it is there."""
    different, first, counts = np.unique(words.astype(object).astype(str), return_index=True, return_counts=True)
    yield from zip(different.tolist(), first.tolist(), counts.tolist(), strict=True)


def _value(array: Any, point: int) -> str:
    """The word at a point."""
    return str(np.asarray(array.variable[np.unravel_index(point, array.shape)].values))


def at(found: Any, point: int) -> dict[str, Any]:
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
        at(found, point) | {str(name): _plain(values[point]) for name, values in columns.items()}
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
    columns = ((name, found.kinds[name], [(0, values)]) for name, values in found.columns.items())
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
