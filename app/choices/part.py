"""Parts of the bodies of a scene, and what of each can be set."""

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, NamedTuple

from solvers import Material
from solvers.bodies import MATERIALS

RANGES = {  # of quantities, in SI units and in the order of the page; within what scene files may say
    "mass": (1e-9, 1e9),
    "length": (1e-5, 1e4),
    "section.width": (1e-6, 1e2),
    "section.height": (1e-6, 1e2),
    "section.radius": (1e-6, 1e2),
    "section.area": (1e-12, 1e4),
    "section.second_moment": (1e-26, 1e8),
    "x": (-1e4, 1e4),
    "y": (-1e4, 1e4),
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


class Part(NamedTuple):
    """A body, or a part of one."""

    key: str  # of its table
    body: Any  # `AnyBody`, or a link or joint of a mechanism
    table: Mapping[str, Any]  # as in the scene file, or what stands for it
    quantities: list[str]  # that can be set
    name: str = ""  # of a link or joint

    def value(self, quantity: str) -> float | str | None:
        """In SI units; of its material the name, empty where it has none, and None for a strength that is not known."""
        group, _, name = quantity.partition(".")
        if quantity == "mass":
            return self.body.mass
        if group == "material" and (material := self.body.material) is not None:
            return material.table().get(name) if name else _name_of(material)
        return self.table[group][name] if name else self.table[quantity]


def in_table(table: Mapping[str, Any], weighs: bool) -> list[str]:
    """The quantities that a table gives; the density of its material only where mass follows from it."""

    def has(quantity: str) -> bool:
        group, _, name = quantity.partition(".")
        if group == "material":
            return "material" in table and (name != "density" or weighs)
        return name in table.get(group, {}) if name else quantity in table

    return [quantity for quantity in QUANTITIES if has(quantity)]


def _name_of(material: Material) -> str:
    """Of the known one with the same elasticity and density, which says little of strength; or nothing."""
    own = replace(material, yield_strength=None)
    return next((name for name, known in MATERIALS.items() if replace(known, yield_strength=None) == own), "")
