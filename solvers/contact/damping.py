"""What restitution a dashpot delivers, by a number without unit for each kind of dashpot, and the way back."""

import math
from collections.abc import Callable, Mapping
from functools import lru_cache, partial
from typing import Any, NamedTuple

from numba.extending import register_jitable

from .. import validation
from .halving import root_between

LEAST_RESTITUTION = 0.01  # delivered: below it the bodies creep apart over hundreds of contact times


class Dashpot(NamedTuple):
    """One kind of dashpot: restitution from its number and back, as delivered and by the usual formula (nominal)."""

    delivered: Callable[[float], float]
    number: Callable[[float], float]  # that delivers this restitution
    nominal: Callable[[float], float]
    nominal_number: Callable[[float], float]  # to which the usual formula gives this restitution


def read_damping(given: Mapping[str, Any], dashpot: Dashpot, unit: float, unit_name: str) -> float:
    """The damping constant by exactly one of its three keys; `unit`: that of the number one. Raises SceneError."""
    names = [name for name in ("restitution", "nominal_restitution", "damping") if name in given]
    if not names:
        reason = validation.allowed("damping-or", what=validation.a_number(LEAST_RESTITUTION, 1.0).table())
        raise validation.SceneError("contact.restitution", None, reason)
    if len(names) > 1:
        reason = validation.allowed("nothing-beside", other=names[0])
        raise validation.SceneError(f"contact.{names[1]}", given[names[1]], reason)
    name, value = names[0], given[names[0]]
    if name == "restitution":
        return dashpot.number(validation.number("contact.restitution", value, LEAST_RESTITUTION, 1.0)) * unit
    if name == "nominal_restitution":
        return dashpot.nominal_number(validation.number("contact.nominal_restitution", value, 0.0, 1.0)) * unit
    most = dashpot.number(LEAST_RESTITUTION) * unit * (1.0 + 1e-9)  # so that what was written from one can be read
    return validation.number("contact.damping", value, 0.0, most, unit_name)


# --- Hunt and Crossley: F = K a^n (1 + number * rate / approach speed) ------------------------------------------------


def delivered_restitution(damping: float) -> float:
    """Restitution of two free rigid bodies under F = K a^n (1 + damping * rate / approach speed).

    Solves d (1 + e) = ln((1 + d) / (1 - d e)), whatever n, K and the masses: the law's first integral.
    """
    if damping < 1e-4:  # the equation cancels here; this series leaves out d^3
        return 1.0 - 2.0 * damping / 3.0 + 4.0 * damping**2 / 9.0
    # in w = -ln(1 - d e), as d e comes closer to 1 than a double can resolve
    least = damping - math.log1p(damping)
    w = root_between(lambda w: least - math.expm1(-w) - w, 0.0, least + 1.0)
    return -math.expm1(-w) / damping


@register_jitable
def _mismatch(w: float, restitution: float) -> float:
    """Of the law's first integral, in w = -ln(1 - d e)."""
    damping = -math.expm1(-w) / restitution
    return damping * (1.0 + restitution) - math.log1p(damping) - w


@register_jitable
def _hunt_crossley_number(restitution: float) -> float:
    if restitution > 1.0 - 1e-4:
        return 1.5 * (1.0 - restitution)
    least = 0.75 * (1.0 - restitution) * restitution  # half of d e for light damping; w = 0 is a root too
    w = root_between(_mismatch, least, 2.0 + 2.0 / restitution, (restitution,))
    return -math.expm1(-w) / restitution


@lru_cache(maxsize=1000)
def damping_for(restitution: float) -> float:
    """The damping number d = damping * approach speed with which Hunt-Crossley delivers this restitution."""
    return _hunt_crossley_number(restitution)


@register_jitable
def _hunt_crossley_nominal(number: float) -> float:
    return max(1.0 - 2.0 * number / 3.0, 0.0)


@register_jitable
def _lankarani_nikravesh_nominal(number: float) -> float:
    return math.sqrt(max(1.0 - 4.0 * number / 3.0, 0.0))


HUNT_CROSSLEY = Dashpot(
    delivered_restitution, damping_for, _hunt_crossley_nominal, lambda restitution: 1.5 * (1.0 - restitution)
)
LANKARANI_NIKRAVESH = Dashpot(
    delivered_restitution, damping_for, _lankarani_nikravesh_nominal, lambda restitution: 0.75 * (1.0 - restitution**2)
)


# --- Kelvin and Voigt: the number is zeta = C / (2 sqrt(K m)) ---------------------------------------------------------


@register_jitable
def _pulled_free(zeta: float) -> float:
    """Restitution at F = 0: exp(-zeta / sqrt(1 - zeta^2) (pi - 2 asin zeta)), and what that is beyond zeta = 1."""
    if zeta < 1.0:
        root = math.sqrt(1.0 - zeta * zeta)
        angle = math.atan2(root, zeta) / root
    elif zeta == 1.0:
        angle = 1.0
    else:
        root = math.sqrt(zeta * zeta - 1.0)
        angle = math.log1p(zeta - 1.0 + root) / root
    return math.exp(-2.0 * zeta * angle)


@register_jitable
def _pulls_more(zeta: float, restitution: float) -> float:
    return _pulled_free(zeta) - restitution


@register_jitable
def _kelvin_voigt_number(restitution: float) -> float:
    return root_between(_pulls_more, 0.0, 10.0, (restitution,))


@lru_cache(maxsize=1000)
def _zeta_for(restitution: float) -> float:
    return _kelvin_voigt_number(restitution)


@register_jitable
def _full_swing(zeta: float) -> float:
    """exp(-pi zeta / sqrt(1 - zeta^2)): half a swing, to zero indentation."""
    return math.exp(-math.pi * zeta / math.sqrt(1.0 - zeta * zeta)) if zeta < 1.0 else 0.0


def _zeta_for_full_swing(restitution: float) -> float:
    return 1.0 if restitution == 0.0 else -math.log(restitution) / math.hypot(math.pi, math.log(restitution))


KELVIN_VOIGT = Dashpot(_pulled_free, _zeta_for, _full_swing, _zeta_for_full_swing)

# By law, for kernels: the number that delivers a restitution, and what the usual formula calls that number.
OF_KERNELS = {
    "hunt-crossley": (_hunt_crossley_number, _hunt_crossley_nominal),
    "lankarani-nikravesh": (_hunt_crossley_number, _lankarani_nikravesh_nominal),
    "kelvin-voigt": (_kelvin_voigt_number, _full_swing),
}


# --- Lee and Wang: a'' = -(a^n + number * a a') with a'(0) = 1 --------------------------------------------------------


@lru_cache(maxsize=4000)
def _lee_wang_delivered(exponent: float, number: float) -> float:
    """By integration in z = sqrt(a) and dt = 2 z ds, in which the equation is smooth; error about 1e-11."""
    from scipy.integrate import solve_ivp

    def change(_, state):
        z, w = state
        return [w, -2.0 * z * (abs(z) ** (2.0 * exponent) + number * z * z * w)]

    def surfaces_meet(_, state):
        return state[0]

    def force_gone(_, state):
        return max(state[0], 0.0) ** (2.0 * (exponent - 1.0)) + number * state[1]

    for event in (surfaces_meet, force_gone):
        event.terminal, event.direction = True, -1
    run = solve_ivp(
        change, (0.0, 1e6), [0.0, 1.0], method="DOP853", rtol=1e-12, atol=1e-13, events=(surfaces_meet, force_gone)
    )
    return float(-run.y[1, -1])


@lru_cache(maxsize=1000)
def _lee_wang_number(exponent: float, restitution: float) -> float:
    if restitution == 1.0:
        return 0.0
    from scipy.optimize import brentq

    high = 1.0
    while _lee_wang_delivered(exponent, high) > restitution:
        high *= 2.0
    return brentq(lambda number: _lee_wang_delivered(exponent, number) - restitution, 0.0, high, xtol=1e-12, rtol=1e-12)


def lee_wang(exponent: float) -> Dashpot:
    """Of a power law with this exponent."""
    whole = exponent + 1.0
    loss = 2.0 * (0.5 * whole) ** (2.0 / whole) / whole  # of energy, by the number, along the path without damping
    loss *= math.gamma(2.0 / whole) * math.gamma(1.5) / math.gamma(2.0 / whole + 1.5)
    return Dashpot(
        partial(_lee_wang_delivered, exponent),
        partial(_lee_wang_number, exponent),
        lambda number: max(1.0 - loss * number, 0.0),
        lambda restitution: (1.0 - restitution) / loss,
    )
