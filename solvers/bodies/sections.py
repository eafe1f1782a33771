"""Cross-sections of rods and beams."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from .. import validation
from ..validation import SceneError, allowed

FORMS = allowed("section", sides="{ width, height }", radius="{ radius }", area="{ area }")
BENDING_KEYS = ("second_moment", "shear_coefficient")


@dataclass(frozen=True)
class Section:
    """A section by width and height (along the impact), by radius, or by its area; bending needs more than the area.

    What is None does not follow from what was given.
    """

    area: float  # A [m2]
    second_moment: float | Any = None  # I [m4]
    half_depth: float | Any = None  # of the outer fibre from the neutral line [m]
    shear_coefficient: float | None = None  # kappa, if given
    sides: tuple[float, ...] = ()  # (width, height), (radius,), or nothing where only the area is known [m]

    @property
    def least_moment(self) -> float | None:
        """Second moment about the axis about which it bends most easily [m4], if it is known."""
        if len(self.sides) == 2:
            width, height = sorted(self.sides)
            return height * width**3 / 12.0
        return self.second_moment

    def shear_coefficient_for(self, poisson: float) -> float:
        """kappa by Cowper (1966), from the shape unless given; of an unknown shape that of a rectangle."""
        if self.shear_coefficient is not None:
            return self.shear_coefficient
        if len(self.sides) == 1:
            return 6.0 * (1.0 + poisson) / (7.0 + 6.0 * poisson)
        return 10.0 * (1.0 + poisson) / (12.0 + 11.0 * poisson)

    def table(self) -> dict[str, float]:
        """As in a scene file."""
        own = {} if self.shear_coefficient is None else {"shear_coefficient": self.shear_coefficient}
        if self.sides:
            names = ("radius",) if len(self.sides) == 1 else ("width", "height")
            return dict(zip(names, self.sides, strict=True)) | own
        return {"area": self.area} | ({} if self.second_moment is None else {"second_moment": self.second_moment}) | own


def read_section(key: str, given: object) -> Section:
    """A section given by width and height, by radius, or outright.

    Raises SceneError naming the key.
    """
    given = validation.table(key, given, ("width", "height", "radius", "area", *BENDING_KEYS))
    names = frozenset(given) - frozenset(BENDING_KEYS)
    if names not in tuple(map(frozenset, (("width", "height"), ("radius",), ("area",)))):
        raise SceneError(key, dict(given), FORMS)
    second, shear = (given.get(name) for name in BENDING_KEYS)
    if second is not None:
        second = validation.number(f"{key}.second_moment", second, 1e-30, 1e16, "m4")
    if shear is not None:
        shear = validation.number(f"{key}.shear_coefficient", shear, 0.01, 1.0)
    if "area" in given:
        area = validation.number(f"{key}.area", given["area"], 1e-14, 1e8, "m2")
        # the outer fibre of the rectangle of this area and second moment
        return Section(area, second, None if second is None else math.sqrt(3.0 * second / area), shear)
    if second is not None:
        raise SceneError(f"{key}.second_moment", second, allowed("follows-from-shape"))
    sides = {name: validation.number(f"{key}.{name}", given[name], 1e-7, 1e4, "m") for name in names}
    if "radius" in sides:
        radius = sides["radius"]
        return Section(math.pi * radius**2, 0.25 * math.pi * radius**4, radius, shear, (radius,))
    width, height = sides["width"], sides["height"]
    return Section(width * height, width * height**3 / 12.0, 0.5 * height, shear, (width, height))


def section_of_bar(key: str, given: Mapping[str, Any]) -> Section:
    """The section of the table of a rod or beam. Raises SceneError."""
    return read_section(f"{key}.section", validation.required(key, given, "section", FORMS))
