"""Contact laws without the names by which a method would know their closed forms."""

import math
from typing import NamedTuple

from solvers.contact import elastic

MASS, SPEED, STIFFNESS = 0.2, 2.03, 6.92e9  # of the ball of thesis 10.2


def no_limits(self, deepest, impactor, target):
    return []


class Power(NamedTuple):
    """F = K a^n, without the names by which the method would know its closed form."""

    stiffness: float
    exponent: float

    NAME, LOSSY, PLASTIC = "some power", False, False
    EXPONENT, VARIED, KEYS, JUMPS = elastic.Power.EXPONENT, {}, elastic.Power.KEYS, False
    limits, read, table, scaled = no_limits, elastic.Power.read, elastic.Power.table, elastic.Power.scaled
    slopes, unloading, mean_force = elastic.Power.slopes, elastic.Power.unloading, elastic.Power.mean_force

    def force(self, indentation, rate, deepest):
        return self.stiffness * max(indentation, 0.0) ** self.exponent

    def stored(self, indentation, deepest):
        return self.force(indentation, 0.0, 0.0) * max(indentation, 0.0) / (self.exponent + 1.0)

    def mean(self, start, end, rate, deepest):
        if start == end:
            return self.force(start, rate, deepest), 0.0
        return (self.stored(end, 0.0) - self.stored(start, 0.0)) / (end - start), 0.0

    def dent(self, deepest):
        return 0.0

    def corner(self, indentation, deepest):
        return math.inf
