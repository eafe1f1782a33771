"""Whether the parts of a chain on a grid will ever touch again: as `numerics.waves.parted`, from means over steps."""

from typing import Any

import numpy as np

from ...numerics.parting import reach, swing_and_give
from ...numerics.waves.parts import ABSORBING, LAW, RIGID_FACES
from ...numerics.waves.record import SPEED, TOTAL_LEFT, TOTAL_RIGHT


def clear(history: Any, steps: int) -> bool:
    """Whether after so many steps all parts move apart as wholes, and are further apart than their faces reach."""
    chain, last = history.chain, len(history.laws) - 1
    t, first_mass = history.step * steps, history.given.masses[-1]
    opening = [node for node in range(last + 1) if chain.kind[node] in (RIGID_FACES, LAW)]
    pushed = {node: history.step * np.cumsum(history.force[node, :steps]) for node in opening}
    node = opening[0]
    drift = chain.drift[0] if node else chain.mass_drift[0]
    speed = drift - pushed[node][-1] / first_mass
    place = drift * t - history.step * pushed[node].sum() / first_mass
    ahead = _part(history, 0, node, t)[3] if node else 0.0
    for node, following in zip(opening, [*opening[1:], None], strict=True):
        mass, moving, back, front = _part(history, node, last if following is None else following, t)
        gained = history.step * (pushed[node].sum() - (0.0 if following is None else pushed[following].sum()))
        before = chain.drift[node] if node < last else chain.mass_drift[node]
        there = before * t + gained / mass if np.isfinite(mass) else 0.0
        if moving < speed or chain.gap[node] + there - place <= ahead + back:
            return False
        speed, place, ahead = moving, there, front
    return True


def _part(history: Any, begin: int, end: int, t: float) -> tuple[float, float, float, float]:
    """What is between two nodes as one body: mass, velocity as a whole, how far its first and last faces reach."""
    chain, now, rods = history.chain, np.array([t]), slice(begin, end)
    striking = begin < history.contact
    near = float(chain.mass_left[begin]) if striking else 0.0
    far = 0.0
    if end == len(history.laws) - 1 and not striking:
        far = np.inf if chain.kind[end] == ABSORBING else float(chain.mass_right[end])
    masses = chain.impedance[rods] * chain.transit[rods]
    mass, momentum = near + far + masses.sum(), float(masses @ chain.drift[rods])
    energy = sum(float(history.rod_energy(rod, now)[0]) for rod in range(begin, end))
    for rod in range(begin, end):
        before = now - chain.transit[rod]
        for node, total, sign in ((rod, TOTAL_RIGHT, 1.0), (rod + 1, TOTAL_LEFT, -1.0)):
            at, then = history.sampled(node, total, now), history.sampled(node, total, before)
            momentum += sign * float(at[0] - then[0])
    for node, beside in ((begin, near), (end, far)):
        if 0.0 < beside < np.inf:
            speed = float(history.sampled(node, SPEED, now)[0])
            momentum, energy = momentum + beside * speed, energy + 0.5 * beside * speed**2
    moving = momentum / mass if np.isfinite(mass) else 0.0
    ringing = energy - (0.5 * mass * moving**2 if np.isfinite(mass) else 0.0)
    _, first, last = swing_and_give(chain.impedance[rods].copy(), chain.transit[rods].copy(), near, far)
    return mass, moving, reach(ringing, first), reach(ringing, last)
