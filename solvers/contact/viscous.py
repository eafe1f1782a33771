"""Laws that lose energy by damping: the force depends on the rate of indentation too."""

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

from .. import checks
from .constants import approach_speed, hertz_stiffness
from .steps import hertz_mean, hertz_step_force

LEAST_RESTITUTION = 0.01  # delivered by Hunt-Crossley: below it the bodies creep apart over hundreds of contact times


class HuntCrossley(NamedTuple):
    """Hertz with damping that grows with the indentation: F = K alpha^(3/2) (1 + loss * rate), never tensile.

    `loss` is a constant of the material pair: the same in every contact period of a blow.
    Source: thesis 7.3.1 (Lee and Wang's condition: no force at first touch).
    """

    stiffness: float  # K_h [N/m^1.5]
    loss: float  # [s/m]

    NAME = "hunt-crossley"
    KEYS = ("stiffness", "restitution")
    LOSSY, PLASTIC, JUMPS = True, False, False
    EXAMPLE = {"stiffness": 1e9, "restitution": 0.5}

    def table(self, speed: float) -> dict[str, float]:
        """The constants as in a scene file, for an impact at this speed [m/s]."""
        return {"stiffness": self.stiffness, "restitution": delivered_restitution(self.loss * speed)}

    @classmethod
    def read(cls, given: Mapping[str, object], impactor: Any, target: Any) -> "HuntCrossley":
        wanted = checks.required("contact", given, "restitution", f"a number from {LEAST_RESTITUTION} to 1")
        wanted = checks.number("contact.restitution", wanted, LEAST_RESTITUTION, 1.0)
        return cls(hertz_stiffness(given, impactor, target), damping_for(wanted) / approach_speed(impactor, target))

    def scaled(self, length: float, speed: float, force: float) -> "HuntCrossley":
        """The same law in units of these."""
        return HuntCrossley(self.stiffness * length**1.5 / force, self.loss * speed)

    def force(self, indentation, rate, deepest):
        depth = max(indentation, 0.0)
        return self.stiffness * depth * math.sqrt(depth) * max(1.0 + self.loss * rate, 0.0)

    def slopes(self, indentation, rate, deepest):
        root = math.sqrt(max(indentation, 0.0))
        factor = 1.0 + self.loss * rate
        if factor <= 0.0:
            return 0.0, 0.0
        return 1.5 * self.stiffness * root * factor, self.stiffness * root**3 * self.loss

    def stored(self, indentation, deepest):
        depth = max(indentation, 0.0)
        return 0.4 * self.stiffness * depth * depth * math.sqrt(depth)

    def dent(self, deepest):
        return 0.0

    def corner(self, indentation, deepest):
        return math.inf

    def mean(self, start, end, rate, deepest):
        elastic, factor = self.stiffness * hertz_mean(start, end), max(1.0 + self.loss * (end - start) * rate, 0.0)
        return elastic * factor, elastic * (factor - 1.0) * (end - start)

    def mean_force(self, start, free, compliance, rate, expected, deepest):
        return hertz_step_force(self.stiffness, self.loss, start, free, compliance, rate, expected)


def delivered_restitution(damping: float) -> float:
    """Restitution of two free rigid bodies under F = K a^n (1 + damping * rate / approach speed).

    Solves d (1 + e) = ln((1 + d) / (1 - d e)), whatever n, K and the masses: the law's first integral.
    """
    if damping < 1e-4:  # the equation cancels here; this series leaves out d^3
        return 1.0 - 2.0 * damping / 3.0 + 4.0 * damping**2 / 9.0
    from scipy.optimize import brentq  # here, so that importing the library stays quick

    # in w = -ln(1 - d e), as d e comes closer to 1 than a double can tell
    least = damping - math.log1p(damping)
    w = brentq(lambda w: least - math.expm1(-w) - w, 0.0, least + 1.0, xtol=1e-15)
    return -math.expm1(-w) / damping


def damping_for(restitution: float) -> float:
    """The damping number d = loss * approach speed with which Hunt-Crossley delivers this restitution.

    Differs: the usual d = 3 (1 - e) / 2 delivers 0.66 for a nominal 0.5.
    """
    if restitution > 1.0 - 1e-4:
        return 1.5 * (1.0 - restitution)
    from scipy.optimize import brentq

    def mismatch(w: float) -> float:
        damping = -math.expm1(-w) / restitution
        return damping * (1.0 + restitution) - math.log1p(damping) - w

    least = 0.75 * (1.0 - restitution) * restitution  # half of d e for light damping; w = 0 is a root too
    w = brentq(mismatch, least, 2.0 + 2.0 / restitution, xtol=1e-15)
    return -math.expm1(-w) / restitution
