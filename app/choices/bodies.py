"""Geometry and materials of bodies as choices: what of a scene can be set, and the scene with other values.

A value has the key that it has in a scene file, rods of a chain, links and joints by their number: `target.length`,
`target.rods.2.material`. All that are changed are one choice, as text: "target.length=0.5 target.material=bronze".
"""

import math
import re
from collections.abc import Mapping
from copy import deepcopy
from typing import Any

import param

from solvers import Scene, SceneError
from solvers.bodies import MATERIALS, AnyBody, Mechanism, read_material
from solvers.bodies.pendulum import Pivoted

from ..text.refusals import SOME_TEXT, Refused, code_or, note
from .mechanism import PLACED, mechanism_parts, move, on_mechanism
from .part import QUANTITIES, RANGES, Part, in_table

Values = dict[str, float | str]  # by key
_PART = r"(?:impactor|target)(?:\.rods\.(?:[1-9]|1[0-2]))?|target\.(?:links|joints)\.[1-9]\d?"
_KEY = re.compile(rf"({_PART})\.({'|'.join(map(re.escape, QUANTITIES))})")
_NUMBER = re.compile(r"[+-]?(\d+(\.\d*)?|\.\d+)(e[+-]?\d+)?", re.IGNORECASE | re.ASCII)
_HARMLESS = re.compile(r"[\w.+-]{1,24}", re.ASCII)  # a word or a number, which may be repeated to who has written it
LONGEST = 800  # letters of all changed values together
SAME = 1e-9  # relative difference of two numbers that are the same but for rounding


def parts_of(scene: Scene) -> list[Part]:
    """Its bodies, the rods of a chain one by one, and links and joints of a mechanism."""
    given: Mapping[str, Any] = scene.given or scene.table()
    parts = [_part(name, getattr(scene, name), given[name]) for name in ("impactor", "target")]
    for name in ("impactor", "target"):
        if isinstance(chain := given[name].get("rods"), list):
            rods = zip(getattr(scene, name).rods, chain, strict=True)
            parts += [_part(f"{name}.rods.{number}", rod, table) for number, (rod, table) in enumerate(rods, 1)]
    if on_mechanism(scene):
        parts += mechanism_parts(scene, given["target"])
    return parts


def _part(key: str, body: AnyBody, table: Mapping[str, Any]) -> Part:
    own = {*in_table(table, body.length > 0.0 or (body.free_mass and "mass" not in table))}
    if body.material is None:
        own -= {quantity for quantity in own if quantity.startswith("material")}
    if isinstance(body, Pivoted):
        own -= {"mass"}  # felt is another one, which the mass ratio sets
    elif body.free_mass and "mass" in body.of_mass(body.mass):
        own |= {"mass"}
    return Part(key, body, table, [quantity for quantity in QUANTITIES if quantity in own])


def is_key(key: str) -> bool:
    """Whether a value of some body could have this key."""
    return _KEY.fullmatch(key) is not None


def split(key: str) -> tuple[str, str]:
    """Part and quantity. Raises ValueError, for the visitor, where no body could have such a key."""
    if not is_key(key):
        raise Refused("refused.body-key", key=_repeated(key))
    part, quantity = _KEY.fullmatch(key).groups()  # type: ignore[union-attr]
    return part, quantity


def _repeated(text: str) -> str:
    return repr(text) if _HARMLESS.fullmatch(text) else SOME_TEXT


def title_of_value(key: str) -> dict[str, Any]:
    """What the page calls it, as a note."""
    part, quantity = split(key)
    body, *place = part.split(".")
    kind, number = place or ("none", "")
    name = f"body.value.{quantity}"
    return note("refused.body-value", name=name, body=body, kind=kind, number=number).table()


def read_value(key: str, text: str) -> float | str:
    """A number in SI units, or the name of a material. Raises ValueError, for the visitor."""
    _, quantity = split(key)
    said = {"control": title_of_value(key), "value": _repeated(text)}
    if quantity == "material":
        if text not in MATERIALS:
            raise Refused("refused.choice", **said, options=list(MATERIALS))
        return text
    low, high = RANGES[quantity]
    value = float(text) if _NUMBER.fullmatch(text) else math.nan
    if not low <= value <= high:
        unit = code_or(f"body.unit.{quantity}", "none")
        raise Refused("refused.number", **said, whole=False, low=low, high=high, unit=unit)
    return value


def read_values(text: str) -> Values:
    """All changed values. Raises ValueError, for the visitor."""
    if len(text) > LONGEST:
        raise Refused("refused.body-values", longest=LONGEST)
    found: Values = {}
    for each in text.split():
        key, _, value = each.partition("=")
        found[key] = read_value(key, value)
    return found


def written(values: Values) -> str:
    """The same as text; a number in so many digits as bring it back."""
    return " ".join(
        f"{key}={value if isinstance(value, str) else repr(value)}" for key, value in sorted(values.items())
    )


class BodyValues(param.String):
    """Changed values of bodies: text that `read_values` can read."""

    def _validate_value(self, val: Any, allow_None: bool) -> None:
        super()._validate_value(val, allow_None)
        read_values(val)


def with_values(base: Scene, values: Values) -> Scene:
    """The scene with other values; a time that it is solved for changes with its unit of time.

    Raises ValueError, for the visitor: SceneError, or for a value that the bodies do not have.
    """
    if not values:
        return base
    known = {part.key: part for part in parts_of(base)}
    tables = {name: deepcopy(base.given[name]) for name in ("impactor", "target")}
    for key, value in sorted(values.items()):  # a material first, then what of it is otherwise
        name, quantity = split(key)
        if name not in known or quantity not in known[name].quantities:
            raise Refused("refused.no-such-value", value=title_of_value(key))
        body, *place = name.split(".")
        if place and on_mechanism(base) and quantity in PLACED and isinstance(value, float):
            move(tables[body], known[name].key, quantity, value)
        else:
            _set(tables[body][place[0]][int(place[1]) - 1] if place else tables[body], quantity, value)
    if on_mechanism(base):  # where it is struck it may move otherwise, and is approached as before
        tables["impactor"]["velocity"] = _linkage(tables["target"]).velocity + base.speed
    changed = base.replace(tables)
    if "duration" not in base.method:
        return changed
    duration = base.method["duration"] * changed.time_unit / base.time_unit
    return changed.replace({"method": dict(base.method) | {"duration": duration}})


def _linkage(table: dict[str, Any]) -> Mechanism:
    """Raises ValueError, for the visitor where it cannot be put together, or moves otherwise."""
    try:
        return Mechanism.read("target", table)
    except SceneError as refusal:
        raise Refused("refused.linkage", allowed=refusal.reason.table()) from None


def _set(table: dict[str, Any], quantity: str, value: Any) -> None:
    """Put a value into the table of a body."""
    group, _, name = quantity.partition(".")
    if group == "material" and name:
        table["material"] = read_material("material", table["material"]).table() | {name: value}
    elif name:
        table[group][name] = value
    else:
        if quantity == "mass" and "inertia" in table:  # the body stays as large as it is
            table["inertia"] = _scaled(table["inertia"], value / table["mass"])
        table[quantity] = value


def _scaled(inertia: Any, times: float) -> Any:
    return [_scaled(each, times) for each in inertia] if isinstance(inertia, (list, tuple)) else times * inertia
