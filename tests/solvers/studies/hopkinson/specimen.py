"""A specimen as a contact law of the tests' own: without mass, elastic up to yield, then a flatter line."""

import math
from typing import NamedTuple

from solvers.contact import Power
from solvers.jit.kernels import kernel


@kernel
def virgin(stiffness, hardening, begins, indentation):
    """Force when first loaded."""
    return stiffness * max(min(indentation, begins), 0.0) + hardening * max(indentation - begins, 0.0)


@kernel
def work(stiffness, hardening, begins, indentation):
    """Of that force."""
    elastic, beyond = max(min(indentation, begins), 0.0), max(indentation - begins, 0.0)
    return 0.5 * stiffness * elastic**2 + stiffness * begins * beyond + 0.5 * hardening * beyond**2


@kernel
def line_mean(stiffness, dent, start, end):
    """Mean of stiffness * max(x - dent, 0) over a way."""
    low, high = min(start, end), max(start, end)
    if high <= dent:
        return 0.0
    if low >= dent:
        return stiffness * (0.5 * (low + high) - dent)
    return 0.5 * stiffness * (high - dent) ** 2 / (high - low)


class Bilinear(NamedTuple):
    """It unloads along the elastic line from the dent that it keeps."""

    stiffness: float  # [N/m]
    hardening: float  # [N/m]
    yield_indentation: float  # [m]

    NAME = "bilinear"
    EXPONENT = 1.0
    VARIED = {}
    KEYS = ("stiffness", "hardening", "yield_indentation")
    LOSSY, PLASTIC, JUMPS = False, True, False

    @classmethod
    def read(cls, given, impactor, target):
        return cls(*(float(given[key]) for key in cls.KEYS))

    def table(self, speed):
        return self._asdict()

    def limits(self, deepest, impactor, target):
        return []

    def scaled(self, length, speed, force):
        per = length / force
        return Bilinear(self.stiffness * per, self.hardening * per, self.yield_indentation / length)

    def force(self, indentation, rate, deepest):
        if indentation >= deepest:
            return virgin(self.stiffness, self.hardening, self.yield_indentation, indentation)
        peak = virgin(self.stiffness, self.hardening, self.yield_indentation, deepest)
        return max(peak - self.stiffness * (deepest - indentation), 0.0)

    def slopes(self, indentation, rate, deepest):
        if indentation >= deepest:
            slope = self.hardening if indentation > self.yield_indentation else self.stiffness
            return (slope if indentation > 0.0 else 0.0), 0.0
        peak = virgin(self.stiffness, self.hardening, self.yield_indentation, deepest)
        return (self.stiffness if indentation > deepest - peak / self.stiffness else 0.0), 0.0

    def stored(self, indentation, deepest):
        top = max(indentation, deepest)
        peak = virgin(self.stiffness, self.hardening, self.yield_indentation, top)
        return 0.5 * max(peak - self.stiffness * (top - indentation), 0.0) ** 2 / self.stiffness

    def dent(self, deepest):
        peak = virgin(self.stiffness, self.hardening, self.yield_indentation, deepest)
        return max(deepest, 0.0) - peak / self.stiffness

    def corner(self, indentation, deepest):
        begins = max(self.yield_indentation, deepest)
        return begins if indentation < begins else math.inf

    def mean(self, start, end, rate, deepest):
        stiffness, hardening, begins = self.stiffness, self.hardening, self.yield_indentation
        top = max(start, deepest)
        held = virgin(stiffness, hardening, begins, top)
        dent = max(top, 0.0) - held / stiffness
        if end <= top:
            return line_mean(stiffness, dent, start, end), 0.0
        on = work(stiffness, hardening, begins, end) - work(stiffness, hardening, begins, top)
        reached = virgin(stiffness, hardening, begins, end)
        lost = 0.0 if end <= begins else on - 0.5 * (reached**2 - held**2) / stiffness
        if start < top:
            on += line_mean(stiffness, dent, start, top) * (top - start)
        return on / (end - start), lost

    def unloading(self, deepest):
        peak = virgin(self.stiffness, self.hardening, self.yield_indentation, deepest)
        return max(deepest, 0.0) - peak / self.stiffness, 0.0

    mean_force = Power.mean_force
