"""What uncertain inputs make of figures, to read: how far they spread, and which input that is owed to."""

import math
from collections.abc import Sequence
from typing import Any

from .words import existing, family, named, text


def lines(found: Any) -> str:
    """A line for each figure, then one for each input of each, that with the largest index first."""
    drawn = text("uncertain.drawn", samples=found.kept, solves=found.solves, seconds=found.wall_time)
    said = [found.title or text("report.scene"), *(f"  {each}" for each in (*inputs(found), drawn)), ""]
    said += _aligned([spread_heads(found), *spreads(found)], 1)
    shared = shares(found)
    said += ["", *_aligned([share_heads(), *shared], 2)] if shared else []
    beside = [*without(found), *(text("report.note", note=note) for note in found.notes)]
    return "\n".join([*said, *([""] if beside else []), *beside])


def inputs(found: Any) -> list[str]:
    """A line for each, with its distribution."""
    return [text("uncertain.input", key=key, law=law) for key, law in found.inputs.items()]


def spread_heads(found: Any) -> list[str]:
    """Of the table of spreads."""
    head = family("uncertain.head")
    parts = [text("uncertain.head.part", part=part) for part in next(iter(found.figures.values())).quantiles]
    return [head["figure"], head["mean"], head["deviation"], *parts, head["lowest"], head["highest"]]


def spreads(found: Any) -> list[list[str]]:
    """A row for each figure."""
    rows = []
    for name, each in found.figures.items():
        numbers = (each.mean, each.deviation, *each.quantiles.values(), each.lowest, each.highest)
        rows.append([_called(name, each.unit), *(existing(number, ".6g") for number in numbers)])
    return rows


def share_heads() -> list[str]:
    """Of the table of indices."""
    return list(family("uncertain.shares").values())


def shares(found: Any) -> list[list[str]]:
    """A row for each input of each figure that has indices."""
    return [
        [
            named("quantity", name) if number == 0 else "",
            key,
            existing(round(share.first, 3), ".3f"),
            _within(share.first_within),
            existing(round(share.total, 3), ".3f"),
            _within(share.total_within),
            existing(round(share.elasticity, 3), "+.3f"),
        ]
        for name, each in found.figures.items()
        for number, key in enumerate(each.ranking)
        for share in (each.shares[key],)
    ]


def without(found: Any) -> list[str]:
    """Of figures that have no indices."""
    names = [name for name, each in found.figures.items() if each.shares is None]
    return [text("uncertain.no-shares", figure=named("quantity", name)) for name in names]


def _called(name: str, unit: str) -> str:
    return named("quantity", name) + (f" [{unit}]" if unit else "")


def _within(ends: tuple[float, float]) -> str:
    return "-" if any(map(math.isnan, ends)) else " .. ".join(existing(round(end, 3), ".3f") for end in ends)


def _aligned(rows: Sequence[Sequence[str]], words: int) -> list[str]:
    """Columns of one width each, the first ones of words."""
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    sides = ["<"] * words + [">"] * (len(widths) - words)
    return [
        "  " + "  ".join(f"{cell:{side}{width}}" for cell, side, width in zip(row, sides, widths, strict=True)).rstrip()
        for row in rows
    ]
