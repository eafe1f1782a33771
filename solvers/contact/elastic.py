"""Elastic laws: the force depends on the indentation alone and gives all work back.

Every law answers the same questions, in SI units, `deepest` being the largest indentation so far (0 before):
`force(indentation, rate, deepest)` [N], never negative; `slopes(indentation, rate, deepest)`, its partial derivatives
by the first two; `stored(indentation, deepest)` [J], the energy that the contact would give back; `dent(deepest)` [m],
the indentation at which it opens; `corner(indentation, deepest)` [m], the next larger one where the curve changes its
formula; `mean(start, end, rate, deepest)`, the mean force [N] along the straight path between two indentations, passed
at (end - start) * rate, and the energy lost on it [J]; `unloading(deepest)`, the dent and one more number of the way
back, which change with `deepest` only; `mean_force`, given these as its memory, the force of one step of the modal
kernel and the memory after it, see `step_force`. LOSSY, PLASTIC, JUMPS: whether damping loses energy, whether
`deepest` matters, whether the force may jump at first touch. EXPONENT: the power of the indentation with which the
force begins, None if it is a constant of the law or nothing gives way. VARIED: constants of its own that the page has
a slider for, each with its usual value and its range. EXAMPLE: constants that suit a scene file.
"""

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

from .. import validation
from ..text.notes import Note
from .constants import EXPONENT_RANGE, hertz_stiffness, point_limits, read_stiffness
from .discrete_gradient import hertz_mean, hertz_spring_step, linear_mean, no_memory, power_mean, step_force


class Rigid(NamedTuple):
    """Both surfaces move as one while they press on each other; no indentation.

    Source: thesis 4.4. `waves` solves it exactly; `modal` gives it the compliance of the modes left out.
    """

    NAME = "rigid"
    EXPONENT = None
    VARIED = {}
    KEYS = ()
    LOSSY = PLASTIC = JUMPS = False
    EXAMPLE = {}

    def table(self, speed: float) -> dict[str, float]:
        """The constants as in a scene file, for an impact at this speed [m/s]."""
        return {}

    @classmethod
    def read(cls, given: Mapping[str, Any], impactor: Any, target: Any) -> "Rigid":
        return cls()

    def limits(self, deepest: float, impactor: Any, target: Any) -> list[Note]:
        """What the law leaves out of an impact as deep as this [m]."""
        return []


class Linear(NamedTuple):
    """A spring that cannot pull. Source: thesis (7.1)."""

    stiffness: float  # K_l [N/m]

    NAME = "linear"
    EXPONENT = 1.0
    VARIED = {}
    KEYS = ("stiffness",)
    LOSSY = PLASTIC = JUMPS = False
    EXAMPLE = {"stiffness": 1e9}

    def table(self, speed: float) -> dict[str, float]:
        """The constants as in a scene file, for an impact at this speed [m/s]."""
        return {"stiffness": self.stiffness}

    @classmethod
    def read(cls, given: Mapping[str, Any], impactor: Any, target: Any) -> "Linear":
        return cls(read_stiffness(given, "N/m"))

    def limits(self, deepest: float, impactor: Any, target: Any) -> list[Note]:
        """What the law leaves out of an impact as deep as this [m]."""
        return []

    def scaled(self, length: float, speed: float, force: float) -> "Linear":
        """The same law in units of these."""
        return Linear(self.stiffness * length / force)

    def force(self, indentation, rate, deepest):
        return self.stiffness * max(indentation, 0.0)

    def slopes(self, indentation, rate, deepest):
        return (self.stiffness if indentation > 0.0 else 0.0), 0.0

    def stored(self, indentation, deepest):
        return 0.5 * self.stiffness * max(indentation, 0.0) ** 2

    def dent(self, deepest):
        return 0.0

    unloading = no_memory

    def corner(self, indentation, deepest):
        return math.inf

    def mean(self, start, end, rate, deepest):
        return self.stiffness * linear_mean(start, end), 0.0

    def mean_force(self, start, free, compliance, rate, expected, deepest, memory):
        """As `discrete_gradient.step_force`; for a spring each case is a linear or quadratic equation."""
        if start <= 0.0 and free <= 0.0:
            return 0.0, free, 0.0, memory
        if start <= 0.0:  # touches within the step: (free - end)(end - start) = compliance * stiffness * end^2 / 2
            square, half = 1.0 + 0.5 * compliance * self.stiffness, 0.5 * (free + start)
            root = math.sqrt(half * half - square * free * start)
            end = (half + root) / square if half > 0.0 else -free * start / (root - half)
            return (free - end) / compliance, end, 0.0, memory
        force = self.stiffness * (start + free) / (2.0 + self.stiffness * compliance)
        end = free - compliance * force
        if end >= 0.0:
            return force, end, 0.0, memory
        # leaves within the step: all that is stored is given back on the way
        half, stored = 0.5 * (start - free), 0.5 * self.stiffness * start * start
        root = math.sqrt(half * half + compliance * stored)
        force = stored / (half + root) if half > 0.0 else (root - half) / compliance
        return force, free - compliance * force, 0.0, memory


class Power(NamedTuple):
    """Any other elastic contact of one power: F = K alpha^n. Source: thesis (7.4)."""

    stiffness: float  # K [N/m^n]
    exponent: float  # n

    NAME = "power"
    EXPONENT = None
    VARIED = {"exponent": (1.5, *EXPONENT_RANGE)}
    KEYS = ("stiffness", "exponent")
    LOSSY = PLASTIC = JUMPS = False
    EXAMPLE = {"stiffness": 1e9, "exponent": 1.3}

    limits = Linear.limits

    def table(self, speed: float) -> dict[str, float]:
        """The constants as in a scene file, for an impact at this speed [m/s]."""
        return {"stiffness": self.stiffness, "exponent": self.exponent}

    @classmethod
    def read(cls, given: Mapping[str, Any], impactor: Any, target: Any) -> "Power":
        exponent = validation.required_number("contact", given, "exponent", *EXPONENT_RANGE)
        return cls(read_stiffness(given, f"N/m^{exponent:g}"), exponent)

    def scaled(self, length: float, speed: float, force: float) -> "Power":
        """The same law in units of these."""
        return Power(self.stiffness * length**self.exponent / force, self.exponent)

    def force(self, indentation, rate, deepest):
        return self.stiffness * max(indentation, 0.0) ** self.exponent

    def slopes(self, indentation, rate, deepest):
        if indentation <= 0.0:
            return 0.0, 0.0
        return self.exponent * self.stiffness * indentation ** (self.exponent - 1.0), 0.0

    def stored(self, indentation, deepest):
        return self.stiffness * max(indentation, 0.0) ** (self.exponent + 1.0) / (self.exponent + 1.0)

    def dent(self, deepest):
        return 0.0

    unloading = no_memory

    def corner(self, indentation, deepest):
        return math.inf

    def mean(self, start, end, rate, deepest):
        return self.stiffness * power_mean(start, end, self.exponent), 0.0

    def mean_force(self, start, free, compliance, rate, expected, deepest, memory):
        return step_force(self, start, free, compliance, rate, expected, deepest, memory)


class Hertz(NamedTuple):
    """Two smooth elastic bodies that touch in a point. Source: thesis 3.4.1; F = K alpha^(3/2)."""

    stiffness: float  # K_h [N/m^1.5]

    NAME = "hertz"
    EXPONENT = 1.5
    VARIED = {}
    KEYS = ("stiffness",)
    LOSSY = PLASTIC = JUMPS = False
    EXAMPLE = {"stiffness": 1e9}

    def table(self, speed: float) -> dict[str, float]:
        """The constants as in a scene file, for an impact at this speed [m/s]."""
        return {"stiffness": self.stiffness}

    @classmethod
    def read(cls, given: Mapping[str, Any], impactor: Any, target: Any) -> "Hertz":
        return cls(hertz_stiffness(given, impactor, target))

    def limits(self, deepest: float, impactor: Any, target: Any) -> list[Note]:
        """What the law leaves out of an impact as deep as this [m]."""
        return point_limits(deepest, impactor, target, False)

    def scaled(self, length: float, speed: float, force: float) -> "Hertz":
        """The same law in units of these."""
        return Hertz(self.stiffness * length**1.5 / force)

    def force(self, indentation, rate, deepest):
        depth = max(indentation, 0.0)
        return self.stiffness * depth * math.sqrt(depth)

    def slopes(self, indentation, rate, deepest):
        return 1.5 * self.stiffness * math.sqrt(max(indentation, 0.0)), 0.0

    def stored(self, indentation, deepest):
        depth = max(indentation, 0.0)
        return 0.4 * self.stiffness * depth * depth * math.sqrt(depth)

    def dent(self, deepest):
        return 0.0

    unloading = no_memory

    def corner(self, indentation, deepest):
        return math.inf

    def mean(self, start, end, rate, deepest):
        return self.stiffness * hertz_mean(start, end), 0.0

    def mean_force(self, start, free, compliance, rate, expected, deepest, memory):
        force, end = hertz_spring_step(self.stiffness, start, free, compliance, expected)
        return force, end, 0.0, memory
