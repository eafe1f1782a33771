"""What a report says of a study: keys that were varied, how far figures reach, and kinds of refusals and notes."""

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .numbers import USUAL

FEW_KEYS, MOST_FIGURES, FEWER_FIGURES = 3, 8, 5  # figures that are shown unless they are named, of few keys or of many


@dataclass(frozen=True)
class Varied:
    """Keys that take their values together."""

    keys: tuple[str, ...]
    units: tuple[str, ...]
    values: tuple[tuple[Any, ...], ...]  # of each key, the different ones in their order
    law: str  # by which they are drawn; "" where they are listed

    def table(self) -> dict[str, Any]:
        """As plain values: of numbers the lowest and the highest, and how many there are."""
        keys = {
            key: {"unit": unit, "count": len(values)}
            | ({"lowest": values[0], "highest": values[-1]} if numeric(values) else {"values": list(values)})
            for key, unit, values in zip(self.keys, self.units, self.values, strict=True)
        }
        return {"keys": keys, "law": self.law}


@dataclass(frozen=True)
class Place:
    """A value, and the keys where it is."""

    value: float
    at: Mapping[str, Any]


@dataclass(frozen=True)
class Reach:
    """How far a figure reaches; `median`: that of all points that have it, the lower one of two."""

    name: str
    unit: str
    least: Place
    median: Place
    largest: Place

    def table(self) -> dict[str, Any]:
        """As plain values."""
        ends = {"least": self.least, "median": self.median, "largest": self.largest}
        return {"unit": self.unit} | {name: {"value": end.value, "at": dict(end.at)} for name, end in ends.items()}


@dataclass(frozen=True)
class Kind:
    """Points with the same refusal or note: its code, how many, the sentence of the first and where that is."""

    code: str
    points: int
    said: str
    at: Mapping[str, Any]

    def table(self) -> dict[str, Any]:
        """As plain values."""
        return {"code": self.code, "points": self.points, "said": self.said, "at": dict(self.at)}


def varied_of(dataset: Any) -> list[Varied]:
    """As the design says, and of what is drawn the values that were."""
    found = []
    for axis in json.loads(dataset.attrs["design"])["vary"]:
        keys = tuple(axis["keys"])
        columns = [dataset[key].values for key in keys]
        values = tuple(tuple(_different(column)) for column in columns)
        units = tuple(str(dataset[key].attrs.get("units", "")) for key in keys)
        found.append(Varied(keys, units, values, axis.get("law", "")))
    return found


def _different(column: np.ndarray) -> list[Any]:
    """Numbers in rising order; words as they come."""
    return np.unique(column).tolist() if column.dtype.kind in "iuf" else list(dict.fromkeys(column.tolist()))


def shown_of(
    there: Sequence[str], names: Sequence[str] | None, known: Mapping[str, Any], keys: int
) -> tuple[list[str], list[str]]:
    """Figures that are shown, those that say most first, and others that some point has."""
    some = [name for name in there if name in known]
    if names is not None:
        return [name for name in names if name in known], []
    some = [name for name in some if any(known[name][end]["value"] for end in ("lowest", "highest"))]
    first = [name for name in USUAL if name in some and name != "contacts"]
    ordered = first + [name for name in some if name not in first and name != "estimated_error"]
    most = MOST_FIGURES if keys <= FEW_KEYS else FEWER_FIGURES
    shown = ordered[:most]
    if "contacts" in ordered[most:]:  # which no other figure says
        shown[-1] = "contacts"
    return shown, [name for name in ordered if name not in shown]


def numeric(values: Sequence[Any]) -> bool:
    """Whether all are numbers."""
    return all(isinstance(each, (int, float)) and not isinstance(each, bool) for each in values)


def reach_of(dataset: Any, name: str, known: Mapping[str, Any]) -> Reach:
    from ...notebook import study_tables

    values = dataset[name].values.ravel()
    median = float(np.nanquantile(values, 0.5, method="lower"))  # which some point has
    nearest = int(np.nanargmin(np.abs(values - median)))
    ends = [Place(known[end]["value"], known[end]["at"]) for end in ("lowest", "highest")]
    return Reach(name, known["unit"], ends[0], Place(median, study_tables.at(dataset, nearest)), ends[1])
