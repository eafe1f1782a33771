"""Whether the parts of a chain on a grid will ever touch again: as `numerics.waves.parted`, from means over steps."""

from typing import Any

import numpy as np

from ...numerics.parting import reach, swing_and_give
from ...numerics.waves.parts import ABSORBING, BONDED
from ...numerics.waves.record import SPEED, TOTAL_LEFT, TOTAL_RIGHT


def clear(history: Any, steps: int) -> bool:
    """Whether after so many steps all parts move apart as wholes, and are further apart than their faces reach."""
    chain, contact, last = history.chain, history.contact, len(history.laws) - 1
    t, striker = history.step * steps, history.given.masses[-1]
    opening = [node for node in range(contact, last) if node == contact or chain.kind[node] != BONDED]
    pushed = {node: history.step * np.cumsum(history.force[node, :steps]) for node in opening}
    speed = (chain.drift[0] if contact else chain.mass_drift[0]) - pushed[contact][-1] / striker
    place = (chain.drift[0] if contact else chain.mass_drift[0]) * t - history.step * pushed[contact].sum() / striker
    ahead = _part(history, 0, contact, t)[3] if contact else 0.0
    for node, following in zip(opening, [*opening[1:], last], strict=True):
        mass, moving, back, front = _part(history, node, following, t)
        gained = history.step * (pushed[node].sum() - (pushed[following].sum() if following < last else 0.0))
        there = chain.drift[node] * t + gained / mass if np.isfinite(mass) else 0.0
        if moving < speed or chain.gap[node] + there - place <= ahead + back:
            return False
        speed, place, ahead = moving, there, front
    return True


def _part(history: Any, begin: int, end: int, t: float) -> tuple[float, float, float, float]:
    """The rods between two nodes as one body: mass, velocity as a whole, how far its first and last faces reach."""
    chain, now, rods = history.chain, np.array([t]), slice(begin, end)
    near = float(chain.mass_left[begin]) if begin < history.contact else 0.0
    far = 0.0
    if end == len(history.laws) - 1:
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
