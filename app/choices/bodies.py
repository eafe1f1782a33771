"""Geometry and materials of bodies as choices: what of a scene can be set, and the scene with other values.

A value has the key that it has in a scene file, rods of a chain by their number: `target.length`,
`target.rods.2.material`. All that are changed are one choice, as text: "target.length=0.5 target.material=bronze".
"""

import math
import re
from collections.abc import Mapping
from copy import deepcopy
from dataclasses import replace
from typing import Any, NamedTuple

import param

from solvers import Material, Scene
from solvers.bodies import MATERIALS, AnyBody, read_material
from solvers.bodies.pendulum import Pivoted

from ..text.catalogues import page

Values = dict[str, float | str]  # by key
RANGES = {  # of quantities, in SI units and in the order of the page; within what scene files may say
    "mass": (1e-9, 1e9),
    "length": (1e-5, 1e4),
    "section.width": (1e-6, 1e2),
    "section.height": (1e-6, 1e2),
    "section.radius": (1e-6, 1e2),
    "section.area": (1e-12, 1e4),
    "section.second_moment": (1e-26, 1e8),
    "radius": (1e-6, 1e4),
    "end_mass": (1e-9, 1e9),
    "stiffness": (1e-3, 1e15),
    "gap": (0.0, 1.0),
    "material.young": (1e5, 1e13),
    "material.density": (1.0, 1e5),
    "material.poisson": (-0.99, 0.499),
    "material.yield": (1e3, 1e12),
}
QUANTITIES = ("material", *RANGES)
_KEY = re.compile(rf"(impactor|target(?:\.rods\.(?:[1-9]|1[0-2]))?)\.({'|'.join(map(re.escape, QUANTITIES))})")
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?", re.IGNORECASE | re.ASCII)
_HARMLESS = re.compile(r"[\w.+-]{1,24}", re.ASCII)  # a word or a number, which may be repeated to who has written it
LONGEST = 800  # letters of all changed values together
SAME = 1e-9  # relative difference of two numbers that are the same but for rounding


class Part(NamedTuple):
    """A body, or a rod of a chain, with its table in the scene file."""

    key: str
    body: AnyBody
    table: Mapping[str, Any]

    @property
    def quantities(self) -> list[str]:
        """What of it can be set."""
        return [quantity for quantity in QUANTITIES if self._has(quantity)]

    def _has(self, quantity: str) -> bool:
        group, _, name = quantity.partition(".")
        if group == "material":
            weighs = self.body.length > 0.0 or (self.body.free_mass and "mass" not in self.table)
            return self.body.material is not None and "material" in self.table and (name != "density" or weighs)
        if group == "section":
            return name in self.table.get("section", {})
        if isinstance(self.body, Pivoted) and quantity == "mass":
            return False  # felt at the contact is another one, which the mass ratio sets
        return quantity in self.table or (quantity == "mass" and self.body.free_mass)

    def value(self, quantity: str) -> float | str | None:
        """In SI units; of its material the name, empty where it has none, and None for a strength that is not known."""
        group, _, name = quantity.partition(".")
        if quantity == "mass":
            return self.body.mass
        if group == "material" and (material := self.body.material) is not None:
            return material.table().get(name) if name else _name_of(material)
        return self.table[group][name] if name else self.table[quantity]


def _name_of(material: Material) -> str:
    """Of the known one with the same elasticity and density, which says little of strength; or nothing."""
    own = replace(material, yield_strength=None)
    return next((name for name, known in MATERIALS.items() if replace(known, yield_strength=None) == own), "")


def parts_of(scene: Scene) -> list[Part]:
    """Its bodies, the rods of a chain one by one."""
    given: Mapping[str, Any] = scene.given or scene.table()
    parts = [Part(name, getattr(scene, name), given[name]) for name in ("impactor", "target")]
    if isinstance(chain := given["target"].get("rods"), list):
        rods = zip(scene.target.rods, chain, strict=True)
        parts += [Part(f"target.rods.{number}", rod, table) for number, (rod, table) in enumerate(rods, 1)]
    return parts


def is_key(key: str) -> bool:
    """Whether a value of some body could have this key."""
    return _KEY.fullmatch(key) is not None


def split(key: str) -> tuple[str, str]:
    """Part and quantity. Raises ValueError, with a sentence for the visitor, where no body could have such a key."""
    if not is_key(key):
        raise ValueError(page().text("refused.body-key", key=_repeated(key)))
    part, quantity = _KEY.fullmatch(key).groups()  # type: ignore[union-attr]
    return part, quantity


def _repeated(text: str) -> str:
    return repr(text) if _HARMLESS.fullmatch(text) else page().text("refused.some-text")


def title_of_value(key: str) -> str:
    """What the page calls it."""
    part, quantity = split(key)
    name = page().text(f"body.value.{quantity}")
    return page().text("refused.body-value", name=name, part=part.partition(".")[0], rod=part.rpartition(".")[2])


def read_value(key: str, text: str) -> float | str:
    """A number in SI units, or the name of a material. Raises ValueError with a sentence for the visitor."""
    _, quantity = split(key)
    said = {"control": title_of_value(key), "value": _repeated(text)}
    if quantity == "material":
        if text not in MATERIALS:
            raise ValueError(page().text("refused.choice", **said, options=list(MATERIALS)))
        return text
    low, high = RANGES[quantity]
    value = float(text) if _NUMBER.fullmatch(text) else math.nan
    if not low <= value <= high:
        unit = page().texts.get(f"body.unit.{quantity}", "none")
        raise ValueError(page().text("refused.number", **said, whole=False, low=low, high=high, unit=unit))
    return value


def read_values(text: str) -> Values:
    """All changed values. Raises ValueError with a sentence for the visitor."""
    if len(text) > LONGEST:
        raise ValueError(page().text("refused.body-values", longest=LONGEST))
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

    Raises ValueError with a sentence for the visitor: SceneError, or for a value that the bodies do not have.
    """
    if not values:
        return base
    known = {part.key: part for part in parts_of(base)}
    tables = {name: deepcopy(base.given[name]) for name in ("impactor", "target")}
    for key, value in sorted(values.items()):  # a material first, then what of it is otherwise
        name, quantity = split(key)
        if name not in known or quantity not in known[name].quantities:
            raise ValueError(page().text("refused.no-such-value", value=title_of_value(key)))
        chain = name.split(".")
        _set(tables[chain[0]]["rods"][int(chain[2]) - 1] if len(chain) > 1 else tables[name], quantity, value)
    changed = base.replace(tables)
    if "duration" not in base.method:
        return changed
    duration = base.method["duration"] * changed.time_unit / base.time_unit
    return changed.replace({"method": dict(base.method) | {"duration": duration}})


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
