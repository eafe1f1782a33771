"""What a report says of a scene: its values by their keys, with units and tolerances, and what follows from them."""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from ...scene import Scene
from ..varied import unit_of, value_of

PARTS = ("impactor", "target", "contact")  # tables of a scene file that say what is struck by what
MATERIAL = {"young": "Pa", "density": "kg/m3", "poisson": "", "yield": "Pa"}
UNITS = {"inertia": "kg m2"}  # which no refusal says
WORDS = ("kind", "name", "law", "support", "theory", "shape", "shapes", "joint", "links", "link")  # of no unit


@dataclass(frozen=True)
class Value:
    """A number, numbers, or a word, in SI units."""

    name: str  # the end of its key
    value: Any
    unit: str = ""


@dataclass(frozen=True)
class Input:
    """One row: a value, or those that belong together, such as both sides of a section."""

    part: str  # impactor, target, contact or method
    key: str  # of scene files; "" of what follows and cannot be set
    values: tuple[Value, ...]
    tolerance: str = ""  # its distribution in words
    follows: bool = False  # from the others


def inputs_of(scene: Scene, tolerances: Mapping[str, str]) -> list[Input]:
    """All that is given, in the order of the scene file, and after each part what follows from it.

    `tolerances`: the words of distributions, by key or keys with commas between them.
    """
    words = {key: said for keys, said in tolerances.items() for key in keys.split(",")}
    given, known = scene.given or scene.table(), scene.table()
    rows: list[Input] = []
    for part in PARTS:
        rows += _rows(scene, part, part, given.get(part, {}), words)
        rows += _following(scene, part, given.get(part, {}), known.get(part, {}), words)
    there = {row.key for row in rows}
    rows += [
        Input(key.split(".")[0], key, (Value(_end(key), value_of(scene, key), unit_of(scene, key)),), said)
        for key, said in words.items()
        if key not in there
    ]
    return rows


def _rows(scene: Scene, part: str, key: str, table: Mapping[str, Any], words: Mapping[str, str]) -> Iterator[Input]:
    """Of one table: a row for each of its values, and one for each table in it."""
    for name, value in table.items():
        own = f"{key}.{name}"
        if isinstance(value, Mapping):
            yield from _together(scene, part, own, value, words)
        elif _tables(value):
            for number, each in enumerate(value, 1):
                yield from _together(scene, part, f"{own}.{number}", each, words)
        else:
            values = (_value(scene, own, name, value), *_constants(scene, part, name, value))
            yield Input(part, own, values, words.get(own, ""))


def _constants(scene: Scene, part: str, name: str, value: Any) -> tuple[Value, ...]:
    """Of a material that has a name."""
    material = getattr(scene, part).material if name == "material" and isinstance(value, str) else None
    if material is None:
        return ()
    found = {"young": material.young, "density": material.density, "poisson": material.poisson}
    return tuple(Value(each, number, MATERIAL[each]) for each, number in found.items())


def _together(scene: Scene, part: str, key: str, table: Mapping[str, Any], words: Mapping[str, str]) -> Iterator[Input]:
    """One row for what has no tolerance of its own, and one for each value that has."""
    flat = dict(_flat(table))
    apart = [name for name in flat if f"{key}.{name}" in words]
    rest = tuple(_value(scene, f"{key}.{name}", name, value) for name, value in flat.items() if name not in apart)
    if rest:
        yield Input(part, key, rest, words.get(key, ""))
    for name in apart:
        own = f"{key}.{name}"
        yield Input(part, own, (_value(scene, own, _end(own), flat[name]),), words[own])


def _flat(table: Mapping[str, Any], start: str = "") -> Iterator[tuple[str, Any]]:
    for name, value in table.items():
        if isinstance(value, Mapping):
            yield from _flat(value, f"{start}{name}.")
        else:
            yield f"{start}{name}", value


def _value(scene: Scene, key: str, name: str, value: Any) -> Value:
    end = _end(key)
    if isinstance(value, str) or end in WORDS:
        return Value(name, value)
    if ".material." in f".{key}" and end in MATERIAL:
        return Value(name, value, MATERIAL[end])
    return Value(name, value, UNITS.get(end) or unit_of(scene, key))


def _following(
    scene: Scene, part: str, given: Mapping[str, Any], known: Mapping[str, Any], words: Mapping[str, str]
) -> Iterator[Input]:
    """Constants of the contact and masses that are not given, and how fast the bodies meet."""
    if part == "contact":
        for name, value in known.items():
            if name not in given and isinstance(value, (int, float)):
                key = f"contact.{name}"
                yield Input(part, key, (_value(scene, key, name, value),), words.get(key, ""), True)
        if not scene.prescribed_force:
            yield Input(part, "", (Value("approach", scene.speed, "m/s"),), follows=True)
        return
    body = getattr(scene, part)
    mass = getattr(body, "mass", math.inf)
    if "mass" not in given and isinstance(mass, float) and math.isfinite(mass) and mass > 0.0:
        yield Input(part, f"{part}.mass" if "mass" in known else "", (Value("mass", mass, "kg"),), follows=True)


def _tables(value: Any) -> bool:
    return isinstance(value, Sequence) and bool(value) and all(isinstance(each, Mapping) for each in value)


def _end(key: str) -> str:
    return key.rpartition(".")[2]
