"""Elastic laws: the force depends on the indentation alone and gives all work back.

Every law answers the same four questions, in SI units:
`force(indentation, rate)` [N], never negative; `slopes(indentation, rate)`, its two partial derivatives;
`work(indentation)` [J], the energy it gives back; and `mean_force`, the force over one step of the modal kernel.
"""

import math
from collections.abc import Mapping
from typing import Any, NamedTuple

from .. import checks
from ..jit import kernel

STIFFNESS_RANGE = (1e-6, 1e20)  # of any law, in its own unit


def read_stiffness(given: Mapping[str, object], unit: str) -> float:
    value = checks.required("contact", given, "stiffness", f"a number from 1e-06 to 1e+20 {unit}")
    return checks.number("contact.stiffness", value, *STIFFNESS_RANGE, unit)


class Rigid(NamedTuple):
    """Both surfaces move as one while they press on each other; no indentation.

    Source: thesis 4.4. `waves` solves it exactly; `modal` gives it the compliance of the modes left out.
    """

    NAME = "rigid"
    KEYS = ()

    def table(self, speed: float) -> dict[str, float]:
        """The constants as in a scene file, for an impact at this speed [m/s]."""
        return {}

    @classmethod
    def read(cls, given: Mapping[str, object], impactor: Any, target: Any) -> "Rigid":
        return cls()


class Linear(NamedTuple):
    """A spring that cannot pull. Source: thesis (7.1)."""

    stiffness: float  # K_l [N/m]

    NAME = "linear"
    KEYS = ("stiffness",)

    def table(self, speed: float) -> dict[str, float]:
        """The constants as in a scene file, for an impact at this speed [m/s]."""
        return {"stiffness": self.stiffness}

    @classmethod
    def read(cls, given: Mapping[str, object], impactor: Any, target: Any) -> "Linear":
        return cls(read_stiffness(given, "N/m"))

    def scaled(self, length: float, speed: float, force: float) -> "Linear":
        """The same law in units of these."""
        return Linear(self.stiffness * length / force)

    def force(self, indentation, rate):
        return self.stiffness * max(indentation, 0.0)

    def slopes(self, indentation, rate):
        return (self.stiffness if indentation > 0.0 else 0.0), 0.0

    def work(self, indentation):
        return 0.5 * self.stiffness * max(indentation, 0.0) ** 2

    def mean_force(self, start, free, compliance, residual, rate, expected):
        """See `hertz_mean_force`; for a spring each case is a linear or quadratic equation."""
        if start <= 0.0 and free <= 0.0:
            return 0.0, free, 0.0
        stretch = 1.0 + residual * self.stiffness  # closing of the whole for the law's own indentation
        if start <= 0.0:  # touches within the step: (free - end)(end - start) = compliance * stiffness * end^2 / 2
            stiffness = self.stiffness / stretch
            square, half = 1.0 + 0.5 * compliance * stiffness, 0.5 * (free + start)
            root = math.sqrt(half * half - square * free * start)
            end = (half + root) / square if half > 0.0 else -free * start / (root - half)
            return (free - end) / compliance, end / stretch, 0.0
        begin = start * stretch
        force = self.stiffness * (begin + free) / (2.0 * stretch + self.stiffness * compliance)
        end = free - compliance * force
        if end >= 0.0:
            return force, (end if residual == 0.0 else end / stretch), 0.0
        # leaves within the step: all that is stored is given back on the way
        half, stored = 0.5 * (begin - free), 0.5 * self.stiffness * start * begin
        root = math.sqrt(half * half + compliance * stored)
        force = stored / (half + root) if half > 0.0 else (root - half) / compliance
        return force, free - compliance * force, 0.0


class Hertz(NamedTuple):
    """Two smooth elastic bodies that touch in a point. Source: thesis 3.4.1; F = K alpha^(3/2).

    Differs: thesis (7.6) prints K for two bodies of one material; a rigid partner has twice that.
    """

    stiffness: float  # K_h [N/m^1.5]

    NAME = "hertz"
    KEYS = ("stiffness",)

    def table(self, speed: float) -> dict[str, float]:
        """The constants as in a scene file, for an impact at this speed [m/s]."""
        return {"stiffness": self.stiffness}

    @classmethod
    def read(cls, given: Mapping[str, object], impactor: Any, target: Any) -> "Hertz":
        return cls(hertz_stiffness(given, impactor, target))

    def scaled(self, length: float, speed: float, force: float) -> "Hertz":
        """The same law in units of these."""
        return Hertz(self.stiffness * length**1.5 / force)

    def force(self, indentation, rate):
        depth = max(indentation, 0.0)
        return self.stiffness * depth * math.sqrt(depth)

    def slopes(self, indentation, rate):
        return 1.5 * self.stiffness * math.sqrt(max(indentation, 0.0)), 0.0

    def work(self, indentation):
        depth = max(indentation, 0.0)
        return 0.4 * self.stiffness * depth * depth * math.sqrt(depth)

    def mean_force(self, start, free, compliance, residual, rate, expected):
        return hertz_mean_force(self.stiffness, 0.0, start, free, compliance, residual, rate, expected)


def hertz_stiffness(given: Mapping[str, object], impactor: Any, target: Any) -> float:
    """K_h [N/m^1.5]: as given, or 4/3 E* sqrt(R) for the impactor's radius on the flat end of the target."""
    if "stiffness" in given:
        return read_stiffness(given, "N/m^1.5")
    if impactor.radius is None:
        allowed = "a number from 1e-06 to 1e+20 N/m^1.5, or impactor.radius to derive it from (both are missing)"
        raise checks.SceneError("contact.stiffness", None, allowed)
    contact_modulus = 1.0 / (1.0 / impactor.material.plane_modulus + 1.0 / target.material.plane_modulus)
    return 4.0 / 3.0 * contact_modulus * math.sqrt(impactor.radius)


@kernel
def hertz_mean_force(stiffness, loss, start, free, compliance, residual, rate, expected):
    """The constant force of one step whose work is exactly what the contact takes up.

    The contact is F = stiffness * a^(3/2) * (1 + loss * da/dt) in series with a spring of compliance `residual`; the
    whole closes by d = a + residual * F_elastic. `start` is a at the start (negative: the gap), `free` is d at the
    end if there were no force, and a force F makes it free - compliance * F; `rate` is 1 / step. Then F = (stored
    energy gained) / (d gained), times the loss factor: one increasing equation in a at the end, solved to rounding.
    `expected` is a guess of the force. Returns the force, a at the end, and the energy lost to the law's damping.
    """
    if start <= 0.0 and free <= 0.0:
        return 0.0, free, 0.0
    root0 = math.sqrt(max(start, 0.0))
    square0 = root0 * root0
    force0 = stiffness * square0 * root0
    begin = start + residual * force0  # d at the start
    stored = 0.4 * force0 * start + 0.5 * residual * force0 * force0
    if start > 0.0 and free * begin < compliance * stored:  # leaves within the step, if damping lets it
        spread = compliance * stored
        half = 0.5 * (begin - free - spread * loss * rate)
        spread *= 1.0 + loss * (begin - start) * rate
        root = math.sqrt(half * half + spread)
        travel = half + root if half > 0.0 else spread / (root - half)  # of d
        force = stored / travel * max(1.0 - loss * (travel - begin + start) * rate, 0.0)
        end = free - compliance * force
        if end <= 0.0:
            return force, end, stored + force * (end - begin)
    slope = 1.5 * stiffness * root0
    end = start + (free - compliance * expected - begin) / (1.0 + residual * slope)
    low, high = 0.0, free
    if not low < end < high:
        end = 0.5 * high
    before, miss_before, force, lost = end, 0.0, 0.0, 0.0
    close_enough = 2.0e-16 * (abs(free) + abs(begin))
    for iteration in range(200):
        root1 = math.sqrt(end)
        force1 = stiffness * end * root1
        close = end + residual * force1
        if start > 0.0:  # chords of work and force over [start, end], written without the differences that cancel
            cross, square = root0 * root1, root0 * root0 + root1 * root1
            chord = stiffness * (square + cross)
            elastic = 0.4 * stiffness * (square * (square + cross) - cross * cross)
            elastic = (elastic + 0.5 * residual * (force0 + force1) * chord) / (root0 + root1 + residual * chord)
        else:
            elastic = (0.4 * force1 * end + 0.5 * residual * force1 * force1) / (close - begin)
        factor = max(1.0 + loss * (end - start) * rate, 0.0)
        force = elastic * factor
        lost = (force - elastic) * (close - begin)
        miss = close - free + compliance * force
        if miss > 0.0:
            high = end
        else:
            low = end
        if abs(miss) <= close_enough or high - low <= 2.0e-16 * high:
            break
        slope = 1.5 * stiffness * root1
        tangent = 1.0 + residual * slope + compliance * (0.5 * slope * factor + elastic * loss * rate)
        following = end - miss / tangent
        if iteration > 3:  # the tangent is only nearly right; when that is not enough, the secant and halving are
            difference = miss - miss_before
            following = end - miss * (end - before) / difference if difference != 0.0 else low
            if iteration % 4 == 0:
                following = 0.5 * (low + high)
        if not low < following < high:
            following = 0.5 * (low + high)
        before, miss_before = end, miss
        if following == end:
            break
        end = following
    return force, end, lost
