"""Laws that lose energy by damping: the force depends on the rate of indentation too, and never pulls.

The damping is given by one of three keys: `restitution`, what two free rigid bodies deliver at this impact speed;
`nominal_restitution`, the number in the law's usual formula, which delivers something else; or `damping`, the constant
itself, which belongs to the pair of bodies and stays the same in every contact of an impact.
"""

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

from .. import validation
from ..text.notes import Note
from . import damping as dashpots
from .constants import EXPONENT_RANGE, approach_speed, hertz_stiffness, point_limits, read_stiffness, reduced_mass
from .damping import LEAST_RESTITUTION, damping_for, delivered_restitution, read_damping
from .discrete_gradient import hertz_mean, hertz_step_force, linear_mean, no_memory, power_mean, step_force
from .elastic import Hertz, Linear

__all__ = [
    "LEAST_RESTITUTION",
    "HuntCrossley",
    "KelvinVoigt",
    "LankaraniNikravesh",
    "LeeWang",
    "damping_for",
    "delivered_restitution",
]

KEYS = ("stiffness", "restitution", "nominal_restitution", "damping")


class HuntCrossley(NamedTuple):
    """Hertz with damping that grows with the indentation: F = K alpha^(3/2) (1 + damping * rate), never tensile.

    Source: thesis 7.3.1 (Lee and Wang's condition: no force at first touch); nominal: d = 3 (1 - e) / 2 for the damping
    times the approach speed.
    Differs: that formula holds next to e = 1 only; a nominal 0.5 delivers 0.66, a nominal 0 delivers 0.49.
    """

    stiffness: float  # K_h [N/m^1.5]
    damping: float  # [s/m]

    NAME = "hunt-crossley"
    EXPONENT = 1.5
    VARIED = {}
    KEYS = KEYS
    LOSSY, PLASTIC, JUMPS = True, False, False
    EXAMPLE = {"stiffness": 1e9, "restitution": 0.5}

    limits = Hertz.limits
    stored, dent, unloading, corner = Hertz.stored, Hertz.dent, Hertz.unloading, Hertz.corner

    def table(self, speed: float) -> dict[str, float]:
        """The constants as in a scene file, for an impact at this speed [m/s]."""
        return {"stiffness": self.stiffness, "damping": self.damping}

    @classmethod
    def read(cls, given: Mapping[str, Any], impactor: Any, target: Any) -> "HuntCrossley":
        stiffness = hertz_stiffness(given, impactor, target)
        unit = 1.0 / approach_speed(impactor, target)
        return cls(stiffness, read_damping(given, dashpots.HUNT_CROSSLEY, unit, "s/m"))

    def delivered(self, mass: float, speed: float) -> float:
        """Restitution of two free rigid bodies of this reduced mass [kg] that meet at this speed [m/s]."""
        return dashpots.HUNT_CROSSLEY.delivered(self.damping * speed)

    def nominal(self, mass: float, speed: float) -> float:
        """The restitution that the law's usual formula names for this damping."""
        return dashpots.HUNT_CROSSLEY.nominal(self.damping * speed)

    def scaled(self, length: float, speed: float, force: float) -> "HuntCrossley":
        """The same law in units of these."""
        return self._replace(stiffness=self.stiffness * length**1.5 / force, damping=self.damping * speed)

    def force(self, indentation, rate, deepest):
        depth = max(indentation, 0.0)
        return self.stiffness * depth * math.sqrt(depth) * max(1.0 + self.damping * rate, 0.0)

    def slopes(self, indentation, rate, deepest):
        root = math.sqrt(max(indentation, 0.0))
        factor = 1.0 + self.damping * rate
        if factor <= 0.0:
            return 0.0, 0.0
        return 1.5 * self.stiffness * root * factor, self.stiffness * root**3 * self.damping

    def mean(self, start, end, rate, deepest):
        elastic, factor = self.stiffness * hertz_mean(start, end), max(1.0 + self.damping * (end - start) * rate, 0.0)
        return elastic * factor, elastic * (factor - 1.0) * (end - start)

    def mean_force(self, start, free, compliance, rate, expected, deepest, memory):
        force, end, lost = hertz_step_force(self.stiffness, self.damping, start, free, compliance, rate, expected)
        return force, end, lost, memory


class LankaraniNikravesh(NamedTuple):
    """The force of Hunt and Crossley, with another formula for its damping: d = 3 (1 - e^2) / 4.

    Source: Lankarani and Nikravesh (1990), of the family of thesis 7.3.1. Asked for the same delivered restitution it
    is the same law.
    Differs: its formula too holds next to e = 1 only; a nominal 0.5 delivers 0.73, a nominal 0 delivers 0.66.
    """

    stiffness: float  # K_h [N/m^1.5]
    damping: float  # [s/m]

    NAME = "lankarani-nikravesh"
    EXPONENT = 1.5
    VARIED = {}
    KEYS = KEYS
    LOSSY, PLASTIC, JUMPS = True, False, False
    EXAMPLE = {"stiffness": 1e9, "nominal_restitution": 0.5}

    limits, table, scaled = Hertz.limits, HuntCrossley.table, HuntCrossley.scaled
    stored, dent, unloading, corner = Hertz.stored, Hertz.dent, Hertz.unloading, Hertz.corner
    force, slopes, mean, mean_force = (
        HuntCrossley.force,
        HuntCrossley.slopes,
        HuntCrossley.mean,
        HuntCrossley.mean_force,
    )
    delivered = HuntCrossley.delivered

    @classmethod
    def read(cls, given: Mapping[str, Any], impactor: Any, target: Any) -> "LankaraniNikravesh":
        stiffness = hertz_stiffness(given, impactor, target)
        unit = 1.0 / approach_speed(impactor, target)
        return cls(stiffness, read_damping(given, dashpots.LANKARANI_NIKRAVESH, unit, "s/m"))

    def nominal(self, mass: float, speed: float) -> float:
        """The restitution that the law's usual formula names for this damping."""
        return dashpots.LANKARANI_NIKRAVESH.nominal(self.damping * speed)


class KelvinVoigt(NamedTuple):
    """A spring and a dashpot side by side, without adhesion: F = K alpha + C rate, never tensile.

    The force jumps to C v at first touch, and the bodies part when it has fallen to zero, before the indentation has.
    Source: thesis 7.3.1; restitution at F = 0, e = exp(-zeta / sqrt(1 - zeta^2) (pi - 2 asin zeta)) with
    zeta = C / (2 sqrt(K m)); nominal: the usual e = exp(-pi zeta / sqrt(1 - zeta^2)).
    Differs: the nominal one lets the bodies pull on each other until the indentation is zero.
    """

    stiffness: float  # K [N/m]
    damping: float  # C [N s/m]

    NAME = "kelvin-voigt"
    EXPONENT = 1.0
    VARIED = {}
    KEYS = KEYS
    LOSSY, PLASTIC, JUMPS = True, False, True
    EXAMPLE = {"stiffness": 1e9, "restitution": 0.5}

    limits, table = Linear.limits, HuntCrossley.table
    stored, dent, unloading, corner = Linear.stored, Linear.dent, Linear.unloading, Linear.corner

    @classmethod
    def read(cls, given: Mapping[str, Any], impactor: Any, target: Any) -> "KelvinVoigt":
        stiffness = read_stiffness(given, "N/m")
        unit = 2.0 * math.sqrt(stiffness * reduced_mass(impactor, target))
        return cls(stiffness, read_damping(given, dashpots.KELVIN_VOIGT, unit, "N s/m"))

    def delivered(self, mass: float, speed: float) -> float:
        """Restitution of two free rigid bodies of this reduced mass [kg] that meet at this speed [m/s]."""
        return dashpots.KELVIN_VOIGT.delivered(self.damping / (2.0 * math.sqrt(self.stiffness * mass)))

    def nominal(self, mass: float, speed: float) -> float:
        """The restitution that the law's usual formula names for this damping."""
        return dashpots.KELVIN_VOIGT.nominal(self.damping / (2.0 * math.sqrt(self.stiffness * mass)))

    def scaled(self, length: float, speed: float, force: float) -> "KelvinVoigt":
        """The same law in units of these."""
        return KelvinVoigt(self.stiffness * length / force, self.damping * speed / force)

    def force(self, indentation, rate, deepest):
        return max(self.stiffness * indentation + self.damping * rate, 0.0) if indentation > 0.0 else 0.0

    def slopes(self, indentation, rate, deepest):
        if indentation <= 0.0 or self.stiffness * indentation + self.damping * rate <= 0.0:
            return 0.0, 0.0
        return self.stiffness, self.damping

    def mean(self, start, end, rate, deepest):
        elastic = self.stiffness * linear_mean(start, end)
        push = self.damping * (end - start) * rate
        if push >= 0.0:
            part = 1.0 if start >= 0.0 else max(end, 0.0) / (end - start) if end > start else 0.0
            return elastic + push * part, push * part * (end - start)
        silent = -push / self.stiffness  # up to this indentation the dashpot outweighs the spring
        force = self.stiffness * linear_mean(start - silent, end - silent)
        return force, (force - elastic) * (end - start)

    def mean_force(self, start, free, compliance, rate, expected, deepest, memory):
        return step_force(self, start, free, compliance, rate, expected, deepest, memory)


class LeeWang(NamedTuple):
    """A power law with a dashpot that grows with the indentation: F = K alpha^n + C alpha rate, never tensile.

    Source: thesis (7.3), Lee and Wang (1983); nominal: the loss along the path without damping,
    e = 1 - 2 C alpha_m^2 B(2/p, 3/2) / (p m v), p = n + 1, as Hunt and Crossley take theirs.
    Differs: (7.3) prints C alpha sgn(rate) rate, which pushes both ways: its loop has no area and loses nothing.
    """

    stiffness: float  # K [N/m^n]
    damping: float  # C [N s/m^2]
    exponent: float = 1.5  # n

    NAME = "lee-wang"
    EXPONENT = None
    VARIED = {"exponent": (1.5, *EXPONENT_RANGE)}
    KEYS = (*KEYS, "exponent")
    LOSSY, PLASTIC, JUMPS = True, False, False
    EXAMPLE = {"stiffness": 1e9, "restitution": 0.5}

    def limits(self, deepest: float, impactor: Any, target: Any) -> list[Note]:
        """What the law leaves out of an impact as deep as this [m]."""
        return point_limits(deepest, impactor, target, False) if self.exponent == 1.5 else []

    def table(self, speed: float) -> dict[str, float]:
        """The constants as in a scene file, for an impact at this speed [m/s]."""
        return {"stiffness": self.stiffness, "damping": self.damping, "exponent": self.exponent}

    @classmethod
    def read(cls, given: Mapping[str, Any], impactor: Any, target: Any) -> "LeeWang":
        exponent = validation.number("contact.exponent", given.get("exponent", 1.5), *EXPONENT_RANGE)
        if exponent == 1.5:
            stiffness = hertz_stiffness(given, impactor, target)
        else:
            stiffness = read_stiffness(given, f"N/m^{exponent:g}")
        law = cls(stiffness, 0.0, exponent)
        unit = law._unit(reduced_mass(impactor, target), approach_speed(impactor, target))
        return law._replace(damping=read_damping(given, dashpots.lee_wang(exponent), unit, "N s/m^2"))

    def _unit(self, mass: float, speed: float) -> float:
        """The damping [N s/m^2] of a dashpot number of one."""
        length = (mass * speed**2 / self.stiffness) ** (1.0 / (self.exponent + 1.0))
        return self.stiffness * length ** (self.exponent - 1.0) / speed

    def delivered(self, mass: float, speed: float) -> float:
        """Restitution of two free rigid bodies of this reduced mass [kg] that meet at this speed [m/s]."""
        return dashpots.lee_wang(self.exponent).delivered(self.damping / self._unit(mass, speed))

    def nominal(self, mass: float, speed: float) -> float:
        """The restitution that the loss along the path without damping gives."""
        return dashpots.lee_wang(self.exponent).nominal(self.damping / self._unit(mass, speed))

    def scaled(self, length: float, speed: float, force: float) -> "LeeWang":
        """The same law in units of these."""
        return LeeWang(
            self.stiffness * length**self.exponent / force, self.damping * length * speed / force, self.exponent
        )

    def force(self, indentation, rate, deepest):
        depth = max(indentation, 0.0)
        return max(self.stiffness * depth**self.exponent + self.damping * depth * rate, 0.0)

    def slopes(self, indentation, rate, deepest):
        if indentation <= 0.0:
            return 0.0, 0.0
        secant = self.stiffness * indentation ** (self.exponent - 1.0)
        if secant + self.damping * rate <= 0.0:
            return 0.0, 0.0
        return self.exponent * secant + self.damping * rate, self.damping * indentation

    def stored(self, indentation, deepest):
        return self.stiffness * max(indentation, 0.0) ** (self.exponent + 1.0) / (self.exponent + 1.0)

    def dent(self, deepest):
        return 0.0

    unloading = no_memory

    def corner(self, indentation, deepest):
        return math.inf

    def mean(self, start, end, rate, deepest):
        elastic = self.stiffness * power_mean(start, end, self.exponent)
        push = self.damping * (end - start) * rate
        if push >= 0.0:
            damped = push * linear_mean(start, end)
            return elastic + damped, damped * (end - start)
        # up to `silent` the dashpot outweighs the spring
        if self.exponent > 1.0:
            silent = (-push / self.stiffness) ** (1.0 / (self.exponent - 1.0))
        else:
            silent = 0.0 if -push < self.stiffness else math.inf
        if start <= max(silent, 0.0):
            return 0.0, -elastic * (end - start)
        low = max(silent, end)
        force = self.stiffness * power_mean(low, start, self.exponent) + push * linear_mean(low, start)
        force = max(force * ((start - low) / (start - end)), 0.0)
        return force, (force - elastic) * (end - start)

    def mean_force(self, start, free, compliance, rate, expected, deepest, memory):
        return step_force(self, start, free, compliance, rate, expected, deepest, memory)
