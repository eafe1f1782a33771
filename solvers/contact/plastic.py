"""Laws that leave a dent: the material flows at the contact, and what it has taken up is gone.

Loading follows the virgin curve; unloading, and loading again, one elastic curve up to the deepest indentation so far,
beyond which plastic loading goes on. The surfaces part at the dent left behind, and meet again there: the memory
outlives the contact. Forgetting the dent, or yielding again from the old indentation, would create energy or lose it
twice.
"""

import math
from collections.abc import Mapping
from functools import lru_cache
from typing import Any, NamedTuple

from .. import validation
from ..jit.kernels import kernel
from ..text.notes import Note, Severity
from .constants import LENGTH_RANGE, YIELD_VARIED, approach_speed, hertz_stiffness, point_limits, yield_indentation
from .discrete_gradient import hertz_mean, power_mean, step_force
from .halving import root_between
from .plastic_steps import plastic_step

FULL_OVER_FIRST_YIELD = 3200.0 / (1.6 * math.pi) ** 2  # alpha_fp / alpha_Y, (7.26)
FULL_RANGE = (30.0, 1e5)  # of that ratio: below it no exponent up to Hertz's 3/2 meets both criteria of (7.34)
JOHNSON = 5.5  # secant stiffness from first to full yield, over F_Y / alpha_Y, (7.31)


@kernel
def hysteretic_mean(law, start, end, deepest):
    """Mean force along a straight path with memory, and the energy lost on it."""
    top = max(start, deepest)
    if end <= top:
        return law.unloading_mean(start, end, top), 0.0
    on = law.loading_mean(top, end) * (end - top)
    lost = 0.0 if end <= law.yield_indentation else on - (law.stored(end, end) - law.stored(top, top))
    if start < top:
        return (law.unloading_mean(start, top, top) * (top - start) + on) / (end - start), lost
    return on / (end - start), lost


@kernel
def line_force(stiffness, begins, indentation):
    """The virgin curve of Hertz up to yield and its tangent beyond, (7.5), (7.8), (7.9)."""
    root = math.sqrt(min(max(indentation, 0.0), begins))
    return stiffness * root * (root * root + 1.5 * max(indentation - begins, 0.0))


@kernel
def line_mean(stiffness, begins, start, end):
    """Its mean over [start, end]."""
    if end <= begins:
        return stiffness * hertz_mean(start, end)
    if start >= begins:
        return line_force(stiffness, begins, 0.5 * (start + end))
    straight = line_force(stiffness, begins, 0.5 * (begins + end)) * (end - begins)
    return (stiffness * hertz_mean(start, begins) * (begins - start) + straight) / (end - start)


@kernel
def raised_dent(begins, deepest):
    """dent^(3/2) after unloading on Hertz's curve shifted down, without differences that cancel next to yield."""
    if deepest <= begins:
        return 0.0
    ratio = math.sqrt(deepest / begins)
    above = (deepest - begins) / (begins * (ratio + 1.0))  # ratio - 1
    return begins * math.sqrt(begins) * above * above * (ratio + 0.5)


class YigitChristoforou(NamedTuple):
    """Hertz up to yield, then a straight line along its tangent; unloading is Hertz's curve shifted down.

    Source: thesis 7.3.3, (7.5)-(7.10).
    Differs: (7.12) is printed with K_h / K_Y, and as a function of the present indentation; the dent is
    [alpha_m^1.5 - alpha_Y^1.5 - (K_Y / K_h)(alpha_m - alpha_Y)]^(2/3). (7.7) gives a yield indentation 6 % larger.
    Error: the shifted curve is steeper than any elastic contact: too large a dent and too little rebound.
    """

    stiffness: float  # K_h [N/m^1.5]
    yield_indentation: float  # alpha_Y [m]

    NAME = "yigit-christoforou"
    EXPONENT = 1.5
    VARIED = {"yield_indentation": YIELD_VARIED}
    KEYS = ("stiffness", "yield_indentation")
    LOSSY, PLASTIC, JUMPS = False, True, False
    EXAMPLE = {"stiffness": 1e9, "yield_indentation": 1e-7}

    def limits(self, deepest: float, impactor: Any, target: Any) -> list[Note]:
        """What the law leaves out of an impact as deep as this [m]."""
        return point_limits(deepest, impactor, target, True)

    def table(self, speed: float) -> dict[str, float]:
        """The constants as in a scene file, for an impact at this speed [m/s]."""
        return {"stiffness": self.stiffness, "yield_indentation": self.yield_indentation}

    @classmethod
    def read(cls, given: Mapping[str, Any], impactor: Any, target: Any) -> "YigitChristoforou":
        return cls(hertz_stiffness(given, impactor, target), yield_indentation(given, impactor, target))

    def scaled(self, length: float, speed: float, force: float) -> "YigitChristoforou":
        """The same law in units of these."""
        return self._replace(
            stiffness=self.stiffness * length**1.5 / force, yield_indentation=self.yield_indentation / length
        )

    def force(self, indentation, rate, deepest):
        if indentation >= deepest:
            return line_force(self.stiffness, self.yield_indentation, indentation)
        depth = max(indentation, 0.0)
        return self.stiffness * max(depth * math.sqrt(depth) - raised_dent(self.yield_indentation, deepest), 0.0)

    def slopes(self, indentation, rate, deepest):
        depth = max(indentation, 0.0)
        if indentation >= deepest:
            depth = min(depth, self.yield_indentation)
        elif depth * math.sqrt(depth) <= raised_dent(self.yield_indentation, deepest):
            return 0.0, 0.0
        return 1.5 * self.stiffness * math.sqrt(depth), 0.0

    def stored(self, indentation, deepest):
        raised = raised_dent(self.yield_indentation, max(indentation, deepest))
        dent = raised ** (2.0 / 3.0)
        if indentation <= dent:
            return 0.0
        return self.stiffness * (indentation - dent) * max(hertz_mean(dent, indentation) - raised, 0.0)

    def dent(self, deepest):
        return raised_dent(self.yield_indentation, deepest) ** (2.0 / 3.0)

    def corner(self, indentation, deepest):
        begins = max(self.yield_indentation, deepest)
        return begins if indentation < begins else math.inf

    def loading_mean(self, start, end):
        return line_mean(self.stiffness, self.yield_indentation, start, end)

    def unloading_mean(self, start, end, deepest):
        raised = raised_dent(self.yield_indentation, deepest)
        low, high = min(start, end), max(start, end)
        dent = raised ** (2.0 / 3.0)
        if high <= dent:
            return 0.0
        if low >= dent:
            return self.stiffness * max(hertz_mean(low, high) - raised, 0.0)
        return self.stiffness * max(hertz_mean(dent, high) - raised, 0.0) * ((high - dent) / (high - low))

    def mean(self, start, end, rate, deepest):
        return hysteretic_mean(self, start, end, deepest)

    def unloading(self, deepest):
        """Where it opens, and by how much Hertz's curve is shifted."""
        raised = raised_dent(self.yield_indentation, deepest)
        return raised ** (2.0 / 3.0), raised

    def mean_force(self, start, free, compliance, rate, expected, deepest, memory):
        return step_force(self, start, free, compliance, rate, expected, deepest, memory)


@kernel
def line_dent(stiffness, begins, deepest):
    """(7.15)"""
    if deepest <= begins:
        return 0.0
    return max(deepest - (line_force(stiffness, begins, deepest) / stiffness) ** (2.0 / 3.0), 0.0)


class PlasticLinear(NamedTuple):
    """Hertz up to yield, then a straight line along its tangent; unloading is Hertz from the dent left behind.

    Source: thesis 7.3.4, (7.11)-(7.16).
    Differs: (7.16) prints alpha_Y < alpha < alpha_m for the unloading; it reaches down to the dent.
    Error: the tangent at first yield is a quarter of what experiments give at full flow, (7.31): too soft beyond some
    ten times the yield indentation, where 'plastic-power' is the better law.
    """

    stiffness: float  # K_h [N/m^1.5]
    yield_indentation: float  # alpha_Y [m]

    NAME = "plastic-linear"
    EXPONENT = 1.5
    VARIED = {"yield_indentation": YIELD_VARIED}
    KEYS = ("stiffness", "yield_indentation")
    LOSSY, PLASTIC, JUMPS = False, True, False
    EXAMPLE = {"stiffness": 1e9, "yield_indentation": 1e-7}

    limits, table = YigitChristoforou.limits, YigitChristoforou.table
    scaled, corner = YigitChristoforou.scaled, YigitChristoforou.corner
    loading_mean, mean = YigitChristoforou.loading_mean, YigitChristoforou.mean

    @classmethod
    def read(cls, given: Mapping[str, Any], impactor: Any, target: Any) -> "PlasticLinear":
        return cls(hertz_stiffness(given, impactor, target), yield_indentation(given, impactor, target))

    def force(self, indentation, rate, deepest):
        if indentation >= deepest:
            return line_force(self.stiffness, self.yield_indentation, indentation)
        depth = max(indentation - line_dent(self.stiffness, self.yield_indentation, deepest), 0.0)
        return self.stiffness * depth * math.sqrt(depth)

    def slopes(self, indentation, rate, deepest):
        if indentation >= deepest:
            depth = min(max(indentation, 0.0), self.yield_indentation)
        else:
            depth = max(indentation - line_dent(self.stiffness, self.yield_indentation, deepest), 0.0)
        return 1.5 * self.stiffness * math.sqrt(depth), 0.0

    def stored(self, indentation, deepest):
        dent = line_dent(self.stiffness, self.yield_indentation, max(indentation, deepest))
        depth = max(indentation - dent, 0.0)
        return 0.4 * self.stiffness * depth * depth * math.sqrt(depth)

    def dent(self, deepest):
        return line_dent(self.stiffness, self.yield_indentation, deepest)

    def unloading(self, deepest):
        return line_dent(self.stiffness, self.yield_indentation, deepest), self.stiffness

    def mean_force(self, start, free, compliance, rate, expected, deepest, memory):
        return plastic_step(self, start, free, compliance, rate, expected, deepest, memory)

    def unloading_mean(self, start, end, deepest):
        dent = line_dent(self.stiffness, self.yield_indentation, deepest)
        return self.stiffness * hertz_mean(start - dent, end - dent)


@lru_cache(maxsize=1000)
def hardening_exponent(ratio: float) -> float:
    """n of (7.34) from alpha_fp / alpha_Y alone: Yigit's tangent at first yield, Johnson's secant up to full flow."""
    return root_between(lambda n: 1.5 * (ratio**n - 1.0) / (n * (ratio - 1.0)) - JOHNSON, 1.0, 1.5)


@kernel
def flow_shift(law):
    """What the power of plastic flow lacks to the force at first yield, where both slopes agree [N]."""
    begins = law.yield_indentation
    return law.stiffness * begins * math.sqrt(begins) * (1.0 - 1.5 / law.exponent)


@kernel
def power_force(law, indentation):
    """The virgin curve, (7.41)."""
    depth = max(indentation, 0.0)
    if depth <= law.yield_indentation:
        return law.stiffness * depth * math.sqrt(depth)
    return law.plastic_stiffness * depth**law.exponent + flow_shift(law)


@kernel
def crater(law, deepest):
    """Dent and stiffness of unloading, (7.38), (7.43), from the contact radius a^2 = widening * deepest * R.

    The widening grows from 1 at first yield to 2 where flow is full, (7.25), and stays there.
    """
    if deepest <= law.yield_indentation:
        return 0.0, law.stiffness
    full = (deepest - law.yield_indentation) / (law.full_indentation - law.yield_indentation)
    root = math.sqrt(deepest * (1.0 + min(full, 1.0)))
    recovered = power_force(law, deepest) / (law.stiffness * root)
    return max(deepest - recovered, 0.0), law.stiffness * root / math.sqrt(recovered)


class PlasticPower(NamedTuple):
    """Hertz up to yield, then a power law that follows Tabor's indentation tests; unloading from a flattened crater.

    The power law meets two criteria: Yigit's tangent at first yield and Johnson's secant stiffness, 5.5 F_Y / alpha_Y,
    up to full flow. Unloading is Hertz's law with the larger radius of the crater.
    Source: thesis 7.3.5, (7.22)-(7.43); exponent and stiffness follow from the ratio of the two indentations.
    Differs: (7.24) prints a_fp^2 = alpha_fp R for 2 alpha_fp R; (7.26) prints pi in alpha_fp = 3200 R (sigma_Y / E')^2;
    (7.39), (7.42) are printed with the line of 7.3.4 and with alpha_Y for the dent: (7.43) and (7.40) hold. The thesis
    says nothing beyond full flow: here the contact radius stays at a^2 = 2 alpha R and the force goes on along the same
    power law, so that dent and stiffness of unloading have a kink there.
    """

    stiffness: float  # K_h [N/m^1.5]
    yield_indentation: float  # alpha_Y [m]
    full_indentation: float  # alpha_fp [m], where flow is full
    exponent: float  # n
    plastic_stiffness: float  # K_hY [N/m^n]

    NAME = "plastic-power"
    EXPONENT = 1.5
    VARIED = {"yield_indentation": YIELD_VARIED}
    KEYS = ("stiffness", "yield_indentation", "full_indentation")
    LOSSY, PLASTIC, JUMPS = False, True, False
    EXAMPLE = {"stiffness": 1e9, "yield_indentation": 1e-7}

    mean = YigitChristoforou.mean

    @classmethod
    def read(cls, given: Mapping[str, Any], impactor: Any, target: Any) -> "PlasticPower":
        stiffness, begins = hertz_stiffness(given, impactor, target), yield_indentation(given, impactor, target)
        full = FULL_OVER_FIRST_YIELD * begins
        if "full_indentation" in given:
            full = validation.number("contact.full_indentation", given["full_indentation"], *LENGTH_RANGE, "m")
            validation.number("contact.full_indentation", full, FULL_RANGE[0] * begins, FULL_RANGE[1] * begins, "m")
        return cls.through(stiffness, begins, full)

    @classmethod
    def through(cls, stiffness: float, begins: float, full: float) -> "PlasticPower":
        """The law that meets both criteria of (7.34) between these indentations [m]."""
        exponent = hardening_exponent(full / begins)
        return cls(stiffness, begins, full, exponent, 1.5 * stiffness * begins ** (1.5 - exponent) / exponent)

    def limits(self, deepest: float, impactor: Any, target: Any) -> list[Note]:
        """What the law leaves out of an impact as deep as this [m]."""
        found = point_limits(deepest, impactor, target, True)
        if deepest > self.full_indentation:
            work, most = (depth * self.mean(0.0, depth, 0.0, 0.0)[0] for depth in (deepest, self.full_indentation))
            slower = approach_speed(impactor, target) * math.sqrt(most / work)
            times = deepest / self.full_indentation
            found.append(Note("beyond-full-plasticity", Severity.WARNING, times=times, slower=slower))
        return found

    def table(self, speed: float) -> dict[str, float]:
        """The constants as in a scene file, for an impact at this speed [m/s]."""
        return {name: getattr(self, name) for name in self.KEYS}

    def scaled(self, length: float, speed: float, force: float) -> "PlasticPower":
        """The same law in units of these."""
        return PlasticPower(
            self.stiffness * length**1.5 / force,
            self.yield_indentation / length,
            self.full_indentation / length,
            self.exponent,
            self.plastic_stiffness * length**self.exponent / force,
        )

    def force(self, indentation, rate, deepest):
        if indentation >= deepest:
            return power_force(self, indentation)
        dent, stiffness = crater(self, deepest)
        depth = max(indentation - dent, 0.0)
        return stiffness * depth * math.sqrt(depth)

    def slopes(self, indentation, rate, deepest):
        if indentation >= deepest and indentation > self.yield_indentation:
            return self.exponent * self.plastic_stiffness * indentation ** (self.exponent - 1.0), 0.0
        dent, stiffness = crater(self, deepest)
        return 1.5 * stiffness * math.sqrt(max(indentation - dent, 0.0)), 0.0

    def stored(self, indentation, deepest):
        dent, stiffness = crater(self, max(indentation, deepest))
        depth = max(indentation - dent, 0.0)
        return 0.4 * stiffness * depth * depth * math.sqrt(depth)

    def dent(self, deepest):
        return crater(self, deepest)[0]

    def unloading(self, deepest):
        return crater(self, deepest)

    def mean_force(self, start, free, compliance, rate, expected, deepest, memory):
        return plastic_step(self, start, free, compliance, rate, expected, deepest, memory)

    def corner(self, indentation, deepest):
        begins = max(self.yield_indentation, deepest)
        if indentation < begins:
            return begins
        return self.full_indentation if indentation < self.full_indentation else math.inf

    def loading_mean(self, start, end):
        begins = self.yield_indentation
        if end <= begins:
            return self.stiffness * hertz_mean(start, end)
        low = max(start, begins)
        flow = self.plastic_stiffness * power_mean(low, end, self.exponent) + flow_shift(self)
        if start >= begins:
            return flow
        elastic = self.stiffness * hertz_mean(start, begins) * (begins - start)
        return (elastic + flow * (end - begins)) / (end - start)

    def unloading_mean(self, start, end, deepest):
        dent, stiffness = crater(self, deepest)
        return stiffness * hertz_mean(start - dent, end - dent)
