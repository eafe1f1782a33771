"""Impacts of two bodies along a line, by a solution that shares nothing with the library.

Each body is a model of finite elements of its own, taken apart into modes, which turn exactly between the pushes of the
contact force, by Strang's splitting.
"""

import math
from dataclasses import dataclass
from typing import Any

import numba
import numpy as np
from scipy.linalg import eigh

from solvers import Scene

EXPONENTS = {"linear": 1.0, "kelvin-voigt": 1.0, "hertz": 1.5, "hunt-crossley": 1.5}  # of laws; `power` has its own
MOST_STEPS = 100_000  # by 60 elements; more take fewer, each of which costs more


@dataclass(frozen=True)
class Body:
    """Modes of a body, of mass one: circular frequencies, values where it is struck, of a uniform acceleration, and of
    the mean of its velocity.
    """

    frequencies: np.ndarray
    struck: np.ndarray
    uniform: np.ndarray
    mass: float


@dataclass(frozen=True)
class Found:
    """By the independent solution, or by the library."""

    velocity: float
    peak: float
    touches: int
    late: float  # speed that weight may have given since the last parting [m/s]; infinite: it takes too many steps


def independent(scene: Scene, duration: float, elements: int) -> Found:
    striker = _body(scene.impactor, elements, "free")
    target = _body(scene.target, elements, getattr(scene.target, "support", "free"))
    frequencies = np.concatenate([striker.frequencies, target.frequencies])
    struck = np.concatenate([striker.struck, -target.struck])
    rates = np.concatenate(
        [scene.impactor.velocity * striker.uniform, (getattr(scene.target, "velocity", 0.0) or 0.0) * target.uniform]
    )
    weight = scene.weight_acceleration
    push = np.concatenate([weight * striker.uniform, 0.0 * target.uniform])
    push[np.abs(push) < 1e-9 * np.abs(push).max(initial=0.0)] = 0.0
    drift = np.divide(push, frequencies**2, out=np.zeros_like(push), where=frequencies > 0.0)
    share = float(struck @ struck)
    law = _constants(scene)
    tangent = _tangent(scene, law, striker, target)
    finest = 60.0 / elements
    step = min(0.15 / math.sqrt(tangent * share), 0.04 / max(law[2] * share, 1e-300), duration / 400.0) * finest
    while True:
        if duration / step > MOST_STEPS * finest:
            return Found(0.0, 0.0, 0, math.inf)
        steps = math.ceil(duration / step)
        step = duration / steps
        angles = frequencies * step
        over = np.divide(np.sin(angles), frequencies, out=np.full_like(angles, step), where=frequencies > 0.0)
        turns = np.stack([np.cos(angles), over, frequencies * np.sin(angles)], axis=1)
        still, law_of = np.zeros_like(rates), np.array(law)
        left, peak, touches, slope, stiff = _march(
            turns, frequencies > 0.0, struck, still, rates.copy(), drift, push, steps, step, share, law_of
        )
        finer = min(0.2 / math.sqrt(max(stiff, 1e-300) * share), 0.04 / max(slope * share, 1e-300)) * finest
        if step <= finer:
            break
        step = 0.7 * finer
    velocity = float(left[: len(striker.frequencies)] @ striker.uniform) / striker.mass
    return Found(velocity, peak, touches, weight * step)


def _tangent(scene: Scene, law: tuple[float, ...], striker: Body, target: Body) -> float:
    """Of the law at the depth at which compact bodies of these masses would turn back."""
    mass = 1.0 / (1.0 / striker.mass + 1.0 / target.mass)
    energy = 0.5 * mass * scene.speed**2
    weight = striker.mass * scene.weight_acceleration
    depth = ((law[1] + 1.0) * energy / law[0]) ** (1.0 / (law[1] + 1.0)) + (2.0 * weight / law[0]) ** (1.0 / law[1])
    return law[1] * law[0] * depth ** (law[1] - 1.0)


def _constants(scene: Scene) -> tuple[float, float, float, float]:
    """Stiffness, exponent, dashpot, and the factor of the speed of closing."""
    law, name = scene.contact, scene.contact.NAME
    exponent = EXPONENTS.get(name) or law.exponent
    dashpot = law.damping if name == "kelvin-voigt" else 0.0
    factor = law.damping if name == "hunt-crossley" else 0.0
    return law.stiffness, exponent, dashpot, factor


def _rods(body: Any, elements: int, fixed: bool) -> Body:
    """Of bonded rods from the struck end on; masses of elements half consistent, half lumped."""
    travel = sum(rod.length / rod.wave_speed for rod in body.rods)
    mass, stiffness = np.zeros((1, 1)), np.zeros((1, 1))
    for rod in body.rods:
        count = max(2, round(elements * rod.length / rod.wave_speed / travel))
        size = rod.length / count
        own_mass = rod.material.density * rod.area * size * np.array([[5.0, 1.0], [1.0, 5.0]]) / 12.0
        own_stiffness = rod.material.young * rod.area / size * np.array([[1.0, -1.0], [-1.0, 1.0]])
        before = len(mass)
        mass, stiffness = (np.pad(each, (0, count)) for each in (mass, stiffness))
        for k in range(before - 1, before - 1 + count):
            mass[k : k + 2, k : k + 2] += own_mass
            stiffness[k : k + 2, k : k + 2] += own_stiffness
    mass[-1, -1] += body.rods[-1].end_mass
    held = [len(mass) - 1] if fixed else []
    return _modes(mass, stiffness, held, 0, np.ones(len(mass)))


def _beam(body: Any, elements: int, support: str) -> Body:
    """Euler-Bernoulli, by cubic elements with a node where it is struck."""
    left = max(2, round(elements * body.at))
    nodes = np.concatenate(
        [np.linspace(0.0, body.at, left + 1), np.linspace(body.at, 1.0, max(2, elements - left) + 1)[1:]]
    )
    nodes = nodes * body.length
    count = 2 * len(nodes)
    mass, stiffness = np.zeros((count, count)), np.zeros((count, count))
    bending = body.material.young * body.section.second_moment
    for k, h in enumerate(np.diff(nodes)):
        line = body.material.density * body.section.area * h / 420.0
        own_mass = line * np.array(
            [[156, 22 * h, 54, -13 * h], [22 * h, 4 * h**2, 13 * h, -3 * h**2],
             [54, 13 * h, 156, -22 * h], [-13 * h, -3 * h**2, -22 * h, 4 * h**2]]
        )  # fmt: skip
        own = np.array(
            [[12, 6 * h, -12, 6 * h], [6 * h, 4 * h**2, -6 * h, 2 * h**2],
             [-12, -6 * h, 12, -6 * h], [6 * h, 2 * h**2, -6 * h, 4 * h**2]]
        )  # fmt: skip
        mass[2 * k : 2 * k + 4, 2 * k : 2 * k + 4] += own_mass
        stiffness[2 * k : 2 * k + 4, 2 * k : 2 * k + 4] += bending / h**3 * own
    mass[-2, -2] += body.end_mass
    held = {"cantilever": [0, 1], "pinned-pinned": [0, -2], "clamped-clamped": [0, 1, -2, -1], "pinned-free": [0]}
    uniform = np.zeros(count)
    uniform[::2] = 1.0
    return _modes(mass, stiffness, held.get(support, []), 2 * left, uniform)


def _modes(mass: np.ndarray, stiffness: np.ndarray, held: list[int], struck: int, uniform: np.ndarray) -> Body:
    free = np.delete(np.arange(len(mass)), held)
    squares, shapes = eigh(stiffness[np.ix_(free, free)], mass[np.ix_(free, free)])
    squares[squares < 1e-9 * squares[min(3, len(squares) - 1)]] = 0.0
    return Body(
        np.sqrt(squares),
        shapes[np.searchsorted(free, struck)],
        shapes.T @ mass[np.ix_(free, free)] @ uniform[free],
        float(uniform @ mass @ uniform),
    )


def _body(body: Any, elements: int, support: str) -> Body:
    if body.kind in ("rod", "rods"):
        return _rods(body, elements, support == "fixed")
    if body.kind == "beam":
        return _beam(body, max(12, elements // 3), support)
    if body.kind == "stop":
        return Body(np.zeros(1), np.zeros(1), np.zeros(1), math.inf)
    frequency = math.sqrt(body.stiffness / body.mass) if body.kind == "spring-mass" else 0.0
    root = math.sqrt(body.mass)
    return Body(np.array([frequency]), np.array([1.0 / root]), np.array([root]), body.mass)


@numba.njit(cache=True)
def _march(turns, rings, struck, amplitudes, rates, drift, push, steps, step, share, law):
    """Impulses of half steps and exact turns; velocities at the last parting, the peak and the number of touches."""
    stiffness, exponent, dashpot, factor = law
    size = len(struck)
    left, peak, touches, touching = rates.copy(), 0.0, 0, False
    steepest = stiffest = 0.0
    for _ in range(steps):
        for half in range(2):
            depth = closing = 0.0
            for k in range(size):
                depth += struck[k] * amplitudes[k]
                closing += struck[k] * rates[k]
            force = 0.0
            if depth > 0.0 or (depth == 0.0 and closing > 0.0):
                spring = stiffness * depth**exponent
                slope = dashpot + factor * spring
                steepest = max(steepest, slope)
                if depth > 0.0:
                    stiffest = max(stiffest, exponent * spring * (1.0 + factor * max(closing, 0.0)) / depth)
                force = max(spring + slope * closing, 0.0) / (1.0 + 0.25 * step * share * slope)
                peak = max(peak, force)
            if force > 0.0 and not touching:
                touches += 1
            touching = force > 0.0
            if force > 0.0:
                for k in range(size):
                    rates[k] -= 0.5 * step * struck[k] * force
                for k in range(size):
                    left[k] = rates[k]
            if half == 0:
                for k in range(size):
                    # about the middle of a constant push; a rigid mode falls
                    q, v = amplitudes[k] - drift[k], rates[k]
                    if not rings[k]:
                        amplitudes[k] += step * v + 0.5 * step**2 * push[k]
                        rates[k] = v + step * push[k]
                    else:
                        amplitudes[k] = drift[k] + turns[k, 0] * q + turns[k, 1] * v
                        rates[k] = turns[k, 0] * v - turns[k, 2] * q
    return left, peak, touches, steepest, stiffest
